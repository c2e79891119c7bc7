#include "core/containment/containment_ranking.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include "core/containment/query_windows.h"
#include "core/containment/target_windows.h"
#include "core/containment/window_index.h"
#include "core/containment/window_words.h"
#include "core/geometry/area.h"
#include "core/synthesis/mesh_cut.h"
#include "core/synthesis/mesh_noise.h"
#include "tests/support/status_matchers.h"
#include "tests/support/test_meshes.h"
#include "tests/unit/core/containment/small_gallery.h"

namespace argmesh {
namespace {

using ::testing::_;
using ::testing::HasSubstr;

QueryWindows Query(const TriangleMesh& mesh) {
  return *ExtractQueryWindows(mesh);
}

const TriangleMesh& MeshOf(const std::string& class_name) {
  return Gallery().meshes[static_cast<size_t>(Gallery().SlotOf(class_name))];
}

absl::StatusOr<ContainmentRanking> Rank(
    const QueryWindows& query, const RankContainmentOptions& options = {},
    const ParallelRunner& runner = {}, const StopToken& stop = {}) {
  return RankContainment(query, Gallery().index, Gallery().Loader(), options,
                         runner, stop);
}

// The largest distance between where both transforms take the mesh, in
// diagonals of where the first takes it.
double Apart(const Eigen::Matrix4d& a, const Eigen::Matrix4d& b,
             const TriangleMesh& mesh) {
  const VertexMatrix x =
      (mesh.V * a.topLeftCorner<3, 3>().transpose()).rowwise() +
      a.topRightCorner<3, 1>().transpose();
  const VertexMatrix y =
      (mesh.V * b.topLeftCorner<3, 3>().transpose()).rowwise() +
      b.topRightCorner<3, 1>().transpose();
  const double diagonal =
      (x.colwise().maxCoeff() - x.colwise().minCoeff()).norm();
  return (x - y).rowwise().norm().maxCoeff() / diagonal;
}

TEST(RankContainment, VerifiesAMovedPieceInItsSource) {
  for (const char* source : {"chair", "human", "teapot"}) {
    SCOPED_TRACE(source);
    const MovedPiece piece = CutAndMove(MeshOf(source), 2, 11);
    const QueryWindows query = Query(piece.mesh);
    ASSERT_OK_AND_ASSIGN(const ContainmentRanking ranking, Rank(query));
    ASSERT_FALSE(ranking.matches.empty());
    const RankedContainment& first = ranking.matches[0];
    EXPECT_EQ(first.slot, Gallery().SlotOf(source));
    EXPECT_TRUE(first.match.verified);
    EXPECT_FALSE(first.match.flipped);
    EXPECT_FALSE(first.tied);
    EXPECT_FALSE(ranking.generic);
    EXPECT_LT(Apart(first.match.transform, piece.transform, piece.mesh), 0.02);
    EXPECT_GT(first.match.query_coverage, 0.95);
    const double share =
        ComputeFaceAreas(CutAndMove(MeshOf(source), 2, 11).mesh).sum() *
        std::pow(piece.transform.topLeftCorner<3, 3>().determinant(), 2.0 / 3) /
        ComputeFaceAreas(MeshOf(source)).sum();
    EXPECT_NEAR(first.match.target_coverage, share, 0.03);
    for (size_t i = 1; i < ranking.matches.size(); ++i) {
      EXPECT_FALSE(ranking.matches[i].match.verified) << i;
    }
  }
}

TEST(RankContainment, FindsEveryPlaceOfAPartThatIsThereSeveralTimes) {
  const TriangleMesh& mug = MeshOf("mug");
  const double length = mug.V.col(0).maxCoeff() - mug.V.col(0).minCoeff();
  TriangleMesh shelf = mug;
  for (int i = 1; i < 3; ++i) {
    shelf = Join(shelf, Translated(mug, {1.5 * i * length, 0, 0}));
  }
  ASSERT_OK_AND_ASSIGN(const TargetWindows windows,
                       ExtractTargetWindows(shelf));
  const auto target = std::make_shared<const TargetWindows>(windows);
  WindowIndex index;
  index.Set(0, AssignWindowWords(windows));
  ASSERT_OK_AND_ASSIGN(
      const ContainmentRanking ranking,
      RankContainment(Query(mug), index, [&](int64_t) { return target; }));
  const RankedContainment& first = ranking.matches.at(0);
  ASSERT_TRUE(first.match.verified);
  EXPECT_TRUE(first.tied);
  ASSERT_EQ(first.match.other_places.size(), 2U);
  std::vector<double> shifts = {first.match.transform(0, 3)};
  for (const Eigen::Matrix4d& place : first.match.other_places) {
    shifts.push_back(place(0, 3));
    // A mug that is turned about its axis nearly fits.
    EXPECT_NEAR((place.topLeftCorner<3, 3>().determinant()), 1, 0.05);
  }
  std::sort(shifts.begin(), shifts.end());
  EXPECT_NEAR(shifts[1] - shifts[0], 1.5 * length, 0.1 * length);
  EXPECT_NEAR(shifts[2] - shifts[1], 1.5 * length, 0.1 * length);
}

TEST(RankContainment, FindsOnePlaceOfAPartThatIsThereOnce) {
  const MovedPiece piece = CutAndMove(MeshOf("teapot"), 0, 8);
  ASSERT_OK_AND_ASSIGN(const ContainmentRanking ranking,
                       Rank(Query(piece.mesh)));
  ASSERT_TRUE(ranking.matches[0].match.verified);
  EXPECT_TRUE(ranking.matches[0].match.other_places.empty());
}

TEST(RankContainment, LoadsAgainWhatItDidNotKeep) {
  // Two of each shape, and the windows of one shape kept.
  WindowIndex index;
  const auto num = static_cast<int64_t>(Gallery().windows.size());
  const int64_t many = 2 * num;
  for (int64_t slot = 0; slot < many; ++slot) {
    index.Set(slot, AssignWindowWords(
                        *Gallery().windows[static_cast<size_t>(slot % num)]));
  }
  int64_t loads = 0;
  const auto load = [&](int64_t slot) {
    ++loads;
    return Gallery().windows[static_cast<size_t>(slot % num)];
  };
  const auto rank = [&](int keep_limit) {
    loads = 0;
    return RankContainment(Query(CutAndMove(MeshOf("chair"), 2, 11).mesh),
                           index, load, {.keep_limit = keep_limit});
  };
  ASSERT_OK_AND_ASSIGN(const ContainmentRanking kept, rank(256));
  const int64_t loads_when_kept = loads;
  ASSERT_OK_AND_ASSIGN(const ContainmentRanking again, rank(1));
  EXPECT_EQ(again.laid, many);
  EXPECT_GE(loads - loads_when_kept, many - 1) << "all but the one kept";
  ASSERT_EQ(again.matches.size(), kept.matches.size());
  for (size_t i = 0; i < kept.matches.size(); ++i) {
    EXPECT_EQ(again.matches[i].slot, kept.matches[i].slot);
    EXPECT_EQ(again.matches[i].match.score, kept.matches[i].match.score);
  }
  for (size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(again.matches[i].slot % num, Gallery().SlotOf("chair"));
    EXPECT_TRUE(again.matches[i].match.verified);
  }
}

TEST(RankContainment, FindsANoisyPiece) {
  const MovedPiece piece = CutAndMove(MeshOf("airplane"), 0, 4);
  ASSERT_OK_AND_ASSIGN(const ContainmentRanking ranking,
                       Rank(Query(AddNoise(piece.mesh, 0.002, 9))));
  EXPECT_EQ(ranking.matches[0].slot, Gallery().SlotOf("airplane"));
  EXPECT_LT(
      Apart(ranking.matches[0].match.transform, piece.transform, piece.mesh),
      0.03);
}

TEST(RankContainment, FindsAPieceTurnedInsideOut) {
  const MovedPiece piece = CutAndMove(MeshOf("human"), 2, 5);
  const QueryWindows query = Query(TurnedInsideOut(piece.mesh));
  ASSERT_OK_AND_ASSIGN(const ContainmentRanking ranking, Rank(query));
  EXPECT_EQ(ranking.matches[0].slot, Gallery().SlotOf("human"));
  EXPECT_TRUE(ranking.matches[0].match.verified);
  EXPECT_TRUE(ranking.matches[0].match.flipped);
  ASSERT_OK_AND_ASSIGN(const ContainmentRanking given,
                       Rank(query, {.try_flipped = false}));
  EXPECT_FALSE(given.matches[0].match.verified);
}

TEST(RankContainment, FindsAPieceOfAnOpenShapeStoredInsideOut) {
  // The upper half of a teapot stands for a scan: open, wound the wrong way.
  const TriangleMesh scan = CutHalf(MeshOf("teapot"), 2);
  ASSERT_OK_AND_ASSIGN(TargetWindows windows,
                       ExtractTargetWindows(TurnedInsideOut(scan)));
  WindowIndex index = Gallery().index;
  const int64_t teapot = Gallery().SlotOf("teapot");
  index.Set(teapot, AssignWindowWords(windows));
  const auto stored = std::make_shared<const TargetWindows>(std::move(windows));
  const LoadWindows load = [&](int64_t slot)
      -> absl::StatusOr<std::shared_ptr<const TargetWindows>> {
    if (slot == teapot) return stored;
    return Gallery().Loader()(slot);
  };
  const MovedPiece piece = CutAndMove(scan, 0, 6);
  ASSERT_OK_AND_ASSIGN(const ContainmentRanking ranking,
                       RankContainment(Query(piece.mesh), index, load));
  EXPECT_EQ(ranking.matches[0].slot, teapot);
  EXPECT_TRUE(ranking.matches[0].match.verified);
  EXPECT_FALSE(ranking.matches[0].match.flipped);
  EXPECT_LT(
      Apart(ranking.matches[0].match.transform, piece.transform, piece.mesh),
      0.02);
}

TEST(RankContainment, SaysOfAFeaturelessPatchThatItIsGeneric) {
  const TriangleMesh patch = MakeSheet(24);
  ASSERT_OK_AND_ASSIGN(const ContainmentRanking ranking, Rank(Query(patch)));
  EXPECT_TRUE(ranking.generic);
  EXPECT_LT(ranking.distinctiveness, 0.4);
}

TEST(RankContainment, TiesShapesThatAreTheSame) {
  WindowIndex index = Gallery().index;
  const int64_t twin = 900;
  index.Set(
      twin,
      AssignWindowWords(
          *Gallery().windows[static_cast<size_t>(Gallery().SlotOf("teapot"))]));
  const LoadWindows load = [](int64_t slot) {
    return Gallery().Loader()(slot == 900 ? Gallery().SlotOf("teapot") : slot);
  };
  const QueryWindows query = Query(CutAndMove(MeshOf("teapot"), 0, 2).mesh);
  ASSERT_OK_AND_ASSIGN(const ContainmentRanking ranking,
                       RankContainment(query, index, load));
  ASSERT_GE(ranking.matches.size(), 3u);
  EXPECT_EQ(ranking.matches[0].slot, Gallery().SlotOf("teapot"));
  EXPECT_EQ(ranking.matches[1].slot, twin);
  EXPECT_TRUE(ranking.matches[0].tied);
  EXPECT_TRUE(ranking.matches[1].tied);
  EXPECT_FALSE(ranking.matches[2].tied);
}

TEST(RankContainment, GivesTheSameBitsOnAnyThreads) {
  const QueryWindows query = Query(CutAndMove(MeshOf("fish"), 1, 3).mesh);
  const ParallelRunner backwards_on_three =
      [](int64_t count, const std::function<void(int64_t)>& body) {
        std::vector<std::jthread> threads;
        for (int64_t t = 0; t < 3; ++t) {
          threads.emplace_back([=] {
            for (int64_t i = count - 1 - t; i >= 0; i -= 3) body(i);
          });
        }
      };
  ASSERT_OK_AND_ASSIGN(const ContainmentRanking a, Rank(query));
  ASSERT_OK_AND_ASSIGN(const ContainmentRanking b,
                       Rank(query, {}, backwards_on_three));
  ASSERT_EQ(a.matches.size(), b.matches.size());
  for (size_t i = 0; i < a.matches.size(); ++i) {
    EXPECT_EQ(a.matches[i].slot, b.matches[i].slot);
    EXPECT_EQ(a.matches[i].match.score, b.matches[i].match.score);
    EXPECT_EQ(a.matches[i].match.transform, b.matches[i].match.transform);
  }
}

TEST(RankContainment, LeavesOutShapesThatWent) {
  const QueryWindows query = Query(CutAndMove(MeshOf("mug"), 2, 3).mesh);
  const LoadWindows load =
      [](int64_t slot) -> absl::StatusOr<std::shared_ptr<const TargetWindows>> {
    if (slot == Gallery().SlotOf("mug")) return nullptr;
    return Gallery().Loader()(slot);
  };
  ASSERT_OK_AND_ASSIGN(const ContainmentRanking ranking,
                       RankContainment(query, Gallery().index, load));
  EXPECT_EQ(ranking.loaded, ranking.considered - 1);
  for (const RankedContainment& ranked : ranking.matches) {
    EXPECT_NE(ranked.slot, Gallery().SlotOf("mug"));
  }
}

TEST(RankContainment, RanksOnlyTheSlotsThatMayBeFound) {
  const QueryWindows query = Query(CutAndMove(MeshOf("mug"), 2, 3).mesh);
  ASSERT_OK_AND_ASSIGN(const ContainmentRanking all, Rank(query));
  ASSERT_EQ(all.matches.at(0).slot, Gallery().SlotOf("mug"));
  std::vector<bool> slots(static_cast<size_t>(Gallery().index.size()), true);
  slots[static_cast<size_t>(Gallery().SlotOf("mug"))] = false;
  RankContainmentOptions options;
  options.slots = &slots;
  ASSERT_OK_AND_ASSIGN(const ContainmentRanking some, Rank(query, options));
  EXPECT_EQ(some.loaded, all.loaded - 1);
  for (const RankedContainment& ranked : some.matches) {
    EXPECT_NE(ranked.slot, Gallery().SlotOf("mug"));
  }
  slots.clear();
  ASSERT_OK_AND_ASSIGN(const ContainmentRanking none, Rank(query, options));
  EXPECT_TRUE(none.matches.empty());
}

TEST(RankContainment, ReportsWhatCannotBeLoaded) {
  const LoadWindows load =
      [](int64_t) -> absl::StatusOr<std::shared_ptr<const TargetWindows>> {
    return absl::DataLossError("slot is damaged");
  };
  EXPECT_THAT(
      RankContainment(Query(MeshOf("mug")), Gallery().index, load),
      StatusIs(absl::StatusCode::kDataLoss, HasSubstr("slot is damaged")));
}

TEST(RankContainment, RefusesLimitsBelowOne) {
  EXPECT_THAT(
      Rank(QueryWindows(), {.limit = 0}),
      StatusIs(absl::StatusCode::kInvalidArgument, HasSubstr("limit is 0")));
}

TEST(RankContainment, StopsWhenToldTo) {
  EXPECT_THAT(
      Rank(Query(MeshOf("mug")), {}, {}, StopToken({}, absl::InfinitePast())),
      StatusIs(absl::StatusCode::kDeadlineExceeded, _));
}

}  // namespace
}  // namespace argmesh
