// The base of reactors whose client sends one message.
//
// The call is there as soon as its headers are (rpc_service.h): who may not
// make it is refused before the message is taken. A message that does not come
// whole within the stream idle timeout ends the call, and those that are slow
// may hold so much memory only (ServiceEnvironment::requests).
#ifndef ARGMESH_SERVER_RPC_REQUEST_REACTOR_H_
#define ARGMESH_SERVER_RPC_REQUEST_REACTOR_H_

#include <atomic>
#include <memory>
#include <utility>

#include "server/rpc/reading_reactor.h"
#include "server/rpc/status.h"

namespace argmesh {

// `Base` is a grpc::ServerBidiReactor<Request, ...>.
template <typename Base, typename Request>
class RequestReactor : public ReadingReactor<Base, Request> {
 public:
  using ReadingReactor<Base, Request>::ReadingReactor;

  void OnTick(absl::Time now) override {
    const absl::Duration silence = this->Silence(now);
    const absl::Duration limit = this->environment().stream_idle_timeout();
    if (silence > limit) {
      this->FinishOnce(StreamIdle(limit));
    } else if (silence > kPromptness && !slow_) {
      slow_ = true;
      this->holdings().Hold(requests(), kMaxMessageBytes);
      if (received_) this->holdings().LetGo(requests());
    }
  }

  void OnDrain(absl::Duration) override {
    if (!received_) this->FinishOnce(ServerDraining());
  }

  void OnOverBudget() override {
    if (!received_) this->FinishOnce(TooManySlowRequests());
  }

 protected:
  // The message is there.
  virtual void Requested(std::shared_ptr<const Request> request) = 0;

  void Begin() final { this->StartNextRead(); }

  void Received(std::shared_ptr<Request> request) final {
    received_ = true;
    if (slow_) this->holdings().LetGo(requests());
    Requested(std::move(request));
  }

  void ReadsEnded() final {
    absl::Status status = this->stop().Check();
    status.Update(StreamOrderInvalid(
        "the call carries no message, or none that can be read"));
    this->FinishOnce(status);
  }

 private:
  // Who takes longer counts as slow.
  static constexpr absl::Duration kPromptness = absl::Seconds(1);

  PeerBudget& requests() { return this->environment().requests; }

  std::atomic<bool> received_{false};
  std::atomic<bool> slow_{false};  // counted among the slow requests
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_REQUEST_REACTOR_H_
