// argmesh/v1/match.proto from the engine's types.
#ifndef ARGMESH_SERVER_RPC_CONVERT_MATCH_H_
#define ARGMESH_SERVER_RPC_CONVERT_MATCH_H_

#include <string_view>

#include "absl/status/statusor.h"
#include "argmesh/v1/match.pb.h"
#include "core/matching/match.h"
#include "server/engine/search_requests.h"

namespace argmesh {

// FIELD_INVALID for a number that is no mode.
absl::StatusOr<MatchMode> FromProto(std::string_view field,
                                    v1::SearchMode mode);

// FIELD_INVALID for a number that is no set, for another set than FULL in a
// partial search, and for levels, which are not served yet.
absl::StatusOr<AttributeSet> FromProto(std::string_view field,
                                       const v1::MatchParameters& parameters,
                                       MatchMode mode);

// Without the shape and the explanation.
v1::Match ToProto(const MatchResult& match);

// Terms that add up to the score: a global score is the mean of the scores of
// its finest levels, a partial score that of the best level. No terms when the
// score is neither.
v1::MatchExplanation Explain(const MatchResult& match, MatchMode mode);

v1::SearchStats ToProto(const SearchStats& stats);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_CONVERT_MATCH_H_
