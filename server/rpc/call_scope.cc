#include "server/rpc/call_scope.h"

#include <chrono>
#include <exception>
#include <new>
#include <random>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/time/clock.h"
#include "core/base/status_macros.h"
#include "core/base/utf8_prefix.h"
#include "server/engine/error_reason.h"
#include "server/rpc/request_names.h"
#include "server/rpc/status.h"

namespace argmesh {
namespace {

absl::Time DeadlineOf(const grpc::CallbackServerContext& context) {
  const auto deadline = context.deadline();
  return deadline == std::chrono::system_clock::time_point::max()
             ? absl::InfiniteFuture()
             : absl::FromChrono(deadline);
}

// Ids of different runs of the server must differ in one log.
std::string NextRequestId() {
  static const uint32_t run = std::random_device()();
  static std::atomic<uint64_t> counter{0};
  return absl::StrFormat("%08x-%d", run, counter.fetch_add(1) + 1);
}

// Of a name in the log; what a client sends may be megabytes.
constexpr size_t kMaxLoggedName = 256;

// A caller's header counts only as far as it is well-formed.
TraceContext TraceOf(const grpc::CallbackServerContext& context) {
  const auto& metadata = context.client_metadata();
  const auto header = metadata.find("traceparent");
  if (header == metadata.end()) return {};
  return ParseTraceparent(
      std::string_view(header->second.data(), header->second.size()));
}

}  // namespace

CallScope::CallScope(ServiceEnvironment& environment,
                     grpc::CallbackServerContext* context, const char* method)
    : environment_(environment),
      context_(context),
      stop_(stop_source_.get_token(), DeadlineOf(*context)) {
  record_.method = method;
  record_.peer = context->peer();
  record_.trace = TraceOf(*context);
  record_.begin = absl::Now();
  const AccessRule* rule = FindAccessRule(method);
  record_.writes = rule != nullptr && rule->writes;
  environment.telemetry.CallStarted(method);
}

absl::Status CallScope::Authorize() {
  ARGMESH_ASSIGN_OR_RETURN(caller_,
                           environment_.access.Authenticate(*context_));
  {
    const std::lock_guard lock(mutex_);
    record_.principal = caller_.principal;
  }
  ARGMESH_ASSIGN_OR_RETURN(KeyQuotas::Ticket quota,
                           environment_.access.Admit(caller_));
  {
    const std::lock_guard lock(mutex_);
    if (!finished_) quota_.swap(quota);  // else it is given back at once
  }
  return CheckRole(caller_, record_.method);
}

absl::Status CallScope::AuthorizeMessage(
    const google::protobuf::Message& message) {
  // As the keys are now: one may have been revoked, or have expired, since.
  ARGMESH_ASSIGN_OR_RETURN(caller_,
                           environment_.access.Authenticate(*context_));
  ARGMESH_RETURN_IF_ERROR(CheckRole(caller_, record_.method));
  std::vector<std::string> names = RequestNames(message);
  const bool named = !record_.resource.empty();
  if (named && names.empty()) names.push_back(record_.resource);
  ARGMESH_RETURN_IF_ERROR(CheckNames(caller_, record_.method, names));
  if (!named && !names.empty()) {
    const std::lock_guard lock(mutex_);
    record_.resource = Utf8Prefix(names.front(), kMaxLoggedName);
  }
  return absl::OkStatus();
}

void CallScope::ReleaseQuota() {
  KeyQuotas::Ticket released;
  const std::lock_guard lock(mutex_);
  released.swap(quota_);
}

void CallScope::MarkWorkBegin() {
  const std::lock_guard lock(mutex_);
  if (record_.work_begin == absl::InfiniteFuture()) {
    record_.work_begin = absl::Now();
  }
}

void CallScope::MarkWorkPostponed() {
  const std::lock_guard lock(mutex_);
  record_.work_begin = absl::InfiniteFuture();
}

bool CallScope::MarkFinished() {
  const std::lock_guard lock(mutex_);
  return !std::exchange(finished_, true);
}

google::rpc::Status CallScope::Describe(const absl::Status& status,
                                        CallRecord& record) {
  record.end = absl::Now();
  if (status.ok()) return {};
  record.request_id = NextRequestId();
  google::rpc::Status report = ToProtoStatus(status, record.request_id);
  record.code = static_cast<absl::StatusCode>(report.code());
  record.reason =
      ErrorReasonName(ReasonOf(status).value_or(ErrorReason::kInternal));
  if (record.code == absl::StatusCode::kInternal ||
      record.code == absl::StatusCode::kDataLoss) {
    record.internals = status.ToString();
  }
  return report;
}

grpc::Status CallScope::Report(const absl::Status& status) {
  CallRecord record;
  {
    const std::lock_guard lock(mutex_);
    record = record_;
  }
  grpc::Status report = ToGrpcStatus(Describe(status, record));
  environment_.telemetry.CallFinished(record);
  return report;
}

google::rpc::Status CallScope::ReportItem(const ShapeRef& item,
                                          const absl::Status& status) {
  CallRecord record;
  {
    const std::lock_guard lock(mutex_);
    record = record_;
  }
  record.resource =
      absl::StrCat("collections/", item.collection, "/shapes/",
                   std::string(Utf8Prefix(item.id, kMaxLoggedName)));
  google::rpc::Status report = Describe(status, record);
  environment_.telemetry.ItemFinished(record);
  return report;
}

absl::Status CallScope::CurrentException() {
  try {
    throw;
  } catch (const std::bad_alloc&) {
    return WithRetryDelay(
        MakeError(ErrorReason::kOverloaded, "the server is out of memory"),
        absl::Seconds(1));
  } catch (const std::exception& error) {
    return MakeError(ErrorReason::kInternal,
                     absl::StrCat("exception: ", error.what()));
  } catch (...) {
    return MakeError(ErrorReason::kInternal, "unknown exception");
  }
}

}  // namespace argmesh
