#include "tests/reliability/http2_peer.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

namespace argmesh {
namespace {

constexpr std::string_view kPreface = "PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n";
constexpr size_t kFrameHeadBytes = 9;
constexpr size_t kMaxFrameBytes = 16384;
constexpr int kEndHeaders = 4;
constexpr int kAck = 1;
constexpr uint16_t kInitialWindowSetting = 4;
constexpr size_t kSettingBytes = 6;
constexpr int kSendPatienceSeconds = 5;
constexpr auto kWindowPatience = std::chrono::seconds(1);

std::string BigEndian(uint64_t value, int bytes) {
  std::string text;
  for (int i = bytes - 1; i >= 0; --i) {
    text.push_back(static_cast<char>(value >> (8 * i) & 0xff));
  }
  return text;
}

uint32_t Number(std::string_view big_endian) {
  uint32_t value = 0;
  for (const char byte : big_endian) {
    value = value << 8 | static_cast<uint8_t>(byte);
  }
  return value;
}

// HPACK: a literal that enters no table, name and value shorter than 127.
std::string Header(std::string_view name, std::string_view value) {
  std::string text(1, '\0');
  text += BigEndian(name.size(), 1);
  text += name;
  text += BigEndian(value.size(), 1);
  text += value;
  return text;
}

int Connected(std::string_view address, const std::string& from) {
  const size_t colon = address.rfind(':');
  const std::string host(address.substr(0, colon));
  const int port = std::stoi(std::string(address.substr(colon + 1)));
  sockaddr_in to = {};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<uint16_t>(port));
  inet_pton(AF_INET, host.c_str(), &to.sin_addr);
  const int peer = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (peer < 0) return -1;
  if (!from.empty()) {
    sockaddr_in source = {};
    source.sin_family = AF_INET;
    inet_pton(AF_INET, from.c_str(), &source.sin_addr);
    bind(peer, reinterpret_cast<const sockaddr*>(&source), sizeof source);
  }
  const timeval patience = {kSendPatienceSeconds, 0};
  setsockopt(peer, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
  if (connect(peer, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0) {
    return peer;
  }
  close(peer);
  return -1;
}

}  // namespace

std::string FrameBytes(Http2Frame type, int flags, uint32_t stream,
                       std::string_view payload) {
  std::string frame = BigEndian(payload.size(), 3);
  frame += BigEndian(static_cast<uint8_t>(type), 1);
  frame += BigEndian(static_cast<uint64_t>(flags), 1);
  frame += BigEndian(stream, 4);
  frame += payload;
  return frame;
}

std::string Http2Hello(uint32_t stream_window) {
  return std::string(kPreface) +
         FrameBytes(
             Http2Frame::kSettings, 0, 0,
             BigEndian(kInitialWindowSetting, 2) + BigEndian(stream_window, 4));
}

std::string Http2Call(uint32_t stream, std::string_view path,
                      std::string_view encoding) {
  std::string block = Header(":method", "POST") + Header(":scheme", "http") +
                      Header(":path", path) + Header(":authority", "test") +
                      Header("te", "trailers") +
                      Header("content-type", "application/grpc");
  if (!encoding.empty()) block += Header("grpc-encoding", encoding);
  return FrameBytes(Http2Frame::kHeaders, kEndHeaders, stream, block);
}

std::string GrpcMessage(std::string_view message, bool compressed,
                        size_t announced) {
  std::string bytes = BigEndian(compressed ? 1 : 0, 1);
  bytes += BigEndian(std::max(announced, message.size()), 4);
  bytes += message;
  return bytes;
}

std::string Http2ConnectionWindow(uint32_t bytes) {
  return FrameBytes(Http2Frame::kWindowUpdate, 0, 0, BigEndian(bytes, 4));
}

Http2Peer::Http2Peer(std::string_view address, const std::string& from)
    : socket_(Connected(address, from)) {}

Http2Peer::~Http2Peer() {
  if (socket_ >= 0) close(socket_);
}

Http2Peer::Http2Peer(Http2Peer&& other) noexcept
    : socket_(std::exchange(other.socket_, -1)),
      closed_(other.closed_),
      inbox_(std::move(other.inbox_)),
      counts_(std::move(other.counts_)),
      ended_(std::move(other.ended_)),
      window_(other.window_),
      initial_(other.initial_),
      windows_(std::move(other.windows_)) {}

bool Http2Peer::Send(std::string_view bytes) const {
  while (!bytes.empty()) {
    const ssize_t sent =
        send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent <= 0) return false;
    bytes.remove_prefix(static_cast<size_t>(sent));
  }
  return true;
}

bool Http2Peer::SendData(uint32_t stream, std::string_view bytes, bool end) {
  while (!bytes.empty()) {
    Read(kWindowPatience, [&] { return Allowed(stream) > 0; });
    const int64_t allowed = Allowed(stream);
    if (allowed <= 0 || closed_) return false;
    const std::string_view part =
        bytes.substr(0, std::min(kMaxFrameBytes, static_cast<size_t>(allowed)));
    bytes.remove_prefix(part.size());
    window_ -= static_cast<int64_t>(part.size());
    windows_[stream] -= static_cast<int64_t>(part.size());
    const int flags = end && bytes.empty() ? kEndStream : 0;
    if (!Send(FrameBytes(Http2Frame::kData, flags, stream, part))) return false;
  }
  return true;
}

void Http2Peer::Read(std::chrono::milliseconds patience,
                     const std::function<bool()>& enough) {
  using Clock = std::chrono::steady_clock;
  char buffer[65536];
  const auto end = Clock::now() + patience;
  while (!closed_ && !enough()) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
        end - Clock::now());
    pollfd waiting = {socket_, POLLIN, 0};
    if (left.count() <= 0 ||
        poll(&waiting, 1, static_cast<int>(left.count())) <= 0) {
      return;
    }
    const ssize_t count = recv(socket_, buffer, sizeof buffer, 0);
    closed_ = count <= 0;
    if (!closed_) inbox_.append(buffer, static_cast<size_t>(count));
    Parse();
  }
}

