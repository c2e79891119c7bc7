// Why a call failed: the reasons a client can act on, attached to a status.
//
// Each reason has one status code. Names and numbers are those of
// argmesh.v1.ErrorReason (without `ERROR_REASON_`), so that the rpc layer maps
// them by value.
#ifndef ARGMESH_SERVER_ENGINE_ERROR_REASON_H_
#define ARGMESH_SERVER_ENGINE_ERROR_REASON_H_

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "absl/time/time.h"

namespace argmesh {

enum class ErrorReason {
  kFieldInvalid = 1,
  kFieldRequired = 2,
  kNameInvalid = 3,
  kPageTokenInvalid = 4,
  kFilterInvalid = 5,
  kStreamOrderInvalid = 6,
  kRequestIdReused = 7,
  kFilterKeyUndeclared = 8,

  kMeshMalformed = 20,
  kMeshFormatUnknown = 21,
  kMeshEmpty = 22,
  kMeshDegenerate = 23,
  kMeshTooLarge = 24,
  kMeshSizeMismatch = 25,
  kMeshDigestMismatch = 26,
  kMeshNotStored = 27,
  kImportNotEnabled = 28,
  kFileUnreadable = 29,

  kCollectionNotFound = 40,
  kCollectionExists = 41,
  kCollectionNotEmpty = 42,
  kShapeNotFound = 43,
  kShapeExists = 44,
  kNodeNotFound = 46,
  kEtagMismatch = 47,
  kGraphVersionMismatch = 48,
  kGraphInvalid = 49,
  kSnapshotNotFound = 50,
  kSnapshotExists = 51,
  kOperationNotFound = 52,

  kOverloaded = 60,
  kStoreFull = 61,
  kCreditExceeded = 62,
  kResponseTooLarge = 63,
  kKeyLimitExceeded = 64,

  kKeyMissing = 70,
  kKeyInvalid = 71,
  kKeyExpired = 72,
  kPermissionDenied = 73,

  kDraining = 80,
  kIndexLoading = 81,
  kGenerationNotReached = 82,
  kStoreUnavailable = 83,
  kStreamIdle = 84,

  kStoredDataDamaged = 90,

  kDeadlineExceeded = 100,
  kCancelled = 101,
  kMethodNotServed = 110,
  kInternal = 120,
};

// "SHAPE_NOT_FOUND"
std::string_view ErrorReasonName(ErrorReason reason);
absl::StatusCode ErrorReasonCode(ErrorReason reason);

// Ordered, so that equal errors serialise equally.
using ErrorMetadata = std::map<std::string, std::string>;

// A status with the reason's code that carries reason and metadata. Everything
// in the message that a program may need is in `metadata` too.
absl::Status MakeError(ErrorReason reason, std::string_view message,
                       const ErrorMetadata& metadata = {});

// The same error, saying when a retry may help.
absl::Status WithRetryDelay(absl::Status status, absl::Duration delay);

// None when the status was not made by MakeError. A plain kCancelled or
// kDeadlineExceeded status has its own reason nevertheless.
std::optional<ErrorReason> ReasonOf(const absl::Status& status);
ErrorMetadata MetadataOf(const absl::Status& status);
std::optional<absl::Duration> RetryDelayOf(const absl::Status& status);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_ERROR_REASON_H_
