// The base of reactors that answer with one message.
//
// gRPC keeps the answer until the caller has taken it: who does not within the
// stream idle timeout, or whose answers take the memory of others
// (ServiceEnvironment::answers), is cut.
#ifndef ARGMESH_SERVER_RPC_ANSWERING_REACTOR_H_
#define ARGMESH_SERVER_RPC_ANSWERING_REACTOR_H_

#include <grpcpp/grpcpp.h>

#include <cstdint>
#include <memory>
#include <utility>

#include "absl/time/time.h"
#include "server/rpc/peer_wait.h"

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
    if (answered_.Lasted(now) > this->environment().stream_idle_timeout()) {
      Cut();
    }
  }

  void OnOverBudget() final {
    if (answered_.pending()) {
      Cut();
    } else {
      Base::OnOverBudget();
    }
  }

 protected:
  // What is sent when the call is finished as OK.
  Response& response() { return *response_; }

  void End(const grpc::Status& status) final {
    if (!status.ok()) {
      this->Finish(status);
      return;
    }
    answered_.Begin();
    this->environment().answers.Add(
        this, this->scope().peer(),
        static_cast<int64_t>(response_->ByteSizeLong()));
    this->StartWriteAndFinish(response_.get(), grpc::WriteOptions(), status);
  }

 private:
  // An answer that nobody takes blocks the end of the call: only a cancellation
  // gets through.
  void Cut() { this->scope().context()->TryCancel(); }

  const std::unique_ptr<Response> response_;
  PeerWait answered_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_ANSWERING_REACTOR_H_
