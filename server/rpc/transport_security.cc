#include "server/rpc/transport_security.h"

#include <grpcpp/security/tls_certificate_provider.h>
#include <grpcpp/security/tls_credentials_options.h>
#include <openssl/err.h>
#include <openssl/ssl.h>

#include "absl/strings/str_format.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

constexpr unsigned kRefreshSeconds = 1;

// `what` such as "--tls-key k.pem", and OpenSSL's reason.
absl::Status Unusable(const std::string& what, const char* why) {
  char reason[256] = "";
  const unsigned long code = ERR_get_error();
  if (code != 0) ERR_error_string_n(code, reason, sizeof(reason));
  ERR_clear_error();
  return absl::InvalidArgumentError(
      absl::StrFormat("%s %s (%s)", what, why, reason));
}

absl::Status CheckNames(const TlsOptions& options) {
  if (options.enabled() && !options.private_key.empty()) {
    return absl::OkStatus();
  }
  return absl::InvalidArgumentError(
      "--tls-cert and --tls-key go together, and --tls-client-ca needs both");
}

}  // namespace

absl::Status CheckTls(const TlsOptions& options) {
  if (options.certificate.empty() && options.private_key.empty() &&
      options.client_authorities.empty()) {
    return absl::OkStatus();
  }
  ARGMESH_RETURN_IF_ERROR(CheckNames(options));
  const std::unique_ptr<SSL_CTX, decltype(&SSL_CTX_free)> context(
      SSL_CTX_new(TLS_server_method()), SSL_CTX_free);
  if (context == nullptr) return Unusable("TLS", "is not available");
  ERR_clear_error();
  if (SSL_CTX_use_certificate_chain_file(context.get(),
                                         options.certificate.c_str()) != 1) {
    return Unusable("--tls-cert " + options.certificate,
                    "is no certificate in PEM form");
  }
  if (SSL_CTX_use_PrivateKey_file(context.get(), options.private_key.c_str(),
                                  SSL_FILETYPE_PEM) != 1) {
    return Unusable("--tls-key " + options.private_key,
                    "is not the certificate's private key in PEM form");
  }
  if (!options.client_authorities.empty() &&
      SSL_CTX_load_verify_file(context.get(),
                               options.client_authorities.c_str()) != 1) {
    return Unusable("--tls-client-ca " + options.client_authorities,
                    "has no certificates in PEM form");
  }
  return absl::OkStatus();
}

absl::StatusOr<std::shared_ptr<grpc::ServerCredentials>> MakeServerCredentials(
    const TlsOptions& options) {
  ARGMESH_RETURN_IF_ERROR(CheckTls(options));
  if (!options.enabled()) return grpc::InsecureServerCredentials();
  namespace tls = grpc::experimental;
  const auto provider = std::make_shared<tls::FileWatcherCertificateProvider>(
      options.private_key, options.certificate, options.client_authorities,
      kRefreshSeconds);
  tls::TlsServerCredentialsOptions credentials(provider);
  credentials.watch_identity_key_cert_pairs();
  if (!options.client_authorities.empty()) {
    credentials.watch_root_certs();
    credentials.set_cert_request_type(
        GRPC_SSL_REQUEST_AND_REQUIRE_CLIENT_CERTIFICATE_AND_VERIFY);
  }
  return tls::TlsServerCredentials(credentials);
}

}  // namespace argmesh
