#include "server/engine/error_reason.h"

#include <algorithm>
#include <string>
#include <vector>

#include "tests/support/status_matchers.h"

namespace argmesh {
namespace {

TEST(MakeError, GivesBackReasonCodeAndMetadata) {
  const ErrorMetadata metadata = {{"shape", "a"}, {"line", "12"}, {"x", ""}};
  const absl::Status status =
      MakeError(ErrorReason::kShapeNotFound, "no shape a", metadata);
  EXPECT_THAT(status, StatusIs(absl::StatusCode::kNotFound, "no shape a"));
  EXPECT_EQ(ReasonOf(status), ErrorReason::kShapeNotFound);
  EXPECT_EQ(MetadataOf(status), metadata);
  EXPECT_FALSE(RetryDelayOf(status).has_value());
}

TEST(MakeError, KeepsEveryReasonApart) {
  std::vector<std::string> names;
  for (int number = 1; number <= 120; ++number) {
    const auto reason = static_cast<ErrorReason>(number);
    const std::string name(ErrorReasonName(reason));
    if (name == "INTERNAL" && reason != ErrorReason::kInternal) continue;
    EXPECT_EQ(std::count(names.begin(), names.end(), name), 0) << name;
    names.push_back(name);
    const absl::Status status = MakeError(reason, "x");
    EXPECT_FALSE(status.ok()) << name;
    EXPECT_EQ(ReasonOf(status), reason) << name;
  }
  EXPECT_EQ(names.size(), 49U);
}

TEST(WithRetryDelay, SaysWhenToComeAgain) {
  const absl::Status status = WithRetryDelay(
      MakeError(ErrorReason::kOverloaded, "busy"), absl::Milliseconds(1500));
  EXPECT_EQ(RetryDelayOf(status), absl::Milliseconds(1500));
  EXPECT_EQ(ReasonOf(status), ErrorReason::kOverloaded);
}

TEST(ReasonOf, KnowsPlainCancellationsAndDeadlines) {
  EXPECT_EQ(ReasonOf(absl::CancelledError("x")), ErrorReason::kCancelled);
  EXPECT_EQ(ReasonOf(absl::DeadlineExceededError("x")),
            ErrorReason::kDeadlineExceeded);
  EXPECT_FALSE(ReasonOf(absl::InternalError("x")).has_value());
  EXPECT_FALSE(ReasonOf(absl::OkStatus()).has_value());
}

}  // namespace
}  // namespace argmesh
