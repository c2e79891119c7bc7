#include "server/rpc/measured_search.h"

namespace argmesh {

absl::StatusOr<SearchAnswer> MeasuredSearch(ServiceEnvironment& environment,
                                            const SearchQuery& query,
                                            const StopToken& stop) {
  absl::StatusOr<SearchAnswer> answer = environment.engine.Search(query, stop);
  if (!answer.ok()) return answer;
  const char* mode = query.mode == MatchMode::kGlobal ? "global" : "partial";
  for (const StageTime& stage : answer->stats.stages) {
    environment.telemetry.SearchStageFinished(mode, stage.stage, stage.elapsed);
  }
  return answer;
}

}  // namespace argmesh
