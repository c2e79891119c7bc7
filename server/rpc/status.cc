#include "server/rpc/status.h"

#include <optional>
#include <string>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/time/time.h"
#include "google/rpc/error_details.pb.h"
#include "server/engine/error_reason.h"
#include "server/rpc/peer_pace.h"
#include "server/rpc/service_environment.h"

namespace argmesh {
namespace {

ErrorReason ReasonOrInternal(const absl::Status& status) {
  if (const auto reason = ReasonOf(status)) return *reason;
  switch (status.code()) {
    case absl::StatusCode::kCancelled:
      return ErrorReason::kCancelled;
    case absl::StatusCode::kDeadlineExceeded:
      return ErrorReason::kDeadlineExceeded;
    default:
      // A status nobody classified is a defect, whatever its code.
      return ErrorReason::kInternal;
  }
}

std::string Find(const ErrorMetadata& metadata, const char* key) {
  const auto it = metadata.find(key);
  return it == metadata.end() ? std::string() : it->second;
}

template <typename Detail>
void AddDetail(google::rpc::Status* out, const Detail& detail) {
  out->add_details()->PackFrom(detail);
}

void AddQuota(google::rpc::Status* out, ErrorReason reason,
              std::string_view message) {
  google::rpc::QuotaFailure quota;
  auto* violation = quota.add_violations();
  violation->set_subject(std::string(ErrorReasonName(reason)));
  violation->set_description(std::string(message));
  AddDetail(out, quota);
}

void AddPrecondition(google::rpc::Status* out, ErrorReason reason,
                     const std::string& subject, std::string_view message) {
  google::rpc::PreconditionFailure precondition;
  auto* violation = precondition.add_violations();
  violation->set_type(std::string(ErrorReasonName(reason)));
  violation->set_subject(subject);
  violation->set_description(std::string(message));
  AddDetail(out, precondition);
}

void AddBadRequest(google::rpc::Status* out, const std::string& field,
                   std::string_view message) {
  google::rpc::BadRequest bad;
  auto* violation = bad.add_field_violations();
  violation->set_field(field);
  violation->set_description(std::string(message));
  AddDetail(out, bad);
}

// What the engine calls a resource: metadata `shape` with `collection`, or
// `collection` alone.
void AddResource(google::rpc::Status* out, const ErrorMetadata& metadata) {
  const std::string collection = Find(metadata, "collection");
  const std::string shape = Find(metadata, "shape");
  if (collection.empty()) return;
  google::rpc::ResourceInfo resource;
  resource.set_resource_type(shape.empty() ? "collection" : "shape");
  resource.set_resource_name(
      shape.empty()
          ? absl::StrCat("collections/", collection)
          : absl::StrCat("collections/", collection, "/shapes/", shape));
  resource.set_description(out->message());
  AddDetail(out, resource);
}

void AddRetry(google::rpc::Status* out, absl::Duration delay) {
  google::rpc::RetryInfo retry;
  const int64_t millis = absl::ToInt64Milliseconds(delay);
  retry.mutable_retry_delay()->set_seconds(millis / 1000);
  retry.mutable_retry_delay()->set_nanos(
      static_cast<int32_t>(millis % 1000 * 1'000'000));
  AddDetail(out, retry);
}

void AddDetailsOfCode(google::rpc::Status* out, ErrorReason reason,
                      const ErrorMetadata& metadata) {
  switch (ErrorReasonCode(reason)) {
    case absl::StatusCode::kInvalidArgument:
      if (const std::string field = Find(metadata, "field"); !field.empty()) {
        AddBadRequest(out, field, out->message());
      }
      break;
    case absl::StatusCode::kResourceExhausted:
      AddQuota(out, reason, out->message());
      break;
    case absl::StatusCode::kFailedPrecondition:
      AddPrecondition(out, reason, Find(metadata, "collection"),
                      out->message());
      break;
    case absl::StatusCode::kNotFound:
    case absl::StatusCode::kAlreadyExists:
    case absl::StatusCode::kAborted:
    case absl::StatusCode::kDataLoss:
      AddResource(out, metadata);
      break;
    default:
      break;
  }
}

google::rpc::Status InternalStatus(std::string_view request_id) {
  google::rpc::Status out;
  out.set_code(static_cast<int>(absl::StatusCode::kInternal));
  out.set_message("internal error");
  google::rpc::ErrorInfo info;
  info.set_reason(std::string(ErrorReasonName(ErrorReason::kInternal)));
  info.set_domain(kErrorDomain);
  AddDetail(&out, info);
  if (!request_id.empty()) {
    google::rpc::RequestInfo request;
    request.set_request_id(std::string(request_id));
    AddDetail(&out, request);
  }
  return out;
}

}  // namespace

google::rpc::Status ToProtoStatus(const absl::Status& status,
                                  std::string_view request_id) {
  google::rpc::Status out;
  if (status.ok()) return out;
  const ErrorReason reason = ReasonOrInternal(status);
  if (reason == ErrorReason::kInternal) return InternalStatus(request_id);

  const ErrorMetadata metadata = MetadataOf(status);
  out.set_code(static_cast<int>(ErrorReasonCode(reason)));
  out.set_message(std::string(status.message()));
  google::rpc::ErrorInfo info;
  info.set_reason(std::string(ErrorReasonName(reason)));
  info.set_domain(kErrorDomain);
  for (const auto& [key, value] : metadata) {
    (*info.mutable_metadata())[key] = value;
  }
  AddDetail(&out, info);
  AddDetailsOfCode(&out, reason, metadata);
  if (const auto delay = RetryDelayOf(status)) AddRetry(&out, *delay);
  return out;
}

grpc::Status ToGrpcStatus(const google::rpc::Status& status) {
  if (status.code() == 0) return grpc::Status::OK;
  return grpc::Status(static_cast<grpc::StatusCode>(status.code()),
                      status.message(), status.SerializeAsString());
}

absl::Status MethodNotServed(std::string_view method) {
  return MakeError(
      ErrorReason::kMethodNotServed,
      absl::StrFormat("%s is declared but not served by this version",
                      std::string(method)),
      {{"method", std::string(method)}});
}

absl::Status FieldInvalid(std::string_view field, std::string_view why) {
  return MakeError(
      ErrorReason::kFieldInvalid,
      absl::StrFormat("%s: %s", std::string(field), std::string(why)),
      {{"field", std::string(field)}});
}

absl::Status FieldRequired(std::string_view field) {
  return MakeError(ErrorReason::kFieldRequired,
                   absl::StrFormat("%s is required", std::string(field)),
                   {{"field", std::string(field)}});
}

absl::Status StreamIdle(absl::Duration limit) {
  return WithRetryDelay(
      MakeError(
          ErrorReason::kStreamIdle,
          absl::StrFormat("nothing came for %s", absl::FormatDuration(limit)),
          {{"limit_seconds", absl::StrCat(absl::ToDoubleSeconds(limit))}}),
      absl::Seconds(1));
}

absl::Status StreamTooSlow(absl::Duration limit) {
  return WithRetryDelay(
      MakeError(
          ErrorReason::kStreamIdle,
          absl::StrFormat("nothing came for %s, or less than %d bytes a second",
                          absl::FormatDuration(limit), kLeastBytesPerSecond),
          {{"limit_seconds", absl::StrCat(absl::ToDoubleSeconds(limit))},
           {"least_bytes_per_second", absl::StrCat(kLeastBytesPerSecond)}}),
      absl::Seconds(1));
}

absl::Status StreamOrderInvalid(std::string_view why) {
  return MakeError(ErrorReason::kStreamOrderInvalid, std::string(why));
}

absl::Status TooManySlowRequests() {
  return WithRetryDelay(
      MakeError(ErrorReason::kOverloaded,
                "too many requests that do not come whole; this connection has "
                "the most of them"),
      absl::Seconds(1));
}

absl::Status TooManyUnreadAnswers() {
  return WithRetryDelay(
      MakeError(ErrorReason::kOverloaded,
                absl::StrFormat(
                    "this connection has not taken answers of %d bytes or more",
                    kMaxUnreadBytesOfAPeer)),
      absl::Seconds(1));
}

absl::Status TooManyCallsOfAConnection() {
  return WithRetryDelay(
      MakeError(ErrorReason::kOverloaded,
                "this connection resets calls faster than they can end"),
      absl::Seconds(1));
}

absl::Status ServerDraining() {
  return WithRetryDelay(
      MakeError(ErrorReason::kDraining, "the server is going down"),
      absl::Seconds(1));
}

}  // namespace argmesh
