#include "server/engine/mesh_memory.h"

#include <gtest/gtest.h>

#include <optional>
#include <thread>
#include <utility>

#include "absl/time/clock.h"
#include "server/engine/error_reason.h"
#include "tests/support/status_matchers.h"

namespace argmesh {
namespace {

constexpr int64_t kVertices = 1000;
constexpr int64_t kFaces = 2000;
constexpr int64_t kBytes = 370 * kVertices + 150 * kFaces;

absl::StatusOr<MeshMemoryClaim> Claim(MeshMemory& memory,
                                      absl::Duration max_wait,
                                      const StopToken& stop = {}) {
  return memory.Claim(kVertices, kFaces, max_wait, stop);
}

TEST(MeshMemory, GivesBackWhatWasClaimed) {
  MeshMemory memory(kBytes);
  {
    ASSERT_OK_AND_ASSIGN(MeshMemoryClaim claim,
                         Claim(memory, absl::ZeroDuration()));
    EXPECT_EQ(claim.bytes(), kBytes);
    EXPECT_EQ(memory.claimed(), kBytes);
    const MeshMemoryClaim moved = std::move(claim);
    EXPECT_EQ(memory.claimed(), kBytes);
  }
  EXPECT_EQ(memory.claimed(), 0);
}

TEST(MeshMemory, RefusesAMeshThatNeverFits) {
  MeshMemory memory(kBytes - 1);
  const auto claim = Claim(memory, absl::InfiniteDuration());
  EXPECT_EQ(ReasonOf(claim.status()), ErrorReason::kMeshTooLarge);
  EXPECT_EQ(memory.claimed(), 0);
}

TEST(MeshMemory, WaitsForOthersUntilItIsRefusedOrStopped) {
  MeshMemory memory(kBytes + kBytes / 2);
  ASSERT_OK_AND_ASSIGN(const MeshMemoryClaim first,
                       Claim(memory, absl::ZeroDuration()));
  EXPECT_EQ(ReasonOf(Claim(memory, absl::Milliseconds(30)).status()),
            ErrorReason::kOverloaded);
  const StopToken late({}, absl::Now() + absl::Milliseconds(30));
  EXPECT_EQ(Claim(memory, absl::InfiniteDuration(), late).status().code(),
            absl::StatusCode::kDeadlineExceeded);
}

TEST(MeshMemory, GoesOnWhenOthersAreDone) {
  MeshMemory memory(kBytes);
  std::optional<MeshMemoryClaim> first = *Claim(memory, absl::ZeroDuration());
  std::thread waiting(
      [&] { EXPECT_THAT(Claim(memory, absl::InfiniteDuration()), IsOk()); });
  absl::SleepFor(absl::Milliseconds(20));
  first.reset();
  waiting.join();
  EXPECT_EQ(memory.claimed(), 0);
}

}  // namespace
}  // namespace argmesh
