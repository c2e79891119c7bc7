#include "client/error_status.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "google/rpc/error_details.pb.h"

namespace argmesh {
namespace {

google::rpc::Status Overloaded() {
  google::rpc::Status status;
  status.set_code(8);
  status.set_message("too much in flight");
  google::rpc::ErrorInfo info;
  info.set_reason("OVERLOADED");
  status.add_details()->PackFrom(info);
  google::rpc::RetryInfo retry;
  retry.mutable_retry_delay()->set_seconds(2);
  status.add_details()->PackFrom(retry);
  return status;
}

TEST(ErrorStatus, KeepsTheReasonAndPutsItBeforeTheMessage) {
  const absl::Status status = ToStatus(Overloaded());
  EXPECT_EQ(status.code(), absl::StatusCode::kResourceExhausted);
  EXPECT_EQ(std::string(status.message()), "OVERLOADED: too much in flight");
  EXPECT_EQ(ErrorReason(status), "OVERLOADED");
  EXPECT_EQ(ErrorText(status), "too much in flight");
  EXPECT_EQ(RetryDelay(status), absl::Seconds(2));
}

TEST(ErrorStatus, ReadsTheDetailsOfAGrpcStatus) {
  const google::rpc::Status details = Overloaded();
  const grpc::Status failed(grpc::StatusCode::RESOURCE_EXHAUSTED,
                            details.message(), details.SerializeAsString());
  EXPECT_EQ(ErrorReason(ToStatus(failed)), "OVERLOADED");
  EXPECT_TRUE(ToStatus(grpc::Status::OK).ok());
}

TEST(ErrorStatus, SurvivesDetailsThatAreNone) {
  const grpc::Status failed(grpc::StatusCode::NOT_FOUND, "gone", "\xff\xff");
  const absl::Status status = ToStatus(failed);
  EXPECT_EQ(status.code(), absl::StatusCode::kNotFound);
  EXPECT_EQ(ErrorReason(status), "");
  EXPECT_EQ(ErrorText(status), "gone");
}

TEST(ErrorStatus, TellsUnknownCodesFromKnownOnes) {
  google::rpc::Status status;
  status.set_code(99);
  EXPECT_EQ(ToStatus(status).code(), absl::StatusCode::kUnknown);
}

TEST(ErrorStatus, TriesAgainOnlyWhereItMayHelp) {
  EXPECT_TRUE(IsRetryable(absl::UnavailableError("x")));
  EXPECT_TRUE(IsRetryable(ToStatus(Overloaded())));
  EXPECT_FALSE(IsRetryable(absl::ResourceExhaustedError("mesh too large")));
  EXPECT_FALSE(IsRetryable(absl::NotFoundError("x")));
}

TEST(ErrorStatus, TellsASilentServerFromOneThatDrains) {
  EXPECT_TRUE(IsUnreachable(absl::UnavailableError("connection refused")));
  EXPECT_FALSE(IsUnreachable(
      MakeStatus(absl::StatusCode::kUnavailable, "DRAINING", "going down")));
}

}  // namespace
}  // namespace argmesh
