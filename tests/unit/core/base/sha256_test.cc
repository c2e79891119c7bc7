#include "core/base/sha256.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace argmesh {
namespace {

constexpr char kEmptyDigest[] =
    "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";
constexpr char kAbcDigest[] =
    "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";

TEST(ComputeSha256, GivesTheKnownAnswersOfFips180) {
  EXPECT_EQ(ToHex(ComputeSha256("")), kEmptyDigest);
  EXPECT_EQ(ToHex(ComputeSha256("abc")), kAbcDigest);
  EXPECT_EQ(ToHex(ComputeSha256(std::string(1'000'000, 'a'))),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256Hasher, GivesTheSameDigestForAnyPieces) {
  const std::string text(200, 'x');
  const Sha256Digest whole = ComputeSha256(text);
  for (const size_t piece : {1U, 7U, 64U, 199U}) {
    Sha256Hasher hasher;
    for (size_t at = 0; at < text.size(); at += piece) {
      hasher.Update(std::string_view(text).substr(at, piece));
    }
    EXPECT_EQ(hasher.Finish(), whole) << "pieces of " << piece;
  }
}

TEST(Sha256Hasher, KeepsItsStateWhenMoved) {
  Sha256Hasher first;
  first.Update("ab");
  Sha256Hasher second = std::move(first);
  second.Update("c");
  EXPECT_EQ(ToHex(second.Finish()), kAbcDigest);
}

}  // namespace
}  // namespace argmesh
