#include "core/containment/window_codec.h"

#include <gtest/gtest.h>

#include <string>

#include "core/base/byte_writer.h"
#include "core/base/random.h"
#include "core/base/sealed_bytes.h"
#include "core/containment/window_codebook.h"
#include "tests/support/status_matchers.h"

namespace argmesh {
namespace {

using ::testing::_;
using ::testing::HasSubstr;

PackedPoint RandomPoint(Random& random) {
  PackedPoint point;
  for (int16_t& x : point.position) x = static_cast<int16_t>(random.Below(999));
  for (int8_t& x : point.normal) x = static_cast<int8_t>(random.Below(127));
  return point;
}

TargetWindows RandomWindows(uint64_t seed) {
  Random random(seed);
  TargetWindows windows;
  windows.frame.origin = {1, 2, 3};
  windows.frame.scale = 0.5;
  for (WindowLevel& level : windows.levels) {
    const size_t count = random.Below(5);
    for (size_t i = 0; i < count; ++i) {
      level.frames.push_back(RandomPoint(random));
      WindowDescriptor descriptor;
      for (int8_t& x : descriptor) x = static_cast<int8_t>(random.Below(255));
      level.descriptors.push_back(descriptor);
    }
  }
  for (int i = 0; i < 7; ++i) windows.points.push_back(RandomPoint(random));
  return windows;
}

WindowWords SomeWords() {
  WindowWords words;
  words.levels[0] = {0, 5, kNumWindowWords - 1};
  words.levels[8] = {77};
  return words;
}

TEST(WindowCodec, GivesWindowsBackToTheBit) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    const TargetWindows windows = RandomWindows(seed);
    const std::string bytes = SerializeTargetWindows(windows);
    ASSERT_OK_AND_ASSIGN(const TargetWindows parsed, ParseTargetWindows(bytes));
    EXPECT_EQ(parsed.points, windows.points);
    EXPECT_EQ(parsed.frame.origin, windows.frame.origin);
    for (size_t l = 0; l < parsed.levels.size(); ++l) {
      EXPECT_EQ(parsed.levels[l].frames, windows.levels[l].frames);
      EXPECT_EQ(parsed.levels[l].descriptors, windows.levels[l].descriptors);
    }
    EXPECT_EQ(SerializeTargetWindows(parsed), bytes);
  }
}

TEST(WindowCodec, GivesWordsBack) {
  const std::string bytes = SerializeWindowWords(SomeWords());
  ASSERT_OK_AND_ASSIGN(const WindowWords parsed, ParseWindowWords(bytes));
  EXPECT_EQ(parsed.levels, SomeWords().levels);
  EXPECT_EQ(bytes.size(), kSealBytes + 9 * 4 + 4 * 2);
}

TEST(WindowCodec, NoticesEveryDamagedByteAndEveryShortening) {
  for (const std::string& bytes : {SerializeWindowWords(SomeWords()),
                                   SerializeTargetWindows(RandomWindows(1))}) {
    const auto parse = [](const std::string& blob) {
      const absl::Status words = ParseWindowWords(blob).status();
      return words.ok() ? words : ParseTargetWindows(blob).status();
    };
    for (size_t i = 0; i < bytes.size(); ++i) {
      std::string damaged = bytes;
      damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
      EXPECT_FALSE(parse(damaged).ok()) << i;
      EXPECT_FALSE(parse(bytes.substr(0, i)).ok()) << i;
    }
  }
}

TEST(WindowCodec, NamesAnotherVersion) {
  EXPECT_THAT(ParseWindowWords(SealBytes("ARGW", kWindowsVersion + 1, "x")),
              StatusIs(absl::StatusCode::kFailedPrecondition,
                       HasSubstr("window words")));
  EXPECT_THAT(
      ParseTargetWindows(SealBytes("ARGV", kWindowsVersion + 1, "x")),
      StatusIs(absl::StatusCode::kFailedPrecondition, HasSubstr("version")));
}

TEST(WindowCodec, RefusesHostileCounts) {
  ByteWriter words;
  words.WriteU32(0xffffffff);
  EXPECT_THAT(
      ParseWindowWords(SealBytes("ARGW", kWindowsVersion, words.bytes())),
      StatusIs(absl::StatusCode::kDataLoss, _));
  ByteWriter windows;
  for (int k = 0; k < 4; ++k) windows.WriteF64(1);
  windows.WriteU32(0x80000000);
  EXPECT_THAT(
      ParseTargetWindows(SealBytes("ARGV", kWindowsVersion, windows.bytes())),
      StatusIs(absl::StatusCode::kDataLoss, _));
}

TEST(WindowCodec, RefusesWordsOutOfRangeOrOrder) {
  for (const std::vector<uint16_t>& level :
       {std::vector<uint16_t>{3, 3}, {4, 1}, {kNumWindowWords}}) {
    WindowWords words;
    words.levels[2] = level;
    EXPECT_THAT(ParseWindowWords(SerializeWindowWords(words)),
                StatusIs(absl::StatusCode::kDataLoss, HasSubstr("word")));
  }
}

TEST(WindowCodec, RefusesAFrameWithoutSize) {
  TargetWindows windows = RandomWindows(1);
  windows.frame.scale = 0;
  EXPECT_THAT(ParseTargetWindows(SerializeTargetWindows(windows)),
              StatusIs(absl::StatusCode::kDataLoss, HasSubstr("frame")));
}

TEST(WindowCodebook, GivesItsBytesBack) {
  const std::string bytes = SerializeWindowCodebook(DefaultWindowCodebook());
  ASSERT_OK_AND_ASSIGN(const WindowCodebook parsed, ParseWindowCodebook(bytes));
  EXPECT_EQ(SerializeWindowCodebook(parsed), bytes);
  EXPECT_THAT(ParseWindowCodebook(bytes.substr(0, bytes.size() - 1)),
              StatusIs(absl::StatusCode::kDataLoss, _));
}

}  // namespace
}  // namespace argmesh
