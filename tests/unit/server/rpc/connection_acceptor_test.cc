#include "server/rpc/connection_acceptor.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <memory>
#include <string>
#include <thread>

#include "absl/strings/str_cat.h"

namespace argmesh {
namespace {

using std::chrono::milliseconds;
using Clock = std::chrono::steady_clock;

// Takes connections as gRPC does, and closes none.
class Taker final : public ConnectionAcceptor::Sink {
 public:
  void HandleNewConnection(NewConnectionParameters*) override {}
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
  // Whether the server has closed it, which may take some time.
  bool IsCut(milliseconds patience) const {
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
    acceptor_.Serve(std::make_unique<Taker>());
  }

  bool TakesPeer() const { return !Peer(port_).IsCut(milliseconds(100)); }
  // Cuts a connection that was taken.
  void CutOne() {
    const Peer peer(port_);
    ASSERT_FALSE(peer.IsCut(milliseconds(100)));
    acceptor_.Cut(peer.name());
    EXPECT_TRUE(peer.IsCut(milliseconds(5000)));
  }
  // From `begin`; where that is over already it says nothing.
  static bool IsWithin(Clock::time_point begin, milliseconds time) {
    return Clock::now() - begin < time;
  }

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
