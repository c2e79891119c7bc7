// SearchService.StreamSearchShapes: a query mesh in chunks; then what was found
// in it, the matches one by one, and the stats.
//
// A place among the searches is held from when the mesh is there until the
// answer is: neither a slow sender nor a slow reader takes it from others. The
// answer counts among those that are not taken (ServiceEnvironment::answers).
#ifndef ARGMESH_SERVER_RPC_STREAM_SEARCH_REACTOR_H_
#define ARGMESH_SERVER_RPC_STREAM_SEARCH_REACTOR_H_

#include <deque>
#include <memory>

#include "argmesh/v1/search_service.pb.h"
#include "server/rpc/convert_search.h"
#include "server/rpc/mesh_stream_reactor.h"
#include "server/rpc/writing_reactor.h"

namespace argmesh {

class StreamSearchReactor final
    : public WritingReactor<
          v1::StreamSearchShapesResponse,
          MeshStreamReactor<
              grpc::ServerBidiReactor<v1::StreamSearchShapesRequest,
                                      v1::StreamSearchShapesResponse>,
              v1::StreamSearchShapesRequest>> {
 public:
  StreamSearchReactor(ServiceEnvironment& environment,
                      grpc::CallbackServerContext* context);

  void OnOverBudget() override;

 protected:
  absl::StatusOr<UploadAnnouncement> Announced(
      const v1::StreamSearchShapesRequest& first) override;
  absl::Status Take(std::unique_ptr<StagedMesh> mesh) override;
  absl::StatusOr<bool> Continue(v1::StreamSearchShapesResponse& next) override;

 private:
  void Prepare(const SearchAnswer& answer);

  SearchQuery query_;
  SearchAnswerForm form_;
  std::deque<v1::StreamSearchShapesResponse> messages_;  // of the answer
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_STREAM_SEARCH_REACTOR_H_
