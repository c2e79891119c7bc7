// The base of reactors that read a mesh: one header that announces it, then
// its chunks.
//
// Chunks go straight to the disk; the mesh is handed on only when the client
// has half-closed and size and SHA-256 are those of the header. A client that
// is silent, or trickles, is cut off once it lags by the stream idle timeout
// (peer_pace.h): the place that it holds is wanted by others.
#ifndef ARGMESH_SERVER_RPC_MESH_STREAM_REACTOR_H_
#define ARGMESH_SERVER_RPC_MESH_STREAM_REACTOR_H_

#include <memory>
#include <utility>

#include "absl/time/clock.h"
#include "core/base/status_macros.h"
#include "server/rpc/peer_pace.h"
#include "server/rpc/reading_reactor.h"
#include "server/rpc/status.h"

namespace argmesh {

struct MeshStreamPlan {
  const char* method;    // "ShapeService.UploadShape"
  WorkClass work_class;  // of what is done with the mesh
  Admission& admission;  // what the call takes a place of while the mesh comes
  // And, instead, once it is there; none: it keeps that place.
  Admission* work_admission = nullptr;
};

// `Request` has a `header` and a `chunk`.
template <typename Base, typename Request>
class MeshStreamReactor : public ReadingReactor<Base, Request> {
 public:
  MeshStreamReactor(ServiceEnvironment& environment,
                    grpc::CallbackServerContext* context,
                    const MeshStreamPlan& plan)
      : ReadingReactor<Base, Request>(environment, context, plan.method),
        plan_(plan) {}

  void OnTick(absl::Time now) override {
    this->ResubmitWaiting();
    const absl::Duration limit = this->environment().stream_idle_timeout();
    if (pace_.Lag(now, this->Waits()) > limit) {
      this->FinishOnce(StreamTooSlow(limit));
    }
  }

 protected:
  // Refuses a header, or says what it announces.
  virtual absl::StatusOr<UploadAnnouncement> Announced(
      const Request& first) = 0;
  // The mesh is there; on the pool. An error ends the call.
  virtual absl::Status Take(std::unique_ptr<StagedMesh> mesh) = 0;

  void Begin() final {
    if (this->AdmitTo(plan_.admission)) this->StartNextRead();
  }

  void Received(std::shared_ptr<Request> request) final {
    pace_.Moved(static_cast<int64_t>(request->ByteSizeLong()));
    const bool expected = request->has_header()  ? upload_ == nullptr
                          : request->has_chunk() ? upload_ != nullptr
                                                 : false;
    if (!expected) {
      this->FinishOnce(StreamOrderInvalid("a mesh is one header, then chunks"));
      return;
    }
    this->RunPatiently(WorkClass::kQuick, [this, request] {
      const absl::Status taken = request->has_header()
                                     ? StartUpload(*request)
                                     : upload_->Append(request->chunk());
      if (taken.ok()) {
        this->StartNextRead();
      } else {
        this->FinishOnce(taken);
      }
    });
  }

  void ReadsEnded() final {
    if (upload_ == nullptr) {
      this->FinishOnce(
          StreamOrderInvalid("the stream ended before its header"));
      return;
    }
    if (plan_.work_admission != nullptr &&
        !this->AdmitTo(*plan_.work_admission)) {
      return;
    }
    this->RunPatiently(plan_.work_class, [this] {
      absl::StatusOr<std::unique_ptr<StagedMesh>> mesh = upload_->Finish();
      const absl::Status taken =
          mesh.ok() ? Take(*std::move(mesh)) : mesh.status();
      if (!taken.ok()) this->FinishOnce(taken);
    });
  }

 private:
  absl::Status StartUpload(const Request& first) {
    ARGMESH_ASSIGN_OR_RETURN(const UploadAnnouncement announced,
                             Announced(first));
    ARGMESH_ASSIGN_OR_RETURN(upload_, this->engine().StartUpload(announced));
    return absl::OkStatus();
  }

  const MeshStreamPlan plan_;
  std::unique_ptr<MeshUpload> upload_;
  PeerPace pace_{absl::Now()};
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_MESH_STREAM_REACTOR_H_
