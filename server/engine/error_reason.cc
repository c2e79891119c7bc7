#include "server/engine/error_reason.h"

#include <algorithm>
#include <iterator>

#include "absl/strings/cord.h"
#include "core/base/byte_reader.h"
#include "core/base/byte_writer.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

constexpr char kReasonUrl[] = "argmesh/error-reason";
constexpr char kMetadataUrl[] = "argmesh/error-metadata";
constexpr char kRetryUrl[] = "argmesh/retry-delay-seconds";

struct ReasonEntry {
  ErrorReason reason;
  const char* name;
  absl::StatusCode code;
};

constexpr auto kInvalid = absl::StatusCode::kInvalidArgument;
constexpr auto kExhausted = absl::StatusCode::kResourceExhausted;
constexpr auto kPrecondition = absl::StatusCode::kFailedPrecondition;
constexpr auto kUnavailable = absl::StatusCode::kUnavailable;

constexpr ReasonEntry kReasons[] = {
    {ErrorReason::kFieldInvalid, "FIELD_INVALID", kInvalid},
    {ErrorReason::kFieldRequired, "FIELD_REQUIRED", kInvalid},
    {ErrorReason::kNameInvalid, "NAME_INVALID", kInvalid},
    {ErrorReason::kPageTokenInvalid, "PAGE_TOKEN_INVALID", kInvalid},
    {ErrorReason::kFilterInvalid, "FILTER_INVALID", kInvalid},
    {ErrorReason::kStreamOrderInvalid, "STREAM_ORDER_INVALID", kInvalid},
    {ErrorReason::kRequestIdReused, "REQUEST_ID_REUSED", kInvalid},
    {ErrorReason::kFilterKeyUndeclared, "FILTER_KEY_UNDECLARED", kInvalid},
    {ErrorReason::kMeshMalformed, "MESH_MALFORMED", kInvalid},
    {ErrorReason::kMeshFormatUnknown, "MESH_FORMAT_UNKNOWN", kInvalid},
    {ErrorReason::kMeshEmpty, "MESH_EMPTY", kInvalid},
    {ErrorReason::kMeshDegenerate, "MESH_DEGENERATE", kPrecondition},
    {ErrorReason::kMeshTooLarge, "MESH_TOO_LARGE", kExhausted},
    {ErrorReason::kMeshSizeMismatch, "MESH_SIZE_MISMATCH", kInvalid},
    {ErrorReason::kMeshDigestMismatch, "MESH_DIGEST_MISMATCH", kInvalid},
    {ErrorReason::kMeshNotStored, "MESH_NOT_STORED", kPrecondition},
    {ErrorReason::kImportNotEnabled, "IMPORT_NOT_ENABLED", kPrecondition},
    {ErrorReason::kFileUnreadable, "FILE_UNREADABLE", kPrecondition},
    {ErrorReason::kCollectionNotFound, "COLLECTION_NOT_FOUND",
     absl::StatusCode::kNotFound},
    {ErrorReason::kCollectionExists, "COLLECTION_EXISTS",
     absl::StatusCode::kAlreadyExists},
    {ErrorReason::kCollectionNotEmpty, "COLLECTION_NOT_EMPTY", kPrecondition},
    {ErrorReason::kShapeNotFound, "SHAPE_NOT_FOUND",
     absl::StatusCode::kNotFound},
    {ErrorReason::kShapeExists, "SHAPE_EXISTS",
     absl::StatusCode::kAlreadyExists},
    {ErrorReason::kNodeNotFound, "NODE_NOT_FOUND", absl::StatusCode::kNotFound},
    {ErrorReason::kEtagMismatch, "ETAG_MISMATCH", absl::StatusCode::kAborted},
    {ErrorReason::kGraphVersionMismatch, "GRAPH_VERSION_MISMATCH",
     kPrecondition},
    {ErrorReason::kGraphInvalid, "GRAPH_INVALID", kInvalid},
    {ErrorReason::kSnapshotNotFound, "SNAPSHOT_NOT_FOUND",
     absl::StatusCode::kNotFound},
    {ErrorReason::kSnapshotExists, "SNAPSHOT_EXISTS",
     absl::StatusCode::kAlreadyExists},
    {ErrorReason::kOperationNotFound, "OPERATION_NOT_FOUND",
     absl::StatusCode::kNotFound},
    {ErrorReason::kOverloaded, "OVERLOADED", kExhausted},
    {ErrorReason::kStoreFull, "STORE_FULL", kExhausted},
    {ErrorReason::kCreditExceeded, "CREDIT_EXCEEDED", kExhausted},
    {ErrorReason::kResponseTooLarge, "RESPONSE_TOO_LARGE", kExhausted},
    {ErrorReason::kKeyLimitExceeded, "KEY_LIMIT_EXCEEDED", kExhausted},
    {ErrorReason::kKeyMissing, "KEY_MISSING",
     absl::StatusCode::kUnauthenticated},
    {ErrorReason::kKeyInvalid, "KEY_INVALID",
     absl::StatusCode::kUnauthenticated},
    {ErrorReason::kKeyExpired, "KEY_EXPIRED",
     absl::StatusCode::kUnauthenticated},
    {ErrorReason::kPermissionDenied, "PERMISSION_DENIED",
     absl::StatusCode::kPermissionDenied},
    {ErrorReason::kDraining, "DRAINING", kUnavailable},
    {ErrorReason::kIndexLoading, "INDEX_LOADING", kUnavailable},
    {ErrorReason::kGenerationNotReached, "GENERATION_NOT_REACHED",
     kUnavailable},
    {ErrorReason::kStoreUnavailable, "STORE_UNAVAILABLE", kUnavailable},
    {ErrorReason::kStreamIdle, "STREAM_IDLE", kUnavailable},
    {ErrorReason::kStoredDataDamaged, "STORED_DATA_DAMAGED",
     absl::StatusCode::kDataLoss},
    {ErrorReason::kDeadlineExceeded, "DEADLINE_EXCEEDED",
     absl::StatusCode::kDeadlineExceeded},
    {ErrorReason::kCancelled, "CANCELLED", absl::StatusCode::kCancelled},
    {ErrorReason::kMethodNotServed, "METHOD_NOT_SERVED",
     absl::StatusCode::kUnimplemented},
    {ErrorReason::kInternal, "INTERNAL", absl::StatusCode::kInternal},
};

