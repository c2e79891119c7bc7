// A search whose stages are measured for the metrics.
#ifndef ARGMESH_SERVER_RPC_MEASURED_SEARCH_H_
#define ARGMESH_SERVER_RPC_MEASURED_SEARCH_H_

#include "absl/status/statusor.h"
#include "core/base/stop_token.h"
#include "server/engine/search_requests.h"
#include "server/rpc/service_environment.h"

namespace argmesh {

// Engine::Search, as it is.
absl::StatusOr<SearchAnswer> MeasuredSearch(ServiceEnvironment& environment,
                                            const SearchQuery& query,
                                            const StopToken& stop);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_MEASURED_SEARCH_H_
