// Power losses at random moments of random work, on a simulated disk: each
// image of what may be left opens, is whole, and holds what was acknowledged.
//
// ARGMESH_POWER_LOSS_IMAGES images, 50 when not set; from
// ARGMESH_POWER_LOSS_SEED, 1 when not set.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdio>
#include <deque>
#include <filesystem>
#include <memory>
#include <thread>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/base/random.h"
#include "tests/reliability/file_calls.h"
#include "tests/reliability/real_store.h"
#include "tests/reliability/simulated_disk.h"
#include "tests/reliability/store_script.h"
#include "tests/support/catalog_dump.h"
#include "tests/support/environment_number.h"
#include "tests/support/status_matchers.h"
#include "tests/support/temporary_directory.h"

namespace argmesh {
namespace {

using Loss = SimulatedDisk::Loss;

constexpr size_t kSteps = 60;     // of each client
constexpr size_t kStarts = 3;     // of the store in one run
constexpr uint64_t kCalls = 150;  // at most, between two power losses

struct PowerLoss {
  DiskImage image;
  Loss loss = Loss::kNothing;
  int64_t call = 0;
  std::vector<size_t> acknowledged;  // by each client
};

// Loses power again and again while the store goes on.
class PowerLosses : public FileCallObserver {
 public:
  PowerLosses(const std::filesystem::path& root, size_t clients, uint64_t seed)
      : acknowledged_(clients), disk_(root), random_(seed) {}

  int Before(const FileCall&) override {
    if (++calls_ >= next_) Lose();
    return 0;
  }
  void After(const FileCall& call) override { disk_.Apply(call); }

  void Acknowledge(size_t client, size_t steps) {
    acknowledged_[client] = steps;
  }

  int64_t calls() const { return calls_; }
  const std::vector<PowerLoss>& losses() const { return losses_; }

 private:
  void Lose() {
    next_ = calls_ + 1 + static_cast<int64_t>(random_.Below(kCalls));
    PowerLoss& power_loss = losses_.emplace_back();
    power_loss.loss = static_cast<Loss>(random_.Below(4));
    power_loss.call = calls_;
    power_loss.image = disk_.ImageAfterPowerLoss(power_loss.loss, random_);
    for (const std::atomic<size_t>& steps : acknowledged_) {
      power_loss.acknowledged.push_back(steps);
    }
  }

  std::vector<std::atomic<size_t>> acknowledged_;
  SimulatedDisk disk_;
  Random random_;
  int64_t calls_ = 0;
  int64_t next_ = 0;
  std::vector<PowerLoss> losses_;
};

class NoObserver : public FileCallObserver {
 public:
  int Before(const FileCall&) override { return 0; }
  void After(const FileCall&) override {}
};

class PowerLossTest : public testing::Test {
 protected:
  // Runs all scripts at once on a new store that is stopped and started in
  // between.
  void Run(const std::deque<StoreScript>& scripts, PowerLosses& losses,
           const std::filesystem::path& root) {
    const FileCallObservation observation(root, &losses);
    for (size_t start = 0; start < kStarts; ++start) {
      absl::StatusOr<RealStore> store = RealStore::Open(root / "data");
      ASSERT_THAT(store, IsOk());
      std::vector<std::thread> clients;
      for (size_t client = 0; client < scripts.size(); ++client) {
        clients.emplace_back([&, client] {
          for (size_t step = kSteps * start / kStarts;
               step < kSteps * (start + 1) / kStarts; ++step) {
            (void)scripts[client].Run(step, *store->catalog, *store->meshes);
            losses.Acknowledge(client, step + 1);
          }
        });
      }
      for (std::thread& client : clients) client.join();
      EXPECT_THAT(store->catalog->Close(), IsOk());
    }
  }

  void Check(const std::deque<StoreScript>& scripts, const PowerLoss& loss) {
    const TemporaryDirectory folder;
    loss.image.WriteTo(folder.path());
    NoObserver unseen;
    const FileCallObservation unsynced(
        std::filesystem::canonical(folder.path()), &unseen);
    for (const bool again : {false, true}) {
      SCOPED_TRACE(again ? "started again" : "first start");
      const absl::StatusOr<RealStore> store =
          RealStore::Open(folder.path() / "data");
      ASSERT_THAT(store, IsOk());
      EXPECT_THAT(store->CheckWhole(), IsOk());
      for (size_t i = 0; i < scripts.size(); ++i) {
        const std::string state =
            DumpCollection(*store->catalog, scripts[i].collection());
        const size_t steps = loss.acknowledged[i];
        EXPECT_TRUE(
            state == scripts[i].StateAfter(steps) ||
            (steps < kSteps && state == scripts[i].StateAfter(steps + 1)))
            << scripts[i].collection() << " is not as after " << steps
            << " steps or one more";
      }
      EXPECT_THAT(store->catalog->Close(), IsOk());
    }
  }
};

TEST_F(PowerLossTest, LosesNothingAcknowledgedAndLeavesNothingHalf) {
  const uint64_t seed = EnvironmentNumber("ARGMESH_POWER_LOSS_SEED", 1);
  const uint64_t wanted = EnvironmentNumber("ARGMESH_POWER_LOSS_IMAGES", 50);
  uint64_t images = 0;
  int64_t calls = 0;
  for (uint64_t run = seed; images < wanted && !HasFailure(); ++run) {
    SCOPED_TRACE(absl::StrCat("ARGMESH_POWER_LOSS_SEED=", run));
    const TemporaryDirectory folder;
    const auto root = std::filesystem::canonical(folder.path());
    std::deque<StoreScript> scripts;
    for (size_t i = 0; i < 1 + 2 * (run % 2); ++i) {
      scripts.emplace_back(absl::StrCat("c", i), 100 * run + i, kSteps);
    }
    PowerLosses losses(root, scripts.size(), run);
    ASSERT_NO_FATAL_FAILURE(Run(scripts, losses, root));
    calls += losses.calls();
    for (const PowerLoss& loss : losses.losses()) {
      if (images == wanted) break;
      ++images;
      SCOPED_TRACE(absl::StrCat("call ", loss.call, ", loss ",
                                static_cast<int>(loss.loss)));
      Check(scripts, loss);
    }
  }
  std::printf("measured: %ju images of %jd file calls, seed %ju: %s\n",
              static_cast<uintmax_t>(images), static_cast<intmax_t>(calls),
              static_cast<uintmax_t>(seed),
              HasFailure() ? "damage found" : "0 damaged");
}

}  // namespace
}  // namespace argmesh
