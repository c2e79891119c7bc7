// What is in a snapshot: names of its members, and how old ones are told from
// new ones.
#ifndef ARGMESH_SERVER_STORAGE_SNAPSHOT_FORMAT_H_
#define ARGMESH_SERVER_STORAGE_SNAPSHOT_FORMAT_H_

#include <optional>
#include <string>
#include <string_view>

#include "core/base/sha256.h"

namespace argmesh {

// First; its content is this line. Another one: not for this program.
inline constexpr char kSnapshotVersionMember[] = "argmesh-snapshot";
inline constexpr std::string_view kSnapshotVersion = "version 1\n";
// Second: the database, as SQLite writes it.
inline constexpr char kSnapshotCatalogMember[] = "catalog.db";

// "blobs/ab/<64 digits>", one for every mesh that the catalog names, in the
// order of their digests.
std::string MeshMemberName(const Sha256Digest& sha256);
// None: any other text.
std::optional<Sha256Digest> DigestOfMember(std::string_view name);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_STORAGE_SNAPSHOT_FORMAT_H_
