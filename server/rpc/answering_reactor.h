// The base of reactors that answer with one message.
//
// gRPC keeps the answer until the caller has taken it: who does not within the
// stream idle timeout, or whose answers take the memory of others
// (ServiceEnvironment::answers), is cut. A reactor that may Postpone makes no
// answer while its connection has much to take.
#ifndef ARGMESH_SERVER_RPC_ANSWERING_REACTOR_H_
#define ARGMESH_SERVER_RPC_ANSWERING_REACTOR_H_

#include <google/protobuf/message.h>
#include <grpcpp/grpcpp.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <utility>

#include "absl/time/clock.h"
#include "absl/time/time.h"
#include "server/rpc/answer_room.h"
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
    if (ended_.Lasted(now) > limit) Cut();
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
    if (ended_.pending()) {
      Cut();
    } else if (postponed_.pending()) {
      this->FinishOnce(TooManyUnreadAnswers());
    } else {
      Base::OnOverBudget();
    }
  }

 protected:
  // In a step of the pool, before the answer is made. True when that has to
  // wait because the connection has not taken those before: `again`, which
  // alone owns the `request`, is run later. Until then the call
  // gives up its place.
  bool Postpone(const google::protobuf::Message& request,
                std::function<void()> again) {
    if (this->holdings().EnterRoom()) {
      this->environment().answer_room.LetNextIn(this->scope().peer());
      return false;
    }
    const auto bytes = static_cast<int64_t>(request.SpaceUsedLong());
    this->ReleasePlace();
    {
      const std::lock_guard lock(this->scope().mutex());
      if (!this->scope().finished()) again_ = std::move(again);
    }
    first_postponed_ = std::min(first_postponed_, absl::Now());
    postponed_.Begin(first_postponed_);
    this->scope().MarkWorkPostponed();
    if (this->environment().calls.draining()) {
      this->FinishOnce(ServerDraining());
      return true;
    }
    this->holdings().Hold(this->environment().postponed, bytes);
    const auto resume = [this, self = this->shared_from_this()] {
      this->Guard([this] { Resume(); });
    };
    if (this->holdings().EnterRoomOrWait(resume)) resume();
    return true;
  }

  // What is sent when the call is finished as OK.
  Response& response() { return *response_; }

  void End(const grpc::Status& status) final {
    TakeAgain();
    ended_.Begin();
    if (!status.ok()) {
      this->Finish(status);
      return;
    }
    const auto bytes = static_cast<int64_t>(response_->ByteSizeLong());
    this->holdings().HoldRoom(bytes);
    this->holdings().Hold(this->environment().answers, bytes);
    this->StartWriteAndFinish(response_.get(), grpc::WriteOptions(), status);
  }

 private:
  // An answer that nobody takes blocks the end of the call: only a cancellation
  // gets through.
  void Cut() { this->scope().context()->TryCancel(); }

  std::function<void()> TakeAgain() {
    const std::lock_guard lock(this->scope().mutex());
    return std::exchange(again_, nullptr);
  }

  void Resume() {
    const std::function<void()> again = TakeAgain();
    if (!again) {  // ended meanwhile
      this->environment().answer_room.LetNextIn(this->scope().peer());
      return;
    }
    postponed_.End();
    this->holdings().LetGo(this->environment().postponed);
    again();
  }

  const std::unique_ptr<Response> response_;
  PeerWait ended_;      // since its end was handed to gRPC
  PeerWait postponed_;  // while it is
  absl::Time first_postponed_ = absl::InfiniteFuture();  // of its steps
  std::function<void()> again_;  // with the scope's mutex
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_ANSWERING_REACTOR_H_
