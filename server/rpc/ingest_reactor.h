// IngestService.IngestShapes: many shapes over one stream, one result each.
//
// The client is read one message at a time; an item's chunks go straight to
// the disk, and complete items are computed side by side on the engine's pool.
// Credit bounds what is under way, results that the client has not taken
// included, so that neither side stalls the other and memory does not depend on
// the number of items. A bad item gives an error
// result; only a breach of the protocol ends the stream, after the results of
// what was begun before, and a client that neither sends nor takes enough while
// nothing of it is computed (peer_pace.h).
#ifndef ARGMESH_SERVER_RPC_INGEST_REACTOR_H_
#define ARGMESH_SERVER_RPC_INGEST_REACTOR_H_

#include <deque>
#include <memory>
#include <string>

#include "absl/time/clock.h"
#include "argmesh/v1/ingest_service.pb.h"
#include "server/rpc/peer_pace.h"
#include "server/rpc/reading_reactor.h"

namespace argmesh {

class IngestReactor final
    : public ReadingReactor<grpc::ServerBidiReactor<v1::IngestShapesRequest,
                                                    v1::IngestShapesResponse>,
                            v1::IngestShapesRequest> {
 public:
  IngestReactor(ServiceEnvironment& environment,
                grpc::CallbackServerContext* context);

  void OnWriteDone(bool ok) override;
  void OnTick(absl::Time now) override;
  void OnDrain(absl::Duration grace) override;

 protected:
  void Begin() override;
  void Received(std::shared_ptr<v1::IngestShapesRequest> request) override;
  void ReadsEnded() override;

 private:
  struct Item {
    std::string key;
    std::string shape_id;  // as it came
    int64_t credit_bytes = 0;
    NewShape shape;
    int64_t size_bytes = 0;
    std::unique_ptr<MeshUpload> upload;  // none: refused, chunks are dropped
    std::unique_ptr<StagedMesh> mesh;    // complete
  };
  using ItemPtr = std::shared_ptr<Item>;

  // Steps of the reading side, one at a time.
  void Step(v1::IngestShapesRequest& request);
  absl::Status Hello(const v1::IngestHello& hello);
  absl::Status OpenCollection(const v1::IngestHello& hello);
  absl::Status BeginItem(const v1::IngestItem& item);
  absl::Status TakeCredit(const v1::IngestItem& item);
  absl::Status StartItem(const v1::IngestItem& item);
  void TakeChunk(const std::string& chunk);
  void CloseIncompleteItem();
  void StopReading(const absl::Status& status);

  // The computing side.
  void Compute(ItemPtr item);
  void ComputeNext();
  absl::StatusOr<AddedShape> Add(Item& item);
  void SendResult(const Item& item, const absl::StatusOr<AddedShape>& added);

  // The writing side.
  void Send(v1::IngestShapesResponse message);
  void StartNextWrite();  // with the mutex
  // Ends the call when nothing is left to do.
  void FinishWhenDone();

  std::string collection_;  // empty before hello
  ItemPtr current_;         // of the reading side; none between items

  PeerPace pace_{absl::Now()};  // of both sides

  // All below with the scope's mutex.
  std::deque<ItemPtr> ready_;
  int computing_ = 0;
  int open_items_ = 0;        // begun, without a result
  int64_t credit_items_ = 0;  // that has been sent and not used
  int64_t credit_bytes_ = 0;
  bool draining_ = false;
  bool reads_ended_ = false;
  absl::Status end_;  // of the call, once everything is done
  std::deque<v1::IngestShapesResponse> outbox_;
  v1::IngestShapesResponse message_;  // being written
  PeerWait writing_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_INGEST_REACTOR_H_
