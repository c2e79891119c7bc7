// Takes connections for the gRPC server, and goes on when descriptors run out.
//
// gRPC's own listener stops for good at the first accept that fails for want
// of a descriptor: whoever opens enough connections ends the service. This one
// closes a connection that would take one of the last descriptors, which are
// the store's and the logs', and takes the next once others are closed.
//
// It can also cut a connection, and those of its host that are a second old at
// most: what they have sent and gRPC has not read yet is dropped, and nothing
// of the host is taken for a second, or for up to eight when it comes again.
//
//   acceptor.Listen(address) // bound, nothing is taken yet
//   acceptor.Serve(sink)     // once the server runs
//   acceptor.Stop()          // before it goes
#ifndef ARGMESH_SERVER_RPC_CONNECTION_ACCEPTOR_H_
#define ARGMESH_SERVER_RPC_CONNECTION_ACCEPTOR_H_

#include <grpcpp/grpcpp.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <unordered_map>
#include <vector>

#include "absl/status/statusor.h"
#include "server/rpc/listen_address.h"

namespace argmesh {

// Of the process's descriptors, those that connections do not get.
inline constexpr int kReservedDescriptors = 64;

// Lets this process have 16,384 descriptors, or as many as it may; never fewer
// than before.
void RaiseDescriptorLimit();

class ConnectionAcceptor {
 public:
  using Sink = grpc::experimental::ExternalConnectionAcceptor;

  ~ConnectionAcceptor();  // Stop

  // Binds every address that the host has and returns the port of all.
  // kUnavailable when one cannot be bound.
  absl::StatusOr<int> Listen(const ListenAddress& address);
  // From now on connections go to `sink`. Once.
  void Serve(std::unique_ptr<Sink> sink);
  // Takes none any more and closes the port. May be called again.
  void Stop();

  // Cuts the connection that gRPC calls `peer`, if there still is one. From any
  // thread.
  void Cut(const std::string& peer);

  // Connections that were closed for want of descriptors.
  int64_t refused() const { return refused_; }
  // Connections that were cut, or closed because one of the host was.
  int64_t cut() const { return cut_; }

 private:
  using Clock = std::chrono::steady_clock;
  struct Connection {
    uint64_t cookie = 0;  // the kernel's; a descriptor may be another's by now
    std::string peer;
    Clock::time_point taken;
  };

  struct Shunned {
    Clock::time_point end;
    Clock::duration length;
  };

  absl::StatusOr<int> BindAll(const ListenAddress& address);
  void Run();
  void Take(int listener);
  // False when nothing of the host is taken now.
  bool Remember(int connection);
  void Shun(const std::string& host, Clock::time_point now);  // locked

  std::vector<int> listeners_;
  int wake_ = -1;  // an eventfd: readable once Stop was called
  std::unique_ptr<Sink> sink_;
  std::atomic<int64_t> refused_{0};
  std::atomic<int64_t> cut_{0};
  std::mutex mutex_;
  std::unordered_map<int, Connection> connections_;  // with mutex_
  std::map<std::string, Shunned> shunned_;           // hosts; with mutex_
  std::thread thread_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_CONNECTION_ACCEPTOR_H_
