#include "client/channel_credentials.h"

#include <fstream>
#include <iterator>
#include <string>

#include "absl/strings/str_cat.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

// Empty for an empty path.
absl::StatusOr<std::string> ReadPem(const std::string& path) {
  if (path.empty()) return std::string();
  std::ifstream in(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  if (!in || text.find("-----BEGIN ") == std::string::npos) {
    return absl::InvalidArgumentError(
        absl::StrCat(path, " cannot be read, or is no PEM file"));
  }
  return text;
}

}  // namespace

absl::StatusOr<std::shared_ptr<grpc::ChannelCredentials>>
MakeChannelCredentials(const ClientTls& tls,
                       grpc::ChannelArguments& arguments) {
  if (!tls.enabled) return grpc::InsecureChannelCredentials();
  if (tls.certificate.empty() != tls.private_key.empty()) {
    return absl::InvalidArgumentError(
        "a client's certificate and its private key go together");
  }
  grpc::SslCredentialsOptions options;
  ARGMESH_ASSIGN_OR_RETURN(options.pem_root_certs, ReadPem(tls.authorities));
  ARGMESH_ASSIGN_OR_RETURN(options.pem_cert_chain, ReadPem(tls.certificate));
  ARGMESH_ASSIGN_OR_RETURN(options.pem_private_key, ReadPem(tls.private_key));
  if (!tls.server_name.empty()) {
    arguments.SetSslTargetNameOverride(tls.server_name);
  }
  return grpc::SslCredentials(options);
}

void AddKey(const ClientOptions& options, grpc::ClientContext& context) {
  if (options.api_key.empty()) return;
  context.AddMetadata("authorization",
                      absl::StrCat("Bearer ", options.api_key));
}

}  // namespace argmesh