const ReasonEntry& EntryOf(ErrorReason reason) {
  const auto* entry = std::find_if(
      std::begin(kReasons), std::end(kReasons),
      [reason](const ReasonEntry& e) { return e.reason == reason; });
  return entry == std::end(kReasons) ? *std::prev(std::end(kReasons)) : *entry;
}

void WriteText(ByteWriter& writer, std::string_view text) {
  writer.WriteU32(static_cast<uint32_t>(text.size()));
  writer.WriteBytes(text);
}

absl::StatusOr<std::string> ReadText(ByteReader& reader) {
  ARGMESH_ASSIGN_OR_RETURN(const uint32_t size, reader.ReadCount(1));
  ARGMESH_ASSIGN_OR_RETURN(const std::string_view text, reader.ReadBytes(size));
  return std::string(text);
}

absl::StatusOr<ErrorMetadata> ParseMetadata(std::string_view bytes) {
  ByteReader reader(bytes, "error metadata");
  ErrorMetadata metadata;
  while (reader.remaining() > 0) {
    ARGMESH_ASSIGN_OR_RETURN(std::string key, ReadText(reader));
    ARGMESH_ASSIGN_OR_RETURN(metadata[key], ReadText(reader));
  }
  return metadata;
}

}  // namespace

std::string_view ErrorReasonName(ErrorReason reason) {
  return EntryOf(reason).name;
}

absl::StatusCode ErrorReasonCode(ErrorReason reason) {
  return EntryOf(reason).code;
}

absl::Status MakeError(ErrorReason reason, std::string_view message,
                       const ErrorMetadata& metadata) {
  absl::Status status(ErrorReasonCode(reason),
                      absl::string_view(message.data(), message.size()));
  status.SetPayload(kReasonUrl, absl::Cord(EntryOf(reason).name));
  ByteWriter writer;
  for (const auto& [key, value] : metadata) {
    WriteText(writer, key);
    WriteText(writer, value);
  }
  if (!metadata.empty()) {
    status.SetPayload(kMetadataUrl, absl::Cord(writer.TakeBytes()));
  }
  return status;
}

absl::Status WithRetryDelay(absl::Status status, absl::Duration delay) {
  ByteWriter writer;
  writer.WriteF64(absl::ToDoubleSeconds(delay));
  status.SetPayload(kRetryUrl, absl::Cord(writer.TakeBytes()));
  return status;
}

std::optional<ErrorReason> ReasonOf(const absl::Status& status) {
  if (const auto payload = status.GetPayload(kReasonUrl)) {
    const std::string name(*payload);
    for (const ReasonEntry& entry : kReasons) {
      if (name == entry.name) return entry.reason;
    }
  }
  if (absl::IsCancelled(status)) return ErrorReason::kCancelled;
  if (absl::IsDeadlineExceeded(status)) return ErrorReason::kDeadlineExceeded;
  return std::nullopt;
}

ErrorMetadata MetadataOf(const absl::Status& status) {
  const auto payload = status.GetPayload(kMetadataUrl);
  if (!payload) return {};
  return ParseMetadata(std::string(*payload)).value_or(ErrorMetadata());
}

std::optional<absl::Duration> RetryDelayOf(const absl::Status& status) {
  const auto payload = status.GetPayload(kRetryUrl);
  if (!payload) return std::nullopt;
  const std::string bytes(*payload);
  ByteReader reader(bytes, "retry delay");
  const absl::StatusOr<double> seconds = reader.ReadF64();
  if (!seconds.ok()) return std::nullopt;
  return absl::Seconds(*seconds);
}

}  // namespace argmesh
