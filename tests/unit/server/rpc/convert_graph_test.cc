#include "server/rpc/convert_graph.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "server/engine/error_reason.h"
#include "tests/support/random_graph.h"

namespace argmesh {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(ConvertGraph, GivesEveryGraphBackToTheBit) {
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    const ShapeGraph graph = MakeRandomGraph(seed);
    const auto back = FromProto("graph", ToProto(graph));
    ASSERT_TRUE(back.ok()) << "seed " << seed << ": " << back.status();
    EXPECT_TRUE(*back == graph) << "seed " << seed;
  }
}

TEST(ConvertGraph, GivesAGraphWithoutUniformCellsBack) {
  RandomGraphOptions options;
  options.uniform_nodes = 0;
  const ShapeGraph graph = MakeRandomGraph(3, options);
  const v1::ShapeGraph proto = ToProto(graph);
  EXPECT_FALSE(proto.has_uniform());
  const auto back = FromProto("graph", proto);
  ASSERT_TRUE(back.ok()) << back.status();
  EXPECT_TRUE(*back == graph);
}

TEST(ConvertGraph, RefusesGraphsThatAreNotWellFormed) {
  struct Row {
    const char* name;
    std::function<void(v1::ShapeGraph&)> damage;
    ErrorReason reason;
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Row rows[] = {
      {"version", [](auto& g) { g.set_version(99); },
       ErrorReason::kGraphVersionMismatch},
      {"no levels", [](auto& g) { g.clear_levels(); },
       ErrorReason::kGraphInvalid},
      {"short histogram",
       [](auto& g) {
         g.mutable_levels(0)
             ->mutable_nodes(0)
             ->mutable_histograms()
             ->mutable_shape_index()
             ->RemoveLast();
       },
       ErrorReason::kGraphInvalid},
      {"no wave kernel",
       [](auto& g) {
         g.mutable_levels(1)->mutable_nodes(0)->clear_wave_kernel();
       },
       ErrorReason::kGraphInvalid},
      {"missing distance",
       [](auto& g) { g.mutable_levels(1)->mutable_distances()->RemoveLast(); },
       ErrorReason::kGraphInvalid},
      {"parent beyond",
       [](auto& g) { g.mutable_levels(1)->mutable_nodes(0)->set_parent(1000); },
       ErrorReason::kGraphInvalid},
      {"not a number",
       [nan](auto& g) {
         g.mutable_levels(0)->mutable_nodes(0)->set_gauss_mean(nan);
       },
       ErrorReason::kGraphInvalid},
      {"mode's node", [](auto& g) { g.mutable_modes(0)->set_node(-7); },
       ErrorReason::kGraphInvalid},
  };
  for (const Row& row : rows) {
    v1::ShapeGraph proto = ToProto(MakeRandomGraph(11));
    row.damage(proto);
    const auto back = FromProto("query.graph", proto);
    ASSERT_FALSE(back.ok()) << row.name;
    EXPECT_EQ(ReasonOf(back.status()), row.reason) << row.name;
    EXPECT_THAT(MetadataOf(back.status()).at("field"), HasSubstr("query.graph"))
        << row.name;
  }
}

TEST(ConvertGraph, LabelsARangeOfFacesAtALevel) {
  const ShapeGraph graph = MakeRandomGraph(2);
  FaceLabels labels;
  labels.component = {0, 3, -1, 9, 5};
  labels.uniform = {1, 1, -1, 0, 11};
  const int finest = static_cast<int>(graph.levels.size()) - 1;
  const v1::FaceLabels middle = ToProto(graph, labels, finest, {1, 3});
  EXPECT_THAT(middle.labels(), ElementsAre(3, -1, 9));
  EXPECT_EQ(middle.first_face(), 1);
  EXPECT_EQ(middle.total_faces(), 5);
  const v1::FaceLabels uniform = ToProto(graph, labels, finest + 1, {3, 100});
  EXPECT_THAT(uniform.labels(), ElementsAre(0, 11));
  EXPECT_EQ(uniform.level(), "uniform");
  const v1::FaceLabels coarse = ToProto(graph, labels, finest - 1, {0, 5});
  const auto& nodes = graph.levels.back().nodes;
  EXPECT_THAT(coarse.labels(), ElementsAre(nodes[0].parent, nodes[3].parent, -1,
                                           nodes[9].parent, nodes[5].parent));
  EXPECT_EQ(ToProto(graph, labels, finest, {70, 5}).labels_size(), 0);
}

}  // namespace
}  // namespace argmesh
