#include "server/rpc/connection_acceptor.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_replace.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

constexpr char kAnyIpv4[] = "0.0.0.0";
constexpr char kAnyAddress[] = "::";
constexpr rlim_t kWantedDescriptors = 16384;

// Nothing is taken of a host whose connection was cut, and what was taken so
// shortly before is cut too: they come in masses. Each time that comes soon
// after the last it is twice as long.
constexpr auto kFirstShunned = std::chrono::seconds(1);
constexpr auto kLastShunned = std::chrono::seconds(8);

// Until descriptors are looked for again.
constexpr auto kPause = std::chrono::milliseconds(50);

using Addresses = std::unique_ptr<addrinfo, decltype(&freeaddrinfo)>;

absl::Status CannotListen(const ListenAddress& address, const char* why) {
  return absl::UnavailableError(
      absl::StrCat("cannot listen on ", address.ToString(), ": ", why));
}

absl::StatusOr<Addresses> Resolve(const ListenAddress& address) {
  addrinfo hints = {};
  hints.ai_family = AF_UNSPEC;
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_PASSIVE | AI_NUMERICSERV;
  addrinfo* found = nullptr;
  const int error =
      getaddrinfo(address.host.c_str(), std::to_string(address.port).c_str(),
                  &hints, &found);
  if (error != 0) return CannotListen(address, gai_strerror(error));
  return Addresses(found, &freeaddrinfo);
}

void SetOption(int socket, int level, int option, int value) {
  setsockopt(socket, level, option, &value, sizeof value);
}

int PortOf(int socket) {
  sockaddr_storage bound = {};
  socklen_t size = sizeof bound;
  if (getsockname(socket, reinterpret_cast<sockaddr*>(&bound), &size) != 0) {
    return 0;
  }
  return ntohs(bound.ss_family == AF_INET6
                   ? reinterpret_cast<const sockaddr_in6*>(&bound)->sin6_port
                   : reinterpret_cast<const sockaddr_in*>(&bound)->sin_port);
}

void SetPort(addrinfo& address, int port) {
  const in_port_t number = htons(static_cast<uint16_t>(port));
  if (address.ai_family == AF_INET6) {
    reinterpret_cast<sockaddr_in6*>(address.ai_addr)->sin6_port = number;
  } else {
    reinterpret_cast<sockaddr_in*>(address.ai_addr)->sin_port = number;
  }
}

// A listening socket, or -1 with errno.
int Bound(const addrinfo& address) {
  const int listener =
      socket(address.ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (listener < 0) return -1;
  // A server that comes back must not wait for connections of before.
  SetOption(listener, SOL_SOCKET, SO_REUSEADDR, 1);
  if (address.ai_family == AF_INET6) {
    SetOption(listener, IPPROTO_IPV6, IPV6_V6ONLY, 0);
  }
  if (bind(listener, address.ai_addr, address.ai_addrlen) == 0 &&
      listen(listener, SOMAXCONN) == 0) {
    return listener;
  }
  const int error = errno;
  close(listener);
  errno = error;
  return -1;
}

uint64_t CookieOf(int socket) {
  uint64_t cookie = 0;
  socklen_t size = sizeof cookie;
  getsockopt(socket, SOL_SOCKET, SO_COOKIE, &cookie, &size);
  return cookie;
}

// As gRPC names the peer of a connection, but with the brackets of IPv6 as they
// are: "ipv4:127.0.0.1:4711", "ipv6:[::1]:4711".
std::string PeerOf(int connection) {
  sockaddr_storage peer = {};
  socklen_t size = sizeof peer;
  if (getpeername(connection, reinterpret_cast<sockaddr*>(&peer), &size) != 0) {
    return "";
  }
  char host[INET6_ADDRSTRLEN] = "";
  if (peer.ss_family == AF_INET) {
    const auto& v4 = reinterpret_cast<const sockaddr_in&>(peer);
    inet_ntop(AF_INET, &v4.sin_addr, host, sizeof host);
    return absl::StrCat("ipv4:", host, ":", ntohs(v4.sin_port));
  }
  const auto& v6 = reinterpret_cast<const sockaddr_in6&>(peer);
  if (IN6_IS_ADDR_V4MAPPED(&v6.sin6_addr)) {
    inet_ntop(AF_INET, &v6.sin6_addr.s6_addr[12], host, sizeof host);
    return absl::StrCat("ipv4:", host, ":", ntohs(v6.sin6_port));
  }
  inet_ntop(AF_INET6, &v6.sin6_addr, host, sizeof host);
  return absl::StrCat("ipv6:[", host, "]:", ntohs(v6.sin6_port));
}

std::string HostOf(const std::string& peer) {
  return peer.substr(0, peer.rfind(':'));
}

// Ends the connection of this number if it still is that of the cookie, without
// reading what it still holds, which a shutdown would let the reader have.
bool DisconnectIfSame(int connection, uint64_t cookie) {
  // A number of our own: it stays the same connection from the look at it to
  // the end of it.
  const int same = fcntl(connection, F_DUPFD_CLOEXEC, 0);
  if (same < 0) return false;
  const bool is_same = CookieOf(same) == cookie;
  const sockaddr nobody = {AF_UNSPEC, {}};
  if (is_same) connect(same, &nobody, sizeof nobody);
  close(same);
  return is_same;
}

// The kernel hands out the lowest free number: one that is so high says that
// all below are taken.
bool IsReserved(int descriptor) {
  rlimit files = {};
  return getrlimit(RLIMIT_NOFILE, &files) == 0 &&
         static_cast<rlim_t>(descriptor) + kReservedDescriptors >=
             files.rlim_cur;
}

}  // namespace

