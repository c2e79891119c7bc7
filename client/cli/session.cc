#include "client/cli/session.h"

#include "client/error_status.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

constexpr char kUsageReason[] = "USAGE";

}  // namespace

absl::StatusOr<std::unique_ptr<Client>> Session::Connect() const {
  ClientOptions client_options;
  client_options.call_timeout = absl::Seconds(options.timeout_seconds);
  client_options.user_agent = "argmesh-cli";
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
