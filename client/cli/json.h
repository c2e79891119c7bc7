// What `--json` prints: messages of the API as JSON with stable keys in a
// stable order. docs/api.md describes them.
#ifndef ARGMESH_CLIENT_CLI_JSON_H_
#define ARGMESH_CLIENT_CLI_JSON_H_

#include <nlohmann/json.hpp>

#include "absl/status/status.h"
#include "argmesh/v1/admin_service.pb.h"
#include "argmesh/v1/collection.pb.h"
#include "argmesh/v1/graph.pb.h"
#include "argmesh/v1/match.pb.h"
#include "argmesh/v1/shape.pb.h"

namespace argmesh {

using Json = nlohmann::ordered_json;

// {code, reason, message}
Json ErrorToJson(const absl::Status& status);

// {collection, display_name, decomposition, ...}
Json ToJson(const v1::Collection& collection);
// {shape, collection, class, metadata, ...}
Json ToJson(const v1::Shape& shape);
// Without levels that are not asked for when `level` is not empty.
Json ToJson(const v1::ShapeGraph& graph, const std::string& level);
// {shape, score, level_scores, best_level, ...}
Json ToJson(const v1::Match& match);
Json ToJson(const v1::SearchStats& stats);
Json ToJson(const v1::GetServerInfoResponse& info);

// The metadata entry "class"; empty without one.
std::string ClassOf(const v1::Shape& shape);

// "biharmonic", "normal-curvature", "voronoi", "given" or "unspecified".
std::string DecompositionName(v1::DecompositionKind kind);

// "off", "obj", "ply", "stl" or "unspecified".
std::string FormatName(v1::MeshFormat format);

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_CLI_JSON_H_
