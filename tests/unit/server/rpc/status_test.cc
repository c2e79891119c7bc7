#include "server/rpc/status.h"

#include <gmock/gmock.h>
#include <google/protobuf/any.pb.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "absl/time/time.h"
#include "argmesh/v1/error_reason.pb.h"
#include "google/rpc/error_details.pb.h"
#include "server/engine/error_reason.h"

namespace argmesh {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

template <typename Detail>
bool Find(const google::rpc::Status& status, Detail* out) {
  for (const google::protobuf::Any& any : status.details()) {
    if (any.UnpackTo(out)) return true;
  }
  return false;
}

TEST(ToProtoStatus, GivesEveryReasonOfTheApiItsNameCodeAndDomain) {
  const auto* reasons = v1::ErrorReason_descriptor();
  for (int i = 0; i < reasons->value_count(); ++i) {
    const auto* value = reasons->value(i);
    if (value->number() == 0) continue;
    const auto reason = static_cast<ErrorReason>(value->number());
    const google::rpc::Status status =
        ToProtoStatus(MakeError(reason, "why", {{"key", "value"}}), "id-1");
    google::rpc::ErrorInfo info;
    ASSERT_TRUE(Find(status, &info)) << value->name();
    EXPECT_EQ("ERROR_REASON_" + info.reason(), value->name());
    EXPECT_EQ(info.domain(), "argmesh.v1");
    EXPECT_EQ(status.code(), static_cast<int>(ErrorReasonCode(reason)));
    EXPECT_NE(status.code(), 0);
    if (reason == ErrorReason::kInternal) continue;
    EXPECT_EQ(info.metadata().at("key"), "value");
    EXPECT_EQ(status.message(), "why");
  }
}

TEST(ToProtoStatus, AddsTheDetailsThatTheCodeAsksFor) {
  google::rpc::QuotaFailure quota;
  google::rpc::RetryInfo retry;
  google::rpc::Status status = ToProtoStatus(WithRetryDelay(
      MakeError(ErrorReason::kOverloaded, "busy"), absl::Milliseconds(1500)));
  ASSERT_TRUE(Find(status, &quota));
  ASSERT_TRUE(Find(status, &retry));
  EXPECT_EQ(retry.retry_delay().seconds(), 1);
  EXPECT_EQ(retry.retry_delay().nanos(), 500'000'000);

  google::rpc::ResourceInfo resource;
  status = ToProtoStatus(MakeError(ErrorReason::kShapeNotFound, "none",
                                   {{"collection", "c"}, {"shape", "s"}}));
  ASSERT_TRUE(Find(status, &resource));
  EXPECT_EQ(resource.resource_type(), "shape");
  EXPECT_EQ(resource.resource_name(), "collections/c/shapes/s");

  google::rpc::BadRequest bad;
  status = ToProtoStatus(FieldInvalid("limit", "too large"));
  ASSERT_TRUE(Find(status, &bad));
  EXPECT_EQ(bad.field_violations(0).field(), "limit");

  google::rpc::PreconditionFailure precondition;
  status = ToProtoStatus(MakeError(ErrorReason::kCollectionNotEmpty, "full",
                                   {{"collection", "c"}}));
  ASSERT_TRUE(Find(status, &precondition));
  EXPECT_EQ(precondition.violations(0).type(), "COLLECTION_NOT_EMPTY");
}

TEST(ToProtoStatus, ShowsNothingOfADefect) {
  for (const absl::Status& defect :
       {MakeError(ErrorReason::kInternal, "secret at 0xdead"),
        absl::InternalError("secret at 0xdead"),
        absl::UnknownError("secret at 0xdead"),
        absl::InvalidArgumentError("secret that nobody classified")}) {
    const google::rpc::Status status = ToProtoStatus(defect, "id-7");
    EXPECT_EQ(status.code(), static_cast<int>(absl::StatusCode::kInternal));
    EXPECT_THAT(status.SerializeAsString(), Not(HasSubstr("secret")));
    google::rpc::RequestInfo request;
    ASSERT_TRUE(Find(status, &request));
    EXPECT_EQ(request.request_id(), "id-7");
  }
}

TEST(ToProtoStatus, KnowsPlainCancellationAndDeadline) {
  google::rpc::ErrorInfo info;
  const google::rpc::Status late =
      ToProtoStatus(absl::DeadlineExceededError("late"));
  ASSERT_TRUE(Find(late, &info));
  EXPECT_EQ(info.reason(), "DEADLINE_EXCEEDED");
  const google::rpc::Status gone = ToProtoStatus(absl::CancelledError("gone"));
  ASSERT_TRUE(Find(gone, &info));
  EXPECT_EQ(info.reason(), "CANCELLED");
}

TEST(ToGrpcStatus, CarriesTheDetailsAsBytes) {
  const google::rpc::Status status = ToProtoStatus(FieldRequired("name"));
  const grpc::Status grpc_status = ToGrpcStatus(status);
  EXPECT_EQ(grpc_status.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_EQ(grpc_status.error_message(), status.message());
  google::rpc::Status parsed;
  ASSERT_TRUE(parsed.ParseFromString(grpc_status.error_details()));
  EXPECT_EQ(parsed.SerializeAsString(), status.SerializeAsString());
  EXPECT_TRUE(ToGrpcStatus(ToProtoStatus(absl::OkStatus())).ok());
}

}  // namespace
}  // namespace argmesh
