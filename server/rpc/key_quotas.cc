#include "server/rpc/key_quotas.h"

#include <algorithm>
#include <atomic>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "server/engine/error_reason.h"

namespace argmesh {
namespace {

absl::Status LimitExceeded(const std::string& id, const char* limit,
                           double value, absl::Duration retry_after) {
  return WithRetryDelay(
      MakeError(ErrorReason::kKeyLimitExceeded,
                absl::StrFormat("key %s has reached its limit: %s %g", id,
                                limit, value),
                {{"principal", id},
                 {"limit", limit},
                 {"value", absl::StrCat(value)}}),
      retry_after);
}

}  // namespace

struct KeyQuotas::Usage {
  double tokens = 0;
  absl::Time filled = absl::InfinitePast();  // when `tokens` was right
  std::atomic<int> calls{0};

  // More tokens for the time that has passed; a full bucket at first.
  void Fill(const KeyLimits& limits, absl::Time now) {
    const double full = limits.burst;
    const double seconds = absl::ToDoubleSeconds(now - filled);
    tokens = filled == absl::InfinitePast()
                 ? full
                 : std::min(full, tokens + std::max(0.0, seconds) *
                                               limits.requests_per_second);
    filled = now;
  }
};

absl::StatusOr<KeyQuotas::Ticket> KeyQuotas::Admit(const std::string& id,
                                                   const KeyLimits& limits,
                                                   absl::Time now) {
  if (!limits.any()) return nullptr;
  const std::lock_guard lock(mutex_);
  std::shared_ptr<Usage>& usage = usages_[id];
  if (usage == nullptr) usage = std::make_shared<Usage>();
  if (limits.concurrent_calls > 0 &&
      usage->calls.load() >= limits.concurrent_calls) {
    return LimitExceeded(id, "concurrent_calls", limits.concurrent_calls,
                         absl::Seconds(1));
  }
  if (limits.requests_per_second > 0) {
    usage->Fill(limits, now);
    if (usage->tokens < 1) {
      return LimitExceeded(
          id, "requests_per_second", limits.requests_per_second,
          absl::Seconds((1 - usage->tokens) / limits.requests_per_second));
    }
    usage->tokens -= 1;
  }
  usage->calls.fetch_add(1);
  return Ticket(nullptr, [usage](void*) { usage->calls.fetch_sub(1); });
}

void KeyQuotas::KeepOnly(const KeyRing& keys) {
  const std::lock_guard lock(mutex_);
  std::erase_if(usages_,
                [&](const auto& item) { return !keys.contains(item.first); });
}

}  // namespace argmesh
