// SHA-256: the content address of an uploaded mesh.
//
// Sha256Hasher takes the bytes in pieces (streamed uploads); ComputeSha256 at
// once. Cost O(bytes). One hasher belongs to one thread.
#ifndef ARGMESH_CORE_BASE_SHA256_H_
#define ARGMESH_CORE_BASE_SHA256_H_

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace argmesh {

using Sha256Digest = std::array<uint8_t, 32>;

class Sha256Hasher {
 public:
  Sha256Hasher();
  ~Sha256Hasher();
  Sha256Hasher(Sha256Hasher&&) noexcept;
  Sha256Hasher& operator=(Sha256Hasher&&) noexcept;

  void Update(std::string_view bytes);
  // The digest of all bytes so far; the hasher must not be used afterwards.
  Sha256Digest Finish();

 private:
  struct Context;
  std::unique_ptr<Context> context_;
};

Sha256Digest ComputeSha256(std::string_view bytes);

// 64 lower-case hexadecimal digits.
std::string ToHex(const Sha256Digest& digest);

}  // namespace argmesh

#endif  // ARGMESH_CORE_BASE_SHA256_H_