void RaiseDescriptorLimit() {
  rlimit files = {};
  if (getrlimit(RLIMIT_NOFILE, &files) != 0) return;
  const rlim_t wanted = std::min(files.rlim_max, kWantedDescriptors);
  if (files.rlim_cur >= wanted) return;
  files.rlim_cur = wanted;
  setrlimit(RLIMIT_NOFILE, &files);
}

ConnectionAcceptor::~ConnectionAcceptor() { Stop(); }

absl::StatusOr<int> ConnectionAcceptor::Listen(const ListenAddress& address) {
  if (address.host == kAnyIpv4) {
    // All of this machine: IPv6 too, where there is any.
    absl::StatusOr<int> both = BindAll({kAnyAddress, address.port, false});
    if (both.ok()) return both;
  }
  return BindAll(address);
}

absl::StatusOr<int> ConnectionAcceptor::BindAll(const ListenAddress& address) {
  ARGMESH_ASSIGN_OR_RETURN(const Addresses addresses, Resolve(address));
  if (wake_ < 0) wake_ = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  if (wake_ < 0) return CannotListen(address, strerror(errno));
  int port = address.port;
  int error = 0;
  for (addrinfo* next = addresses.get(); next; next = next->ai_next) {
    if (next->ai_family != AF_INET && next->ai_family != AF_INET6) continue;
    SetPort(*next, port);
    const int listener = Bound(*next);
    if (listener >= 0) {
      listeners_.push_back(listener);
      port = PortOf(listener);
    } else if (errno != EAFNOSUPPORT && errno != EADDRNOTAVAIL) {
      return CannotListen(address, strerror(errno));
    } else {
      // A machine without IPv6 has "localhost" in it nevertheless.
      error = errno;
    }
  }
  if (listeners_.empty()) return CannotListen(address, strerror(error));
  return port;
}

void ConnectionAcceptor::Serve(std::unique_ptr<Sink> sink) {
  sink_ = std::move(sink);
  thread_ = std::thread([this] { Run(); });
}

void ConnectionAcceptor::Stop() {
  if (thread_.joinable()) {
    eventfd_write(wake_, 1);
    thread_.join();
  }
  for (const int listener : listeners_) close(listener);
  listeners_.clear();
  if (wake_ >= 0) close(std::exchange(wake_, -1));
}

void ConnectionAcceptor::Run() {
  std::vector<pollfd> waiting = {{wake_, POLLIN, 0}};
  for (const int listener : listeners_) {
    waiting.push_back({listener, POLLIN, 0});
  }
  while (true) {
    if (poll(waiting.data(), waiting.size(), -1) < 0 && errno != EINTR) {
      std::this_thread::sleep_for(kPause);
      continue;
    }
    if (waiting.front().revents != 0) return;
    for (size_t i = 1; i < waiting.size(); ++i) {
      if (waiting[i].revents != 0) Take(waiting[i].fd);
    }
  }
}

void ConnectionAcceptor::Take(int listener) {
  const int connection =
      accept4(listener, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
  if (connection < 0) {
    // What the peer has given up meanwhile is gone; what lacks here may come
    // back, and the connection waits in the kernel.
    if (errno == EMFILE || errno == ENFILE || errno == ENOBUFS ||
        errno == ENOMEM) {
      std::this_thread::sleep_for(kPause);
    }
    return;
  }
  if (IsReserved(connection)) {
    ++refused_;
    close(connection);
    return;
  }
  if (!Remember(connection)) {
    ++cut_;
    close(connection);
    return;
  }
  SetOption(connection, IPPROTO_TCP, TCP_NODELAY, 1);
  Sink::NewConnectionParameters parameters;
  parameters.listener_fd = listener;
  parameters.fd = connection;
  sink_->HandleNewConnection(&parameters);
}

bool ConnectionAcceptor::Remember(int connection) {
  const auto now = Clock::now();
  Connection made = {CookieOf(connection), PeerOf(connection), now};
  const std::lock_guard lock(mutex_);
  std::erase_if(shunned_, [now](const auto& host) {
    return host.second.end + kLastShunned < now;
  });
  const auto shunned = shunned_.find(HostOf(made.peer));
  if (shunned != shunned_.end() && now < shunned->second.end) return false;
  // Of those that are gone the number is reused.
  connections_[connection] = std::move(made);
  return true;
}

void ConnectionAcceptor::Cut(const std::string& peer) {
  const std::string name =
      absl::StrReplaceAll(peer, {{"%5B", "["}, {"%5D", "]"}});
  const std::string host = HostOf(name);
  const auto now = Clock::now();
  const std::lock_guard lock(mutex_);
  Shun(host, now);
  for (auto it = connections_.begin(); it != connections_.end();) {
    const Connection& connection = it->second;
    const bool is_young = now - connection.taken < kFirstShunned;
    if (connection.peer == name ||
        (is_young && HostOf(connection.peer) == host)) {
      if (DisconnectIfSame(it->first, connection.cookie)) ++cut_;
      it = connections_.erase(it);
    } else {
      ++it;
    }
  }
}

void ConnectionAcceptor::Shun(const std::string& host, Clock::time_point now) {
  Shunned& shunned = shunned_[host];
  if (now < shunned.end) return;
  const bool is_soon = now < shunned.end + kLastShunned;
  shunned.length =
      is_soon ? std::min<Clock::duration>(2 * shunned.length, kLastShunned)
              : kFirstShunned;
  shunned.end = now + shunned.length;
}

}  // namespace argmesh
