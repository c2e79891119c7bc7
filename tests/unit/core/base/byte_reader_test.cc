// ByteReader and its mirror, ByteWriter.
#include "core/base/byte_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <string>

#include "core/base/byte_writer.h"
#include "tests/support/status_matchers.h"

namespace argmesh {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(ByteWriter, WritesLittleEndian) {
  ByteWriter writer;
  writer.WriteU8(0x01);
  writer.WriteU16(0x0302);
  writer.WriteU32(0x07060504);
  writer.WriteU64(0x0F0E0D0C0B0A0908);
  EXPECT_EQ(writer.bytes(),
            "\x01\x02\x03\x04\x05\x06\x07\x08\x09\x0A\x0B\x0C\x0D\x0E\x0F");
}

TEST(ByteReader, ReadsBackWhatTheWriterWrote) {
  ByteWriter writer;
  writer.WriteU8(255);
  writer.WriteU16(65535);
  writer.WriteU32(4'000'000'000U);
  writer.WriteU64(std::numeric_limits<uint64_t>::max());
  writer.WriteF32(-1.5F);
  writer.WriteF64(0.1);
  writer.WriteF32Array(std::array<float, 2>{2.0F, 3.0F});
  writer.WriteBytes("end");
  const std::string bytes = writer.TakeBytes();

  ByteReader reader(bytes, "test");
  EXPECT_EQ(reader.ReadU8().value(), 255);
  EXPECT_EQ(reader.ReadU16().value(), 65535);
  EXPECT_EQ(reader.ReadU32().value(), 4'000'000'000U);
  EXPECT_EQ(reader.ReadU64().value(), std::numeric_limits<uint64_t>::max());
  EXPECT_EQ(reader.ReadF32().value(), -1.5F);
  EXPECT_EQ(reader.ReadF64().value(), 0.1);
  EXPECT_THAT(reader.ReadF32Array(2).value(), ElementsAre(2.0F, 3.0F));
  EXPECT_EQ(reader.ReadBytes(3).value(), "end");
  EXPECT_THAT(reader.ExpectEnd(), IsOk());
}

TEST(ByteReader, RefusesToReadPastTheEndAndStaysWhereItIs) {
  ByteReader reader("abc", "piece");
  ASSERT_THAT(reader.ReadU8(), IsOk());
  EXPECT_THAT(reader.ReadU32(),
              StatusIs(absl::StatusCode::kDataLoss,
                       HasSubstr("piece: 4 bytes needed at offset 1, 2 left")));
  EXPECT_EQ(reader.position(), 1U);
  EXPECT_EQ(reader.ReadU16().value(), 0x6362);
  EXPECT_THAT(reader.ReadU8(),
              StatusIs(absl::StatusCode::kDataLoss, HasSubstr("0 left")));
}

TEST(ByteReader, RefusesACountThatTheBytesLeftCannotHold) {
  ByteWriter writer;
  writer.WriteU32(0xFFFFFFFF);
  writer.WriteU64(0);
  ByteReader reader(writer.bytes(), "list");
  EXPECT_THAT(reader.ReadCount(4),
              StatusIs(absl::StatusCode::kDataLoss,
                       HasSubstr("count 4294967295 at offset 0")));
}

TEST(ByteReader, TakesTheLargestCountThatFits) {
  ByteWriter writer;
  writer.WriteU32(2);
  writer.WriteU64(0);
  ByteReader reader(writer.bytes(), "list");
  EXPECT_EQ(reader.ReadCount(4).value(), 2U);
}

TEST(ByteReader, RefusesArraysWhoseSizeOverflows) {
  ByteReader reader("12345678", "array");
  constexpr size_t kHuge = std::numeric_limits<size_t>::max() / 2;
  EXPECT_THAT(reader.ReadF32Array(kHuge),
              StatusIs(absl::StatusCode::kDataLoss, HasSubstr("array")));
  EXPECT_THAT(reader.ReadBytes(std::numeric_limits<size_t>::max()),
              StatusIs(absl::StatusCode::kDataLoss, HasSubstr("array")));
  EXPECT_EQ(reader.remaining(), 8U);
}

TEST(ByteReader, NamesBytesThatAreLeftOver) {
  ByteReader reader("12", "record");
  ASSERT_THAT(reader.ReadU8(), IsOk());
  EXPECT_THAT(reader.ExpectEnd(),
              StatusIs(absl::StatusCode::kDataLoss,
                       HasSubstr("record: 1 bytes left over at offset 1")));
}

}  // namespace
}  // namespace argmesh
