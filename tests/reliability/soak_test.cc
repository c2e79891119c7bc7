// Shapes come and go by every way there is, are read, and searched for by shape
// and by mesh, whole and in part, by several clients at once, as long as one
// likes, beside calls that fail: the server's memory does not grow.
//
// ARGMESH_SOAK_SECONDS of it, 10 when not set. The slope counts from 300
// seconds on: before that, what caches and the allocator keep still grows.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tests/reliability/process_memory.h"
#include "tests/reliability/small_service.h"
#include "tests/reliability/witness.h"
#include "tests/support/environment_number.h"

namespace argmesh {
namespace {

using std::chrono::duration;
using std::chrono::seconds;
using Clock = std::chrono::steady_clock;

constexpr int kShapes = 12;
constexpr double kMebibyte = 1 << 20;
constexpr double kWarmUpSeconds = 300;
constexpr double kMostMebibytesPerHour = 1;
// Within the warm-up only what no cache explains is an error.
#ifdef __SANITIZE_ADDRESS__
constexpr double kMostMebibytesWarmingUp = 512;  // it keeps what is freed
#else
constexpr double kMostMebibytesWarmingUp = 128;
#endif

struct MemorySample {
  double seconds = 0;
  double mebibytes = 0;
};

// By least squares.
double MebibytesPerHour(const std::vector<MemorySample>& samples) {
  double time = 0;
  double memory = 0;
  for (const MemorySample& sample : samples) {
    time += sample.seconds / static_cast<double>(samples.size());
    memory += sample.mebibytes / static_cast<double>(samples.size());
  }
  double both = 0;
  double square = 0;
  for (const MemorySample& sample : samples) {
    both += (sample.seconds - time) * (sample.mebibytes - memory);
    square += (sample.seconds - time) * (sample.seconds - time);
  }
  return square > 0 ? 3600 * both / square : 0;
}

// Shape "passing", by one of the ways there are.
std::string Add(ShapeCaller& caller, int way, double minor_radius) {
  switch (way) {
    case 0:
      return caller.AddTorus("passing", minor_radius);
    case 1:
      return caller.Upload("passing", minor_radius);
    default:
      return caller.Ingest("passing", minor_radius);
  }
}

// Each client has a connection of its own and repeats its calls, one that the
// server had no time for, too; `overloaded` counts these.
std::vector<std::unique_ptr<Witness>> MixedLoad(const std::string& address,
                                                std::atomic<int>& overloaded) {
  std::vector<std::unique_ptr<Witness>> clients;
  const auto add = [&](auto&& call) {
    clients.push_back(std::make_unique<Witness>(
        [caller = std::make_shared<ShapeCaller>(address), call, &overloaded,
         round = 0]() mutable -> std::string {
          std::string failure = call(*caller, round);
          if (IsOverloaded(failure)) {
            ++overloaded;
            return "";
          }
          ++round;
          return failure;
        }));
  };
  // One adds: on two CPUs one thread computes, and it may wait for no other.
  add([](ShapeCaller& caller, int round) {
    if (round % 2 == 1) return caller.Delete("passing");
    const int added = round / 2;
    return Add(caller, added % 3, 0.3 + 0.05 * (added % 13));
  });
  add([](ShapeCaller& caller, int round) {
    return caller.Search("torus-" + std::to_string(round % kShapes));
  });
  add([](ShapeCaller& caller, int round) {
    return caller.Get("torus-" + std::to_string(round % kShapes));
  });
  add([](ShapeCaller& caller, int) { return caller.List(); });
  add([](ShapeCaller& caller, int round) {
    const double minor_radius = 0.3 + 0.05 * (round % 11);
    switch (round % 3) {
      case 0:
        return caller.SearchByMesh(v1::SEARCH_MODE_GLOBAL, minor_radius);
      case 1:
        return caller.SearchByMesh(v1::SEARCH_MODE_PARTIAL, minor_radius);
      default:
        return caller.StreamSearch(minor_radius);
    }
  });
  add([](ShapeCaller& caller, int round) {
    return round % 8 == 0 ? caller.AddBroken() : caller.GetMissing();
  });
  return clients;
}

TEST(SoakTest, TheServersMemoryDoesNotGrow) {
  const auto time =
      static_cast<double>(EnvironmentNumber("ARGMESH_SOAK_SECONDS", 10));
  SmallService service;
  ASSERT_EQ(service.Start(kShapes), "");
  const double before =
      static_cast<double>(ResidentBytes(service.pid())) / kMebibyte;

  std::atomic<int> overloaded = 0;
  auto clients = MixedLoad(service.address(), overloaded);
  std::vector<MemorySample> samples;
  double most = 0;
  const auto begin = Clock::now();
  for (double now = 0; now < time;
       now = duration<double>(Clock::now() - begin).count()) {
    const double resident =
        static_cast<double>(ResidentBytes(service.pid())) / kMebibyte;
    ASSERT_GT(resident, 0) << service.installation().ServerLog();
    most = std::max(most, resident);
    if (now >= kWarmUpSeconds) samples.push_back({now, resident});
    std::this_thread::sleep_for(seconds(1));
  }

  size_t calls = 0;
  for (const auto& client : clients) {
    const Testimony testimony = client->Take();
    calls += testimony.milliseconds.size();
    EXPECT_EQ(testimony.failed, 0) << testimony.failure;
    EXPECT_FALSE(testimony.milliseconds.empty());
  }
  std::printf(
      "measured: %.0f s, %zu calls, %d of them overloaded, %.1f MiB before, "
      "%.1f at most\n",
      time, calls, overloaded.load(), before, most);
  EXPECT_LT(static_cast<size_t>(overloaded.load()), calls / 2);
  EXPECT_LT(most - before, kMostMebibytesWarmingUp);
  if (samples.empty()) return;
  const double slope = MebibytesPerHour(samples);
  std::printf("measured: %.2f MiB/h after the first %.0f s\n", slope,
              kWarmUpSeconds);
  EXPECT_LT(slope, kMostMebibytesPerHour);
}

}  // namespace
}  // namespace argmesh
