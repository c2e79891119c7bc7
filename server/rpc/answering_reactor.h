// The base of reactors that answer with one message.
//
// gRPC keeps the answer until the caller has taken it: who does not within the
// stream idle timeout, or whose answers take the memory of others
// (ServiceEnvironment::answers), is cut. While a connection has much to take,
// no more answers are made for it.
#ifndef ARGMESH_SERVER_RPC_ANSWERING_REACTOR_H_
#define ARGMESH_SERVER_RPC_ANSWERING_REACTOR_H_

#include <grpcpp/grpcpp.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <utility>

#include "absl/time/time.h"
#include "server/rpc/peer_budget.h"
#include "server/rpc/peer_wait.h"
#include "server/rpc/status.h"

namespace argmesh {

// `Base` is a ReadingReactor of a ServerBidiReactor<..., Response>; `Response`
// may be google::protobuf::Message.
template <typename Response, typename Base>
class AnsweringReactor : public Base {
 public:
  // `arguments` are those of `Base`.
  template <typename... Arguments>
  explicit AnsweringReactor(std::unique_ptr<Response> response,
                            Arguments&&... arguments)
      : Base(std::forward<Arguments>(arguments)...),
        response_(std::move(response)) {}

  void OnTick(absl::Time now) override {
    Base::OnTick(now);
    const absl::Duration limit = this->environment().stream_idle_timeout();
    if (answered_.Lasted(now) > limit) Cut();
    if (!postponed_.pending()) return;
    absl::Status status = this->stop().Check();
    if (postponed_.Lasted(now) > limit) status.Update(TooManyUnreadAnswers());
    if (!status.ok()) this->FinishOnce(status);
  }

  void OnDrain(absl::Duration grace) override {
    Base::OnDrain(grace);
    if (postponed_.pending()) this->FinishOnce(ServerDraining());
  }

  void OnOverBudget() final {
    if (answered_.pending()) {
      Cut();
    } else if (postponed_.pending()) {
      this->FinishOnce(TooManyUnreadAnswers());
    } else {
      Base::OnOverBudget();
    }
  }

 protected:
  // True, and `again` is run later, when the connection has not taken so much
  // that no more is made for it. Until then the call gives up its place, and
  // the `bytes` of its request count among those that wait.
  bool Postpone(int64_t bytes, const std::function<void()>& again) {
    PeerBudget& answers = this->environment().answers;
    if (answers.HasRoom(this->scope().peer())) return false;
    this->ReleasePlace();
    postponed_.Begin();
    this->holdings().Hold(this->environment().postponed, bytes);
    this->WhenRoom(answers, [this, again] {
      postponed_.End();
      this->holdings().LetGo(this->environment().postponed);
      again();
    });
    return true;
  }

  // What is sent when the call is finished as OK.
  Response& response() { return *response_; }

  void End(const grpc::Status& status) final {
    if (!status.ok()) {
      this->Finish(status);
      return;
    }
    answered_.Begin();
    this->holdings().Hold(this->environment().answers,
                          static_cast<int64_t>(response_->ByteSizeLong()));
    this->StartWriteAndFinish(response_.get(), grpc::WriteOptions(), status);
  }

 private:
  // An answer that nobody takes blocks the end of the call: only a cancellation
  // gets through.
  void Cut() { this->scope().context()->TryCancel(); }

  const std::unique_ptr<Response> response_;
  PeerWait answered_;
  PeerWait postponed_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_ANSWERING_REACTOR_H_
