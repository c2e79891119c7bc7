// The base of the services: the table of their methods.
//
//   ShapeServiceImpl(ServiceEnvironment& environment) : RpcService(environment)
//   {
//     Unary({"ShapeService.GetShape"}, GetShape);
//     Stream<DownloadReactor>("ShapeService.DownloadMesh");
//   }
//
// gRPC's generated services hand a call over once its message is there: whoever
// never sends the end of it keeps memory for as long as the connection lives,
// and gRPC knows no timeout against that. Here every method is registered as
// one that streams, which is the same on the wire: a call comes as soon as its
// headers do, and its message is read like any other (request_reactor.h).
#ifndef ARGMESH_SERVER_RPC_RPC_SERVICE_H_
#define ARGMESH_SERVER_RPC_RPC_SERVICE_H_

#include <google/protobuf/message.h>
#include <grpcpp/grpcpp.h>
#include <grpcpp/impl/codegen/proto_utils.h>
#include <grpcpp/impl/codegen/server_callback_handlers.h>
#include <grpcpp/impl/service_type.h>

#include <deque>
#include <string>
#include <utility>

#include "server/rpc/service_environment.h"
#include "server/rpc/unary_reactor.h"

namespace argmesh {

class RpcService : public grpc::Service {
 public:
  using UnaryMethods = std::deque<UnaryMethod>;
  const UnaryMethods& unary_methods() const { return unary_methods_; }

 protected:
  // `environment` must outlive the service; `package` is that of its methods.
  explicit RpcService(ServiceEnvironment& environment,
                      std::string package = "argmesh.v1")
      : environment_(environment), package_(std::move(package)) {}

  // A method whose body fills an answer.
  template <typename Request, typename Response>
  void Unary(const UnaryPlan& plan,
             absl::Status (*body)(const UnaryCall&, const Request&,
                                  Response*)) {
    AddUnary({plan, Request::default_instance(), Response::default_instance(),
              [body](const UnaryCall& call, const UnaryMethod::Message& request,
                     UnaryMethod::Message* response) {
                return body(call, static_cast<const Request&>(request),
                            static_cast<Response*>(response));
              }});
  }

  // A method with a reactor of its own, made with environment and context.
  template <typename Reactor>
  void Stream(const char* method) {
    AddStream<Reactor>(method, static_cast<Reactor*>(nullptr));
  }

 private:
  template <typename Reactor, typename Request, typename Response>
  void AddStream(const char* method,
                 const grpc::ServerBidiReactor<Request, Response>*) {
    Add(method, new grpc::internal::CallbackBidiHandler<Request, Response>(
                    [this](grpc::CallbackServerContext* context) {
                      return StartReactor<Reactor>(environment_, context);
                    }));
  }

  void AddUnary(UnaryMethod method);
  // Takes `handler`.
  void Add(const char* method, grpc::internal::MethodHandler* handler);

  ServiceEnvironment& environment_;
  const std::string package_;
  std::deque<std::string> paths_;  // of the methods; gRPC keeps pointers
  UnaryMethods unary_methods_;     // calls keep references
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_RPC_SERVICE_H_
