#include "core/graph/graph_codec.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <string>

#include "core/base/byte_writer.h"
#include "core/base/random.h"
#include "core/base/sealed_bytes.h"
#include "tests/support/random_graph.h"
#include "tests/support/status_matchers.h"

namespace argmesh {
namespace {

using ::testing::_;
using ::testing::HasSubstr;

// The seal put right again: damage reaches the parser behind it.
std::string ResealGraph(const std::string& bytes) {
  return SealBytes("ARGG", kShapeGraphVersion, bytes.substr(kSealBytes));
}

RandomGraphOptions SmallGraph() {
  return {.level_nodes = {1, 3}, .uniform_nodes = 2, .modes = 2};
}

TEST(GraphCodec, GivesEveryGraphBackToTheBit) {
  for (uint64_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    RandomGraphOptions options;
    if (seed % 3 == 1) options = SmallGraph();
    if (seed % 3 == 2) {
      options = {.level_nodes = {5}, .uniform_nodes = 0, .modes = 0};
    }
    const ShapeGraph graph = MakeRandomGraph(seed, options);
    const std::string bytes = SerializeShapeGraph(graph);
    ASSERT_OK_AND_ASSIGN(const ShapeGraph parsed, ParseShapeGraph(bytes));
    EXPECT_EQ(parsed, graph);
    EXPECT_EQ(SerializeShapeGraph(parsed), bytes);
  }
}

TEST(GraphCodec, GivesAGraphOfNothingBack) {
  ASSERT_OK_AND_ASSIGN(const ShapeGraph parsed,
                       ParseShapeGraph(SerializeShapeGraph(ShapeGraph())));
  EXPECT_EQ(parsed, ShapeGraph());
}

TEST(GraphCodec, TakesTheDocumentedBytes) {
  ShapeGraph graph =
      MakeRandomGraph(1, {.level_nodes = {3}, .uniform_nodes = 0, .modes = 2});
  graph.levels[0].edges = {{0, 1, 0.5F, 0.25F}};
  // Seal, frame, two levels, nodes, one edge, three pairs, modes.
  EXPECT_EQ(SerializeShapeGraph(graph).size(),
            20u + (40 + 4 + 4) + 2 * 24 + 3 * 384 + 16 + 3 * 4 + 2 * 32);
}

TEST(GraphCodec, RefusesEveryTruncation) {
  const std::string bytes =
      SerializeShapeGraph(MakeRandomGraph(2, SmallGraph()));
  for (size_t size = 0; size < bytes.size(); ++size) {
    const std::string prefix = bytes.substr(0, size);
    ASSERT_THAT(ParseShapeGraph(prefix),
                StatusIs(absl::StatusCode::kDataLoss, _))
        << size;
    if (size < kSealBytes) continue;
    ASSERT_THAT(ParseShapeGraph(ResealGraph(prefix)),
                StatusIs(absl::StatusCode::kDataLoss, HasSubstr("shape graph")))
        << size;
  }
}

TEST(GraphCodec, RefusesBytesLeftOver) {
  const std::string bytes = SerializeShapeGraph(MakeRandomGraph(3));
  EXPECT_THAT(ParseShapeGraph(ResealGraph(bytes + '\0')),
              StatusIs(absl::StatusCode::kDataLoss, HasSubstr("left over")));
}

TEST(GraphCodec, NoticesEveryFlippedByte) {
  const std::string bytes = SerializeShapeGraph(MakeRandomGraph(4));
  Random random(44);
  for (int i = 0; i < 5000; ++i) {
    std::string damaged = bytes;
    const size_t at = random.Below(bytes.size());
    const auto flip = static_cast<char>(1 + random.Below(255));
    damaged[at] = static_cast<char>(damaged[at] ^ flip);
    ASSERT_THAT(ParseShapeGraph(damaged),
                StatusIs(absl::StatusCode::kDataLoss, _))
        << "byte " << at << " flip " << int{flip};
  }
}

// Behind a valid checksum anything may stand: the answer is kDataLoss or a
// graph that is well formed and is what the bytes say.
TEST(GraphCodec, NeverBelievesDamageBehindAValidChecksum) {
  const std::string bytes =
      SerializeShapeGraph(MakeRandomGraph(5, SmallGraph()));
  Random random(55);
  int refused = 0;
  for (int i = 0; i < 10000; ++i) {
    std::string damaged = bytes;
    const uint64_t flips = 1 + random.Below(4);
    for (uint64_t f = 0; f < flips; ++f) {
      const size_t at = kSealBytes + random.Below(bytes.size() - kSealBytes);
      damaged[at] = static_cast<char>(random.Below(256));
    }
    damaged = ResealGraph(damaged);
    const absl::StatusOr<ShapeGraph> parsed = ParseShapeGraph(damaged);
    if (parsed.ok()) {
      ASSERT_THAT(CheckShapeGraph(*parsed), IsOk()) << i;
      ASSERT_EQ(SerializeShapeGraph(*parsed), damaged) << i;
    } else {
      ASSERT_THAT(parsed, StatusIs(absl::StatusCode::kDataLoss, _)) << i;
      ++refused;
    }
  }
  EXPECT_GT(refused, 500);
}

TEST(GraphCodec, RefusesCountsThatNoBytesStandFor) {
  const uint32_t counts[] = {65, 1u << 20,
                             std::numeric_limits<uint32_t>::max()};
  for (const uint32_t count : counts) {
    ByteWriter levels;
    for (int i = 0; i < 4; ++i) levels.WriteF64(1);
    levels.WriteU32(1);
    levels.WriteU32(0);
    levels.WriteU32(count);
    EXPECT_THAT(
        ParseShapeGraph(SealBytes("ARGG", kShapeGraphVersion, levels.bytes())),
        StatusIs(absl::StatusCode::kDataLoss, HasSubstr("count")))
        << count;
  }
}

TEST(GraphCodec, RefusesLevelsAndNodesOverTheirLimits) {
  ShapeGraph graph = MakeRandomGraph(6, SmallGraph());
  graph.levels.assign(65, graph.levels[0]);
  EXPECT_THAT(ParseShapeGraph(SerializeShapeGraph(graph)),
              StatusIs(absl::StatusCode::kDataLoss, HasSubstr("65 levels")));
  graph = MakeRandomGraph(6, SmallGraph());
  graph.uniform.nodes.assign(4097, graph.uniform.nodes[0]);
  EXPECT_THAT(ParseShapeGraph(SerializeShapeGraph(graph)),
              StatusIs(absl::StatusCode::kDataLoss, HasSubstr("4097 nodes")));
}

TEST(GraphCodec, RefusesAGraphThatIsNotWellFormed) {
  ShapeGraph graph = MakeRandomGraph(8);
  graph.levels[1].nodes[0].area = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(
      ParseShapeGraph(SerializeShapeGraph(graph)),
      StatusIs(absl::StatusCode::kDataLoss, HasSubstr("level 1 node 0: area")));
}

TEST(GraphCodec, RefusesFaceLabels) {
  EXPECT_THAT(ParseShapeGraph(SerializeFaceLabels(MakeRandomFaceLabels(1, 5))),
              StatusIs(absl::StatusCode::kDataLoss, HasSubstr("magic")));
}

}  // namespace
}  // namespace argmesh
