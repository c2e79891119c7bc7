// What waits for a thread: first of the caller who has had the least time, so
// that one who asks for much makes nobody wait but himself.
//
// Start-time fair queueing, with a caller's last work as the guess of his next:
// time that was had counts as long as anybody waits, and who comes new has had
// as much as the one served last. Of one caller in the order it came. Not
// thread-safe.
//
// Cost     of Pop and PushOut, a look at every caller
#ifndef ARGMESH_SERVER_ENGINE_FAIR_QUEUE_H_
#define ARGMESH_SERVER_ENGINE_FAIR_QUEUE_H_

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "absl/time/time.h"

namespace argmesh {

template <typename Work>
class FairQueue {
 public:
  size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }

  // `work` of `caller`, which gives up at `give_up`.
  void Push(const std::string& caller, absl::Time give_up, Work work) {
    Caller& own = callers_[caller];
    own.had = std::max(own.had, served_);
    own.waiting.push_back({std::move(work), give_up, pushed_++});
    ++size_;
  }

  // Whose turn it is; not of an empty queue.
  struct Next {
    std::string caller;
    Work work;
  };
  Next Pop() {
    auto first = callers_.end();
    for (auto it = callers_.begin(); it != callers_.end(); ++it) {
      if (it->second.waiting.empty()) continue;
      if (first == callers_.end() || IsBefore(it->second, first->second)) {
        first = it;
      }
    }
    Caller& own = first->second;
    Next next{first->first, std::move(own.waiting.front().work)};
    own.waiting.pop_front();
    served_ = own.had;
    own.had += own.last;
    if (--size_ == 0) callers_.clear();
    std::erase_if(callers_, [this](const auto& caller) {
      return caller.second.waiting.empty() && caller.second.had <= served_;
    });
    return next;
  }

  // Work of `caller` has taken so long. At most kMostCounted of it counts: one
  // long search is not to wait for as many short ones as fit into it.
  static constexpr absl::Duration kMostCounted = absl::Milliseconds(250);
  void Finished(const std::string& caller, absl::Duration elapsed) {
    const auto own = callers_.find(caller);
    if (own != callers_.end()) {
      own->second.last = std::min(elapsed, kMostCounted);
    }
  }

  // Makes room for `caller` where another has more waiting than it would have:
  // takes out the newest work of the one with the most. False: there is none.
  bool PushOut(const std::string& caller, Work& pushed_out) {
    const auto most = std::max_element(
        callers_.begin(), callers_.end(), [](const auto& a, const auto& b) {
          return a.second.waiting.size() < b.second.waiting.size();
        });
    const auto own = callers_.find(caller);
    const size_t wanted =
        own == callers_.end() ? 1 : own->second.waiting.size() + 1;
    if (most == callers_.end() || most->second.waiting.size() <= wanted) {
      return false;
    }
    pushed_out = std::move(most->second.waiting.back().work);
    most->second.waiting.pop_back();
    --size_;
    return true;
  }

  // Takes out what has given up.
  std::vector<Work> TakeLate(absl::Time now) {
    std::vector<Work> late;
    for (auto& [caller, own] : callers_) {
      std::deque<Waiting> kept;
      for (Waiting& waiting : own.waiting) {
        if (waiting.give_up <= now) {
          late.push_back(std::move(waiting.work));
        } else {
          kept.push_back(std::move(waiting));
        }
      }
      own.waiting = std::move(kept);
    }
    size_ -= late.size();
    if (size_ == 0) callers_.clear();
    return late;
  }

  // When the first gives up; InfiniteFuture when the queue is empty.
  absl::Time FirstGiveUp() const {
    absl::Time first = absl::InfiniteFuture();
    for (const auto& [caller, own] : callers_) {
      for (const Waiting& waiting : own.waiting) {
        first = std::min(first, waiting.give_up);
      }
    }
    return first;
  }

 private:
  struct Waiting {
    Work work;
    absl::Time give_up;
    int64_t number;  // in the order they came
  };
  struct Caller {
    std::deque<Waiting> waiting;
    absl::Duration had;
    absl::Duration last = absl::Milliseconds(1);
  };

  static bool IsBefore(const Caller& a, const Caller& b) {
    if (a.had != b.had) return a.had < b.had;
    return a.waiting.front().number < b.waiting.front().number;
  }

  // Those who wait or are ahead of `served_`.
  std::map<std::string, Caller> callers_;
  absl::Duration served_;  // what the one served last had had before
  int64_t pushed_ = 0;
  size_t size_ = 0;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_FAIR_QUEUE_H_
