#include "server/rpc/call_scope.h"

#include <chrono>
#include <exception>
#include <new>
#include <random>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "server/engine/error_reason.h"
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

}  // namespace

CallScope::CallScope(ServiceEnvironment& environment,
                     grpc::CallbackServerContext* context, const char* method)
    : environment_(environment),
      context_(context),
      method_(method),
      stop_(stop_source_.get_token(), DeadlineOf(*context)) {}

bool CallScope::MarkFinished() {
  const std::lock_guard lock(mutex_);
  return !std::exchange(finished_, true);
}

grpc::Status CallScope::Report(const absl::Status& status) {
  return status.ok() ? grpc::Status::OK : ToGrpcStatus(ReportProto(status));
}

google::rpc::Status CallScope::ReportProto(const absl::Status& status) {
  const std::string request_id = NextRequestId();
  google::rpc::Status report = ToProtoStatus(status, request_id);
  if (report.code() == static_cast<int>(absl::StatusCode::kInternal) ||
      report.code() == static_cast<int>(absl::StatusCode::kDataLoss)) {
    environment_.log.Write(LogLevel::kError, "call failed",
                           {{"method", std::string(method_)},
                            {"request_id", request_id},
                            {"error", status.ToString()}});
  }
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
