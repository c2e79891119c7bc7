// Ten times the searches a server can answer: it goes on answering as many as
// before, no slower, and refuses the rest at once.
//
// ARGMESH_OVERLOAD_SECONDS of it; 5 when not set, and then how many and how
// fast is only said, as other work on the machine may have a part in it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>

#include "core/mesh/mesh_write.h"
#include "tests/reliability/search_load.h"
#include "tests/reliability/small_service.h"
#include "tests/support/environment_number.h"
#include "tests/support/test_meshes.h"

namespace argmesh {
namespace {

using std::chrono::seconds;

constexpr char kSeconds[] = "ARGMESH_OVERLOAD_SECONDS";
constexpr int kShapes = 10;
// As many as the server lets in of the load's few connections: the last quarter
// of its places is for others.
constexpr int kCallers = 12;
constexpr int kPlaces = 16;
constexpr auto kPeakTime = seconds(3);
constexpr double kTimes = 10;

constexpr double kLeastGoodput = 0.8;
constexpr double kMostSlower = 2;

v1::SearchShapesRequest SearchByMesh() {
  v1::SearchShapesRequest request;
  request.set_parent(kParts);
  request.mutable_mesh()->set_format(v1::MESH_FORMAT_OFF);
  request.mutable_mesh()->set_data(
      *SerializeMesh(MakeTorus(2, 0.7, 40, 24), MeshFormat::kOff));
  return request;
}

void Print(const char* what, const LoadOutcome& load) {
  std::printf(
      "measured: %s: %.0f answered a second, p50 %.0f ms, p99 %.0f ms, %d "
      "refused, %d failed\n",
      what, load.answered_per_second(), load.Quantile(0.5), load.p99(),
      load.refused, load.failed);
}

TEST(OverloadTest, AnswersAsManyAsBeforeAndNoSlower) {
  SmallService service;
  ASSERT_EQ(service.Start(kShapes,
                          {"--max-inflight-searches", std::to_string(kPlaces)}),
            "");
  SearchLoad load(service.address(), SearchByMesh());
  load.Closed(kCallers, seconds(1));  // first touches

  const LoadOutcome peak = load.Closed(kCallers, kPeakTime);
  Print("as many callers as are let in", peak);
  ASSERT_EQ(peak.failed, 0) << peak.failure;
  ASSERT_FALSE(peak.milliseconds.empty());

  const LoadOutcome over = load.Open(kTimes * peak.answered_per_second(),
                                     seconds(EnvironmentNumber(kSeconds, 5)));
  Print("ten times as many calls", over);
  EXPECT_EQ(over.failed, 0) << over.failure;
  EXPECT_GT(over.refused, 0);
  EXPECT_FALSE(over.milliseconds.empty());
  EXPECT_EQ(service.Caller().Search("torus-1"), "") << "it serves after";
  if (std::getenv(kSeconds) == nullptr) return;
  EXPECT_GE(over.answered_per_second(),
            kLeastGoodput * peak.answered_per_second());
  EXPECT_LE(over.p99(), kMostSlower * peak.p99());
}

}  // namespace
}  // namespace argmesh
