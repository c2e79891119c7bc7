// Streams that are declared but not served: the call ends at once.
#ifndef ARGMESH_SERVER_RPC_UNSERVED_STREAM_H_
#define ARGMESH_SERVER_RPC_UNSERVED_STREAM_H_

#include "server/rpc/guarded_reactor.h"
#include "server/rpc/status.h"

namespace argmesh {

// `Base` is grpc::ServerWriteReactor<R> or grpc::ServerBidiReactor<Q, R>.
template <typename Base>
class UnservedStream final : public GuardedReactor<Base> {
 public:
  UnservedStream(ServiceEnvironment& environment,
                 grpc::CallbackServerContext* context,
                 const google::protobuf::Message* request, const char* method)
      : GuardedReactor<Base>(environment, context, request, method),
        method_(method) {}

 protected:
  void Begin() override { this->FinishOnce(MethodNotServed(method_)); }

 private:
  const char* method_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_UNSERVED_STREAM_H_
