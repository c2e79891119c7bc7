#include "server/rpc/unread_answers.h"

#include <algorithm>

namespace argmesh {

void UnreadAnswers::Add(LiveCall* call, const std::string& peer,
                        int64_t bytes) {
  const std::lock_guard lock(mutex_);
  const auto connection = connections_.try_emplace(peer).first;
  connection->second.bytes += bytes;
  connection->second.calls.push_back(call);
  answers_.emplace(call, Answer{connection, bytes});
  bytes_ += bytes;
  while (bytes_ > max_bytes_) {
    LiveCall* const oldest = OldestOfTheLargest();
    Forget(answers_.find(oldest));
    ++cut_;
    // Under the lock, so that no call is done while it is told.
    oldest->OnNotTaken();
  }
}

void UnreadAnswers::Remove(LiveCall* call) {
  const std::lock_guard lock(mutex_);
  const auto answer = answers_.find(call);
  if (answer != answers_.end()) Forget(answer);
}

int64_t UnreadAnswers::bytes() const {
  const std::lock_guard lock(mutex_);
  return bytes_;
}

int64_t UnreadAnswers::cut() const {
  const std::lock_guard lock(mutex_);
  return cut_;
}

LiveCall* UnreadAnswers::OldestOfTheLargest() const {
  const auto largest =
      std::max_element(connections_.begin(), connections_.end(),
                       [](const auto& a, const auto& b) {
                         return a.second.bytes < b.second.bytes;
                       });
  return largest->second.calls.front();
}

void UnreadAnswers::Forget(std::map<LiveCall*, Answer>::iterator answer) {
  const auto connection = answer->second.connection;
  std::deque<LiveCall*>& calls = connection->second.calls;
  calls.erase(std::find(calls.begin(), calls.end(), answer->first));
  connection->second.bytes -= answer->second.bytes;
  bytes_ -= answer->second.bytes;
  if (calls.empty()) connections_.erase(connection);
  answers_.erase(answer);
}

}  // namespace argmesh
