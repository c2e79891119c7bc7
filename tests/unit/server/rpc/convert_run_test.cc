#include "server/rpc/convert_run.h"

#include <gtest/gtest.h>

#include <string>

#include "server/engine/error_reason.h"
#include "server/rpc/service_environment.h"

namespace argmesh {
namespace {

// Each with a path of so many bytes.
RunReport Failures(size_t count, size_t path_bytes) {
  RunReport run;
  run.failed = static_cast<int64_t>(count);
  const absl::Status status =
      MakeError(ErrorReason::kMeshMalformed, "not a mesh");
  for (size_t i = 0; i < count; ++i) {
    run.failures.push_back({std::string(path_bytes, 'p'), status});
  }
  return run;
}

TEST(ImportAnswer, ListsFailures) {
  const v1::ImportShapesResponse answer = ImportAnswer(Failures(1000, 100));
  EXPECT_EQ(answer.failures_size(), 1000);
  EXPECT_EQ(answer.failures(0).path(), std::string(100, 'p'));
}

TEST(ImportAnswer, FitsInAMessageHoweverLongThePathsAre) {
  const v1::ImportShapesResponse answer = ImportAnswer(Failures(1000, 10'000));
  EXPECT_EQ(answer.failed(), 1000);
  EXPECT_GT(answer.failures_size(), 300);
  EXPECT_LT(answer.ByteSizeLong(), kMaxMessageBytes);
}

TEST(ReindexAnswer, FitsInAMessageHoweverLongTheNamesAre) {
  ReindexReport report;
  report.run = Failures(1000, 10'000);
  EXPECT_LT(ReindexAnswer(report).ByteSizeLong(), kMaxMessageBytes);
}

}  // namespace
}  // namespace argmesh
