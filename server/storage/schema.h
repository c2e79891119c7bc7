// The tables of the catalog's database, and how older ones are brought up to
// date.
//
// Each migration is one transaction that ends with its number in
// `user_version`, so that an interrupted one starts over. Before the first
// step on a database that has data, a copy is left beside it.
#ifndef ARGMESH_SERVER_STORAGE_SCHEMA_H_
#define ARGMESH_SERVER_STORAGE_SCHEMA_H_

#include <cstdint>
#include <filesystem>
#include <span>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "server/storage/sqlite_connection.h"

namespace argmesh {

// "ARGM", in the file's header: not any database is ours.
inline constexpr int64_t kApplicationId = 0x4152474D;

// Element i brings version i to version i + 1.
std::span<const char* const> CatalogMigrations();

// Fails    kFailedPrecondition  a database of something else, or of a newer
//                               version than this program knows
//          as SqliteError
absl::Status Migrate(SqliteConnection& connection,
                     const std::filesystem::path& database,
                     std::span<const char* const> migrations);

// quick_check and foreign_key_check; STORED_DATA_DAMAGED with what they found.
absl::Status CheckDatabase(SqliteConnection& connection);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_STORAGE_SCHEMA_H_
