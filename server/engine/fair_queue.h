// What waits for a thread: in turn by caller, so that one who asks for much
// makes the others wait for one of his at a time.
//
// Of one caller in the order it came. Not thread-safe.
#ifndef ARGMESH_SERVER_ENGINE_FAIR_QUEUE_H_
#define ARGMESH_SERVER_ENGINE_FAIR_QUEUE_H_

#include <algorithm>
#include <cstddef>
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
    std::deque<Waiting>& own = callers_[caller];
    if (own.empty()) turns_.push_back(caller);
    own.push_back({std::move(work), give_up});
    ++size_;
  }

  // Whose turn it is; not of an empty queue.
  Work Pop() {
    const std::string caller = std::move(turns_.front());
    turns_.pop_front();
    const auto own = callers_.find(caller);
    Work work = std::move(own->second.front().work);
    own->second.pop_front();
    --size_;
    if (own->second.empty()) {
      callers_.erase(own);
    } else {
      turns_.push_back(caller);
    }
    return work;
  }

  // Makes room for `caller` where another has more waiting than it would have:
  // takes out the newest work of the one with the most. False: there is none.
  bool PushOut(const std::string& caller, Work& pushed_out) {
    const auto most = std::max_element(
        callers_.begin(), callers_.end(), [](const auto& a, const auto& b) {
          return a.second.size() < b.second.size();
        });
    const auto own = callers_.find(caller);
    const size_t wanted = own == callers_.end() ? 1 : own->second.size() + 1;
    if (most == callers_.end() || most->second.size() <= wanted) return false;
    pushed_out = std::move(most->second.back().work);
    most->second.pop_back();
    --size_;
    return true;
  }

  // Takes out what has given up.
  std::vector<Work> TakeLate(absl::Time now) {
    std::vector<Work> late;
    for (auto own = callers_.begin(); own != callers_.end();) {
      std::deque<Waiting> kept;
      for (Waiting& waiting : own->second) {
        if (waiting.give_up <= now) {
          late.push_back(std::move(waiting.work));
        } else {
          kept.push_back(std::move(waiting));
        }
      }
      own->second = std::move(kept);
      if (own->second.empty()) {
        std::erase(turns_, own->first);
        own = callers_.erase(own);
      } else {
        ++own;
      }
    }
    size_ -= late.size();
    return late;
  }

  // When the first gives up; InfiniteFuture when the queue is empty.
  absl::Time FirstGiveUp() const {
    absl::Time first = absl::InfiniteFuture();
    for (const auto& [caller, own] : callers_) {
      for (const Waiting& waiting : own) {
        first = std::min(first, waiting.give_up);
      }
    }
    return first;
  }

 private:
  struct Waiting {
    Work work;
    absl::Time give_up;
  };

  std::map<std::string, std::deque<Waiting>> callers_;  // none is empty
  std::deque<std::string> turns_;                       // each caller once
  size_t size_ = 0;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_ENGINE_FAIR_QUEUE_H_
