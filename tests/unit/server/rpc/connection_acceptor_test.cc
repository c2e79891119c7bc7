#include "server/rpc/connection_acceptor.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "absl/strings/str_cat.h"

namespace argmesh {
namespace {

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

// Takes connections as gRPC does, and keeps them.
class Taker final : public ConnectionAcceptor::Sink {
 public:
  explicit Taker(std::atomic<int>& taken) : taken_(taken) {}
  ~Taker() override {
    for (const int descriptor : descriptors_) close(descriptor);
  }
  void HandleNewConnection(NewConnectionParameters* connection) override {
    descriptors_.push_back(connection->fd);
    ++taken_;
  }

 private:
  std::atomic<int>& taken_;
  std::vector<int> descriptors_;
};

class Peer {
 public:
  explicit Peer(int port) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in to = {};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<uint16_t>(port));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(connect(socket_, reinterpret_cast<sockaddr*>(&to), sizeof to), 0);
  }
  ~Peer() { close(socket_); }
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;

  // As gRPC names it.
  std::string name() const {
    sockaddr_in own = {};
    socklen_t size = sizeof own;
    getsockname(socket_, reinterpret_cast<sockaddr*>(&own), &size);
    return absl::StrCat("ipv4:127.0.0.1:", ntohs(own.sin_port));
  }
  // Whether the server has closed it, or does within `patience`.
  bool IsCut(milliseconds patience = milliseconds(0)) const {
    pollfd waiting = {socket_, POLLIN, 0};
    return poll(&waiting, 1, static_cast<int>(patience.count())) > 0;
  }

 private:
  int socket_;
};

class ConnectionAcceptorTest : public testing::Test {
 protected:
  void SetUp() override {
    const absl::StatusOr<int> port =
        acceptor_.Listen({"127.0.0.1", 0, /*loopback=*/true});
    ASSERT_TRUE(port.ok()) << port.status();
    port_ = *port;
    acceptor_.Serve(std::make_unique<Taker>(taken_));
  }

  // Whether the peer is taken, not closed at once.
  bool Takes(const Peer& peer, int taken_before) const {
    while (taken_ == taken_before && !peer.IsCut(milliseconds(1))) {
    }
    return taken_ > taken_before;
  }
  bool TakesPeer() const {
    const int before = taken_;
    return Takes(Peer(port_), before);
  }
  // Cuts a connection that was taken.
  void CutOne() {
    const int before = taken_;
    const Peer peer(port_);
    ASSERT_TRUE(Takes(peer, before));
    acceptor_.Cut(peer.name());
    EXPECT_TRUE(peer.IsCut(milliseconds(5000)));
  }
  // From `begin`; where that is over already it says nothing.
  static bool IsWithin(Clock::time_point begin, milliseconds time) {
    return Clock::now() - begin < time;
  }

  std::atomic<int> taken_ = 0;
  ConnectionAcceptor acceptor_;
  int port_ = 0;
};

TEST_F(ConnectionAcceptorTest, CutsAConnectionAndTakesNoneOfItsHostForASecond) {
  ASSERT_TRUE(TakesPeer());
  const auto begin = Clock::now();
  CutOne();
  const bool taken = TakesPeer();
  EXPECT_TRUE(!taken || !IsWithin(begin, milliseconds(1000)));
  std::this_thread::sleep_for(milliseconds(1200));
  EXPECT_TRUE(TakesPeer());
  EXPECT_GE(acceptor_.cut(), taken ? 1 : 2);
}

TEST_F(ConnectionAcceptorTest, TakesNoneForTwiceAsLongTheNextTime) {
  CutOne();
  std::this_thread::sleep_for(milliseconds(1200));
  const auto begin = Clock::now();
  CutOne();
  std::this_thread::sleep_for(milliseconds(1200));
  const bool taken = TakesPeer();
  EXPECT_TRUE(!taken || !IsWithin(begin, milliseconds(2000)));
  std::this_thread::sleep_for(milliseconds(1000));
  EXPECT_TRUE(TakesPeer());
}

TEST_F(ConnectionAcceptorTest, CutsNothingThatIsNotThere) {
  acceptor_.Cut("ipv4:127.0.0.2:1");
  EXPECT_EQ(acceptor_.cut(), 0);
  EXPECT_TRUE(TakesPeer());
}

}  // namespace
}  // namespace argmesh
