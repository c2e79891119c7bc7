// How a Client encrypts, and how it says who it is.
#ifndef ARGMESH_CLIENT_CHANNEL_CREDENTIALS_H_
#define ARGMESH_CLIENT_CHANNEL_CREDENTIALS_H_

#include <grpcpp/client_context.h>
#include <grpcpp/security/credentials.h>
#include <grpcpp/support/channel_arguments.h>

#include <memory>

#include "absl/status/statusor.h"
#include "client/client_options.h"

namespace argmesh {

// Plain text without TLS. Sets the name the server's certificate must be for.
// kInvalidArgument naming the file that cannot be read.
absl::StatusOr<std::shared_ptr<grpc::ChannelCredentials>>
MakeChannelCredentials(const ClientTls& tls, grpc::ChannelArguments& arguments);

// Puts the key of the options, where there is one, on a call.
void AddKey(const ClientOptions& options, grpc::ClientContext& context);

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_CHANNEL_CREDENTIALS_H_
