#include "server/rpc/listen_address.h"

#include <gtest/gtest.h>

namespace argmesh {
namespace {

TEST(ParseListenAddress, TellsLoopbackFromTheRest) {
  struct Row {
    const char* text;
    const char* host;
    int port;
    bool loopback;
  };
  const Row rows[] = {
      {"127.0.0.1:7411", "127.0.0.1", 7411, true},
      {"127.8.9.10:0", "127.8.9.10", 0, true},
      {"localhost:65535", "localhost", 65535, true},
      {"[::1]:80", "::1", 80, true},
      {"0.0.0.0:80", "0.0.0.0", 80, false},
      {"[::]:80", "::", 80, false},
      {"192.168.1.2:80", "192.168.1.2", 80, false},
      {"localhost.example.com:80", "localhost.example.com", 80, false},
      {"[::ffff:127.0.0.1]:80", "::ffff:127.0.0.1", 80, false},
  };
  for (const Row& row : rows) {
    const auto address = ParseListenAddress(row.text);
    ASSERT_TRUE(address.ok()) << row.text << ": " << address.status();
    EXPECT_EQ(address->host, row.host) << row.text;
    EXPECT_EQ(address->port, row.port) << row.text;
    EXPECT_EQ(address->loopback, row.loopback) << row.text;
    EXPECT_EQ(address->ToString(), row.text);
  }
}

TEST(ParseListenAddress, RefusesWhatIsNoAddress) {
  for (const char* text :
       {"", ":", ":80", "127.0.0.1", "127.0.0.1:", "127.0.0.1:65536",
        "127.0.0.1:-1", "127.0.0.1:80x", "::1:80", "[::1]", "[]:80",
        "[127.0.0.1]:80", "[::1:80"}) {
    EXPECT_FALSE(ParseListenAddress(text).ok()) << text;
  }
}

}  // namespace
}  // namespace argmesh
