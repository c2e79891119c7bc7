#include "tests/reliability/witness.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace argmesh {
namespace {

constexpr auto kPause = std::chrono::milliseconds(5);

}  // namespace

double Testimony::Quantile(double share) const {
  if (milliseconds.empty()) return 0;
  const auto last = static_cast<double>(milliseconds.size() - 1);
  return milliseconds[static_cast<size_t>(share * last)];
}

Witness::Witness(Call call)
    : call_(std::move(call)), thread_([this] { Run(); }) {}

Witness::~Witness() { Take(); }

Testimony Witness::Take() {
  stopped_ = true;
  if (thread_.joinable()) thread_.join();
  std::sort(testimony_.milliseconds.begin(), testimony_.milliseconds.end());
  return std::move(testimony_);
}

void Witness::Run() {
  using Clock = std::chrono::steady_clock;
  while (!stopped_) {
    const auto begin = Clock::now();
    const std::string failure = call_();
    const std::chrono::duration<double, std::milli> took = Clock::now() - begin;
    if (failure.empty()) {
      testimony_.milliseconds.push_back(took.count());
    } else if (++testimony_.failed == 1) {
      testimony_.failure = failure;
    }
    std::this_thread::sleep_for(kPause);
  }
}

}  // namespace argmesh
