#include "server/rpc/convert_mesh.h"

#include <gtest/gtest.h>

#include <cctype>
#include <string>

#include "server/engine/error_reason.h"

namespace argmesh {
namespace {

TEST(ConvertMesh, GivesEveryFormatBack) {
  for (const MeshFormat format :
       {MeshFormat::kUnknown, MeshFormat::kOff, MeshFormat::kObj,
        MeshFormat::kPly, MeshFormat::kStl}) {
    const auto back = FromProto("format", ToProto(format));
    ASSERT_TRUE(back.ok());
    EXPECT_EQ(*back, format);
  }
  EXPECT_EQ(
      ReasonOf(FromProto("format", static_cast<v1::MeshFormat>(5)).status()),
      ErrorReason::kFieldInvalid);
}

TEST(ConvertMesh, ReadsDigestsOfEitherCaseAndRefusesAllElse) {
  const Sha256Digest digest = ComputeSha256("argmesh");
  std::string hex = ToHex(digest);
  ASSERT_TRUE(ParseSha256("sha256", hex).ok());
  EXPECT_EQ(*ParseSha256("sha256", hex), digest);
  for (char& c : hex) c = static_cast<char>(std::toupper(c));
  EXPECT_EQ(*ParseSha256("sha256", hex), digest);
  EXPECT_EQ(ReasonOf(ParseSha256("sha256", "").status()),
            ErrorReason::kFieldRequired);
  for (const std::string& bad : {hex.substr(1), hex + "0", std::string(64, 'g'),
                                 std::string(63, '0') + " "}) {
    EXPECT_EQ(ReasonOf(ParseSha256("sha256", bad).status()),
              ErrorReason::kFieldInvalid)
        << bad;
  }
}

TEST(ConvertMesh, RoundsTimesDownOnBothSidesOfTheEpoch) {
  const auto after = ToTimestamp(absl::FromUnixNanos(1'500'000'000));
  EXPECT_EQ(after.seconds(), 1);
  EXPECT_EQ(after.nanos(), 500'000'000);
  const auto before = ToTimestamp(absl::FromUnixNanos(-1));
  EXPECT_EQ(before.seconds(), -1);
  EXPECT_EQ(before.nanos(), 999'999'999);
  const auto duration = ToDuration(absl::Milliseconds(-1500));
  EXPECT_EQ(duration.seconds(), -1);
  EXPECT_EQ(duration.nanos(), -500'000'000);
}

}  // namespace
}  // namespace argmesh
