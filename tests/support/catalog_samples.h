// Collections and shapes made from a few words, for tests of catalogs.
#ifndef ARGMESH_TESTS_SUPPORT_CATALOG_SAMPLES_H_
#define ARGMESH_TESTS_SUPPORT_CATALOG_SAMPLES_H_

#include <cstdint>
#include <string>
#include <string_view>

#include "core/signature/shape_signature.h"
#include "server/engine/catalog.h"

namespace argmesh {

CollectionRecord SampleCollection(const std::string& id);

// A well-formed graph made from `seed`; equal seeds give equal meshes.
ShapePut SamplePut(const CollectionRecord& collection, const std::string& id,
                   uint64_t seed);

// The next settings that a collection like SampleCollection's may get.
SettingsStage SampleStage(int vertex_budget);
// Of the mesh `seed`; its graph is not that of SamplePut.
StagedDescription SampleDescription(const SettingsStage& stage, uint64_t seed);
// Puts that aside for the shape of SamplePut(collection, id, seed).
ShapeStaging SampleStaging(const CollectionRecord& collection,
                           const std::string& id, uint64_t seed,
                           const SettingsStage& stage);

// Equal seeds give equal signatures, most others orthogonal ones.
ShapeSignature SampleSignature(uint64_t seed);

RequestStamp SampleRequest(char digit, std::string_view method,
                           std::string_view asked);

// Everything a client can see of two records is the same.
bool SameRecord(const ShapeRecord& a, const ShapeRecord& b);

}  // namespace argmesh

#endif  // ARGMESH_TESTS_SUPPORT_CATALOG_SAMPLES_H_
