// How many calls each connection has under way, and an end to those that have
// too many.
//
// HTTP/2 lets a connection have kMaxStreams calls at a time, but a call that
// its peer has reset is none of them any more, while the server still has to
// take it down: whoever resets every call at once starts them faster than they
// end, and everybody waits. A connection with kMaxCalls under way does that,
// and is cut. Thread-safe.
#ifndef ARGMESH_SERVER_RPC_CONNECTION_CALLS_H_
#define ARGMESH_SERVER_RPC_CONNECTION_CALLS_H_

#include <functional>
#include <mutex>
#include <string>
#include <unordered_map>
#include <utility>

namespace argmesh {

// At a time on one connection.
inline constexpr int kMaxStreams = 128;

class ConnectionCalls {
 public:
  // Beyond what an honest peer can have while its ended calls are taken down.
  static constexpr int kMaxCalls = 4 * kMaxStreams;

  // Cuts a connection by its name, `grpc::ServerContext::peer`.
  using Cut = std::function<void(const std::string& peer)>;
  // Before the first call.
  void SetCut(Cut cut) { cut_ = std::move(cut); }

  // False when there are too many: the connection has been cut.
  bool Enter(const std::string& peer);
  // For each Enter, whatever it answered.
  void Leave(const std::string& peer);

 private:
  Cut cut_;
  std::mutex mutex_;
  std::unordered_map<std::string, int> calls_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_CONNECTION_CALLS_H_