int Http2Peer::Count(Http2Frame type) const {
  const auto found = counts_.find(type);
  return found == counts_.end() ? 0 : found->second;
}

void Http2Peer::Parse() {
  std::string_view rest = inbox_;
  while (rest.size() >= kFrameHeadBytes) {
    const size_t size = Number(rest.substr(0, 3));
    if (rest.size() < kFrameHeadBytes + size) break;
    Take(static_cast<Http2Frame>(rest[3]), rest[4], Number(rest.substr(5, 4)),
         rest.substr(kFrameHeadBytes, size));
    rest.remove_prefix(kFrameHeadBytes + size);
  }
  inbox_ = std::string(rest);
}

void Http2Peer::Take(Http2Frame type, int flags, uint32_t stream,
                     std::string_view payload) {
  ++counts_[type];
  if (type == Http2Frame::kReset ||
      (type == Http2Frame::kHeaders && (flags & kEndStream) != 0)) {
    ended_.insert(stream);
  }
  if (type == Http2Frame::kWindowUpdate && payload.size() == 4) {
    (stream == 0 ? window_ : windows_[stream]) += Number(payload);
  }
  if (type != Http2Frame::kSettings || flags != 0) return;
  for (; payload.size() >= kSettingBytes;
       payload.remove_prefix(kSettingBytes)) {
    if (Number(payload.substr(0, 2)) == kInitialWindowSetting) {
      initial_ = Number(payload.substr(2, 4));
    }
  }
  // Only then the server's settings count.
  Send(FrameBytes(Http2Frame::kSettings, kAck, 0, ""));
}

int64_t Http2Peer::Allowed(uint32_t stream) const {
  const auto found = windows_.find(stream);
  return std::min(window_,
                  initial_ + (found == windows_.end() ? 0 : found->second));
}

}  // namespace argmesh
