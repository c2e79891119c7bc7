#include "client/cli/session.h"

#include <cstdlib>
#include <fstream>

#include "absl/strings/ascii.h"
#include "client/error_status.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

constexpr char kUsageReason[] = "USAGE";

// From the file, else from the environment; never from the command line, which
// every user of the machine can read.
absl::StatusOr<std::string> KeyOf(const GlobalOptions& options) {
  if (options.key_file.empty()) {
    const char* key = std::getenv("ARGMESH_KEY");
    return std::string(key == nullptr ? "" : key);
  }
  std::ifstream in(options.key_file);
  std::string key;
  std::getline(in, key);
  absl::StripAsciiWhitespace(&key);
  if (key.empty()) {
    return UsageError("--key-file " + options.key_file +
                      " cannot be read, or its first line is empty");
  }
  return key;
}

}  // namespace

absl::StatusOr<std::unique_ptr<Client>> Session::Connect() const {
  ClientOptions client_options;
  client_options.call_timeout = absl::Seconds(options.timeout_seconds);
  client_options.user_agent = "argmesh-cli";
  client_options.tls = options.tls;
  // Naming any file asks for TLS.
  client_options.tls.enabled |= !options.tls.authorities.empty() ||
                                !options.tls.certificate.empty() ||
                                !options.tls.server_name.empty();
  ARGMESH_ASSIGN_OR_RETURN(client_options.api_key, KeyOf(options));
  auto client = Client::Connect(options.server, client_options);
  if (!client.ok()) return UsageError(std::string(client.status().message()));
  return client;
}

void Session::Print(const Json& json) const {
  // Bytes that are not UTF-8 can only come from file names; they are shown as
  // the replacement character.
  out << json.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
}

void Session::Note(std::string_view text) const {
  err << "argmesh: " << text << '\n';
}

int Session::Fail(const absl::Status& status) const {
  const std::string reason = ErrorReason(status);
  if (reason.empty() || reason == kUsageReason) {
    Note(ErrorText(status));
  } else {
    Note(ErrorText(status) + " [" + reason + "]");
  }
  if (options.json) Print(Json{{"error", ErrorToJson(status)}});
  return ExitCodeOf(status);
}

absl::Status UsageError(std::string_view message) {
  return MakeStatus(absl::StatusCode::kInvalidArgument, kUsageReason, message);
}

int ExitCodeOf(const absl::Status& status) {
  if (status.ok()) return kExitOk;
  if (ErrorReason(status) == kUsageReason) return kExitUsage;
  if (IsUnreachable(status)) return kExitUnreachable;
  if (status.code() == absl::StatusCode::kCancelled) return kExitInterrupted;
  return kExitFailed;
}

}  // namespace argmesh
