#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "core/base/random.h"
#include "core/base/sealed_bytes.h"
#include "core/graph/graph_codec.h"
#include "tests/support/random_graph.h"
#include "tests/support/status_matchers.h"

namespace argmesh {
namespace {

using ::testing::_;
using ::testing::HasSubstr;

std::string ResealLabels(const std::string& bytes) {
  return SealBytes("ARGL", kShapeGraphVersion, bytes.substr(kSealBytes));
}

TEST(FaceLabelsCodec, GivesLabelsBack) {
  for (uint64_t seed = 0; seed < 20; ++seed) {
    FaceLabels labels =
        MakeRandomFaceLabels(seed, static_cast<int>(seed * 37 % 300));
    if (seed % 4 == 0) labels.uniform.clear();
    const std::string bytes = SerializeFaceLabels(labels);
    EXPECT_EQ(
        bytes.size(),
        kSealBytes + 8 + 2 * (labels.component.size() + labels.uniform.size()));
    ASSERT_OK_AND_ASSIGN(const FaceLabels parsed, ParseFaceLabels(bytes));
    EXPECT_EQ(parsed, labels) << seed;
  }
}

TEST(FaceLabelsCodec, RefusesEveryTruncation) {
  const std::string bytes = SerializeFaceLabels(MakeRandomFaceLabels(1, 40));
  for (size_t size = 0; size < bytes.size(); ++size) {
    const std::string prefix = bytes.substr(0, size);
    ASSERT_THAT(ParseFaceLabels(prefix),
                StatusIs(absl::StatusCode::kDataLoss, _))
        << size;
    if (size < kSealBytes) continue;
    ASSERT_THAT(ParseFaceLabels(ResealLabels(prefix)),
                StatusIs(absl::StatusCode::kDataLoss, HasSubstr("face labels")))
        << size;
  }
}

TEST(FaceLabelsCodec, NeverBelievesDamageBehindAValidChecksum) {
  const std::string bytes = SerializeFaceLabels(MakeRandomFaceLabels(2, 40));
  Random random(22);
  for (int i = 0; i < 5000; ++i) {
    std::string damaged = bytes;
    const size_t at = kSealBytes + random.Below(bytes.size() - kSealBytes);
    damaged[at] = static_cast<char>(random.Below(256));
    damaged = ResealLabels(damaged);
    const absl::StatusOr<FaceLabels> parsed = ParseFaceLabels(damaged);
    if (parsed.ok()) {
      ASSERT_EQ(SerializeFaceLabels(*parsed), damaged) << i;
    } else {
      ASSERT_THAT(parsed, StatusIs(absl::StatusCode::kDataLoss, _)) << i;
    }
  }
}

TEST(FaceLabelsCodec, RefusesLabelsThatNameNoNode) {
  FaceLabels labels;
  labels.component = {0, -2};
  EXPECT_THAT(ParseFaceLabels(SerializeFaceLabels(labels)),
              StatusIs(absl::StatusCode::kDataLoss,
                       HasSubstr("face 1: label -2 outside -1 .. 4095")));
  labels.component = {4096};
  EXPECT_THAT(ParseFaceLabels(SerializeFaceLabels(labels)),
              StatusIs(absl::StatusCode::kDataLoss, HasSubstr("label 4096")));
}

TEST(FaceLabelsCodec, RefusesUniformLabelsOfAnotherNumberOfFaces) {
  FaceLabels labels;
  labels.component = {0, 1, 2};
  labels.uniform = {0, 1};
  EXPECT_THAT(ParseFaceLabels(SerializeFaceLabels(labels)),
              StatusIs(absl::StatusCode::kDataLoss,
                       HasSubstr("2 uniform labels of 3 faces")));
}

}  // namespace
}  // namespace argmesh
