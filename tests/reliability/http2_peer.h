// A peer that speaks HTTP/2 by hand, frame by frame, and so may break every
// rule of it.
//
//   Http2Peer peer(installation.address());
//   peer.Send(Http2Hello(0) + Http2Call(1, "/argmesh.v1.…/GetShape"));
#ifndef ARGMESH_TESTS_RELIABILITY_HTTP2_PEER_H_
#define ARGMESH_TESTS_RELIABILITY_HTTP2_PEER_H_

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>

namespace argmesh {

enum class Http2Frame : uint8_t {
  kData = 0,
  kHeaders = 1,
  kReset = 3,
  kSettings = 4,
  kPing = 6,
  kGoAway = 7,
  kWindowUpdate = 8,
};

// Flags of frames; kEndStream is that of data and headers.
inline constexpr int kEndStream = 1;

std::string FrameBytes(Http2Frame type, int flags, uint32_t stream,
                       std::string_view payload);

// Preface and settings: how many bytes of an answer the server may send on
// each stream before it is given more.
std::string Http2Hello(uint32_t stream_window);

// The head of a gRPC call; `encoding` as in grpc-encoding, or empty.
std::string Http2Call(uint32_t stream, std::string_view path,
                      std::string_view encoding = "");

// A message as gRPC frames it; `announced` instead of its size where that is
// more, as if the rest came later.
std::string GrpcMessage(std::string_view message, bool compressed = false,
                        size_t announced = 0);

// Gives the server `bytes` more of the connection's window.
std::string Http2ConnectionWindow(uint32_t bytes);

class Http2Peer {
 public:
  // Connects to HOST:PORT, as the IPv4 address `from` where it is not empty;
  // connected() is false when nobody takes it.
  explicit Http2Peer(std::string_view address, const std::string& from = "");
  ~Http2Peer();
  Http2Peer(Http2Peer&& other) noexcept;
  Http2Peer& operator=(Http2Peer&&) = delete;

  bool connected() const { return socket_ >= 0; }
  // As it is. False when the server has closed, or takes nothing for 5 s.
  bool Send(std::string_view bytes) const;
  // In data frames, as the server's windows allow: reads what it says
  // meanwhile. False when it lets nothing through for 1 s.
  bool SendData(uint32_t stream, std::string_view bytes, bool end);
  // Reads until `enough` holds, the server closes or `patience` is over.
  void Read(
      std::chrono::milliseconds patience,
      const std::function<bool()>& enough = [] { return false; });

  // Of what has been read.
  bool closed() const { return closed_; }
  int Count(Http2Frame type) const;
  // Streams that the server has ended, by their status or a reset.
  int ended() const { return static_cast<int>(ended_.size()); }

 private:
  void Parse();
  void Take(Http2Frame type, int flags, uint32_t stream,
            std::string_view payload);
  int64_t Allowed(uint32_t stream) const;

  int socket_ = -1;
  bool closed_ = false;
  std::string inbox_;  // the frame that has not come whole
  std::map<Http2Frame, int> counts_;
  std::set<uint32_t> ended_;
  // How many bytes the server takes: of all streams, and of each beside the
  // initial ones.
  int64_t window_ = 65535;
  int64_t initial_ = 65535;
  std::map<uint32_t, int64_t> windows_;
};

}  // namespace argmesh

#endif  // ARGMESH_TESTS_RELIABILITY_HTTP2_PEER_H_
