#include "server/rpc/answer_room.h"

#include <utility>

namespace argmesh {

bool AnswerRoom::Enter(LiveCall* call, const std::string& peer) {
  const std::lock_guard lock(mutex_);
  return EnterLocked(call, peer);
}

bool AnswerRoom::EnterOrWait(LiveCall* call, const std::string& peer,
                             Step again) {
  const std::lock_guard lock(mutex_);
  if (EnterLocked(call, peer)) return true;
  Connection& connection = connections_.at(peer);
  Waiting waiting = {call, std::move(again)};
  if (connection.called.erase(call) > 0) {
    connection.waiting.push_front(std::move(waiting));
  } else {
    connection.waiting.push_back(std::move(waiting));
  }
  return false;
}

bool AnswerRoom::EnterLocked(LiveCall* call, const std::string& peer) {
  const auto found = connections_.find(peer);
  if (found == connections_.end()) return true;
  Connection& connection = found->second;
  if (connection.bytes >= room_) return false;
  return connection.called.erase(call) > 0 || connection.waiting.empty();
}

void AnswerRoom::LetNextIn(const std::string& peer) {
  Step next;
  {
    const std::lock_guard lock(mutex_);
    const auto found = connections_.find(peer);
    if (found != connections_.end()) next = TakeNext(found->second);
  }
  if (next) next();
}

void AnswerRoom::Hold(LiveCall* call, const std::string& peer, int64_t bytes) {
  const std::lock_guard lock(mutex_);
  Connection& connection = connections_[peer];
  if (connection.answers.emplace(call, bytes).second) connection.bytes += bytes;
}

void AnswerRoom::Remove(LiveCall* call, const std::string& peer) {
  Step next;
  {
    const std::lock_guard lock(mutex_);
    const auto found = connections_.find(peer);
    if (found == connections_.end()) return;
    Connection& connection = found->second;
    if (const auto answer = connection.answers.find(call);
        answer != connection.answers.end()) {
      connection.bytes -= answer->second;
      connection.answers.erase(answer);
    }
    std::erase_if(connection.waiting,
                  [call](const Waiting& w) { return w.call == call; });
    connection.called.erase(call);
    next = TakeNext(connection);
    if (connection.answers.empty() && connection.waiting.empty() &&
        connection.called.empty()) {
      connections_.erase(found);
    }
  }
  if (next) next();
}

AnswerRoom::Step AnswerRoom::TakeNext(Connection& connection) {
  if (connection.waiting.empty() || connection.bytes >= room_) return nullptr;
  Waiting next = std::move(connection.waiting.front());
  connection.waiting.pop_front();
  connection.called.insert(next.call);
  return std::move(next.again);
}

}  // namespace argmesh
