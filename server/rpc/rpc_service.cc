#include "server/rpc/rpc_service.h"

#include <algorithm>

#include "absl/strings/str_cat.h"

namespace argmesh {

void RpcService::AddUnary(UnaryMethod method) {
  using Message = UnaryMethod::Message;
  const UnaryMethod& added = unary_methods_.emplace_back(std::move(method));
  Add(added.plan.method,
      new grpc::internal::CallbackBidiHandler<Message, Message>(
          [this, &added](grpc::CallbackServerContext* context) {
            return StartReactor<UnaryReactor>(environment_, context, added);
          }));
}

void RpcService::Add(const char* method,
                     grpc::internal::MethodHandler* handler) {
  using grpc::internal::RpcMethod;
  std::string& path =
      paths_.emplace_back(absl::StrCat("/", package_, ".", method));
  std::replace(path.begin() + static_cast<ptrdiff_t>(package_.size()) + 2,
               path.end(), '.', '/');
  const auto index = static_cast<int>(paths_.size()) - 1;
  AddMethod(new grpc::internal::RpcServiceMethod(
      path.c_str(), RpcMethod::BIDI_STREAMING, nullptr));
  MarkMethodCallback(index, handler);
}

}  // namespace argmesh
