// argmesh/v1/match.proto from the engine's types.
#ifndef ARGMESH_SERVER_RPC_CONVERT_MATCH_H_
#define ARGMESH_SERVER_RPC_CONVERT_MATCH_H_

#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "argmesh/v1/match.pb.h"
#include "core/matching/match.h"
#include "server/engine/search_requests.h"

namespace argmesh {

// FIELD_INVALID for a number that is no mode.
absl::StatusOr<MatchMode> FromProto(std::string_view field,
                                    v1::SearchMode mode);

struct MatchSettings {
  AttributeSet attributes = AttributeSet::kFull;
  std::vector<std::string> levels;
  RankingMethod ranking = RankingMethod::kFused;
  bool rerank = false;
};

// `graph_query`: the query is a graph, which is ranked by graphs.
//
// FIELD_INVALID for a number that is no set or method, for another set than
// FULL in a partial search, for what needs more than the graph of a graph
// query, and for `rerank` of anything but a fused search.
absl::StatusOr<MatchSettings> FromProto(std::string_view field,
                                        const v1::MatchParameters& parameters,
                                        MatchMode mode, bool graph_query);

// Without the shape and the explanation.
v1::Match ToProto(const SearchMatch& match);

// Terms that add up to the score: those of a fused score; otherwise a global
// score is the mean of the scores of its finest levels, a partial score that
// of the best level. No terms when the score is neither.
v1::MatchExplanation Explain(const SearchMatch& match, MatchMode mode);

v1::SearchStats ToProto(const SearchStats& stats);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_CONVERT_MATCH_H_
