// Matches as a table for people.
#ifndef ARGMESH_CLIENT_CLI_MATCH_TABLE_H_
#define ARGMESH_CLIENT_CLI_MATCH_TABLE_H_

#include <span>
#include <string>

#include "argmesh/v1/match.pb.h"

namespace argmesh {

// Rank, id, class, score, the score of every level, best level, coverages.
std::string MatchTable(std::span<const v1::Match> matches);

// What the scores add up from, for matches that carry it.
std::string ExplanationText(std::span<const v1::Match> matches);

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_CLI_MATCH_TABLE_H_
