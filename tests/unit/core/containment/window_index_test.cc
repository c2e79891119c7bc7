#include "core/containment/window_index.h"

#include <gtest/gtest.h>

#include <vector>

#include "core/containment/query_windows.h"
#include "core/containment/window_words.h"
#include "tests/support/status_matchers.h"
#include "tests/unit/core/containment/small_gallery.h"

namespace argmesh {
namespace {

QueryWindows HalfChair() {
  const MovedPiece piece = CutAndMove(
      Gallery().meshes[static_cast<size_t>(Gallery().SlotOf("chair"))], 2, 1);
  return *ExtractQueryWindows(piece.mesh);
}

WindowWords WordsOf(size_t slot) {
  return AssignWindowWords(*Gallery().windows[slot]);
}

void ExpectEqual(const VoteResult& a, const VoteResult& b) {
  EXPECT_EQ(a.weights, b.weights);
  EXPECT_EQ(a.distinctiveness, b.distinctiveness);
  ASSERT_EQ(a.shapes.size(), b.shapes.size());
  for (size_t i = 0; i < a.shapes.size(); ++i) {
    EXPECT_EQ(a.shapes[i].slot, b.shapes[i].slot);
    EXPECT_EQ(a.shapes[i].by_shift, b.shapes[i].by_shift);
  }
}

TEST(WindowIndex, PutsTheShapeThatAQueryWasCutFromFirst) {
  ASSERT_OK_AND_ASSIGN(const VoteResult votes,
                       Gallery().index.Vote(HalfChair()));
  ASSERT_EQ(votes.shapes.size(), Gallery().meshes.size());
  EXPECT_EQ(votes.shapes[0].slot, Gallery().SlotOf("chair"));
  EXPECT_GT(votes.shapes[0].score, 1.2 * votes.shapes[1].score);
  EXPECT_GT(votes.distinctiveness, 0.4);
  EXPECT_LE(votes.distinctiveness, 1);
}

TEST(WindowIndex, DoesNotDependOnTheOrderOfChanges) {
  WindowIndex index;
  for (size_t slot = Gallery().meshes.size(); slot-- > 0;) {
    index.Set(static_cast<int64_t>(slot), WordsOf(0));
    index.Set(static_cast<int64_t>(slot), WordsOf(slot));
  }
  index.Set(700, WordsOf(1));
  index.Erase(700);
  index.Erase(701);
  index.Erase(100000);
  EXPECT_EQ(index.size(), Gallery().index.size());
  const QueryWindows query = HalfChair();
  ASSERT_OK_AND_ASSIGN(const VoteResult a, Gallery().index.Vote(query));
  ASSERT_OK_AND_ASSIGN(const VoteResult b, index.Vote(query));
  ExpectEqual(a, b);
}

TEST(WindowIndex, CopiesStayAsTheyWere) {
  WindowIndex index = Gallery().index;
  const WindowIndex before = index;
  const QueryWindows query = HalfChair();
  ASSERT_OK_AND_ASSIGN(const VoteResult then, before.Vote(query));
  index.Erase(Gallery().SlotOf("chair"));
  index.Set(300, WordsOf(0));
  ASSERT_OK_AND_ASSIGN(const VoteResult still, before.Vote(query));
  ExpectEqual(then, still);
  EXPECT_EQ(index.size(), before.size());
  ASSERT_OK_AND_ASSIGN(const VoteResult now, index.Vote(query));
  for (const ShapeVotes& votes : now.shapes) {
    EXPECT_NE(votes.slot, Gallery().SlotOf("chair"));
  }
  EXPECT_EQ(now.shapes.size(), Gallery().meshes.size());
}

TEST(WindowIndex, KeepsToTheLimitAndRanksByScore) {
  ASSERT_OK_AND_ASSIGN(const VoteResult all, Gallery().index.Vote(HalfChair()));
  ASSERT_OK_AND_ASSIGN(const VoteResult three,
                       Gallery().index.Vote(HalfChair(), {.limit = 3}));
  ASSERT_EQ(three.shapes.size(), 3u);
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(three.shapes[i].slot, all.shapes[i].slot);
  }
  for (size_t i = 1; i < all.shapes.size(); ++i) {
    EXPECT_GE(all.shapes[i - 1].score, all.shapes[i].score);
  }
}

TEST(WindowIndex, OfNothingAndForNothingAnswersNothing) {
  ASSERT_OK_AND_ASSIGN(const VoteResult empty, WindowIndex().Vote(HalfChair()));
  EXPECT_TRUE(empty.shapes.empty());
  ASSERT_OK_AND_ASSIGN(const VoteResult unasked,
                       Gallery().index.Vote(QueryWindows()));
  EXPECT_EQ(unasked.distinctiveness, 0);
  for (const ShapeVotes& votes : unasked.shapes) EXPECT_EQ(votes.score, 0);
}

TEST(WindowIndex, StopsWhenToldTo) {
  std::stop_source source;
  source.request_stop();
  EXPECT_THAT(Gallery().index.Vote(
                  HalfChair(), {},
                  StopToken(source.get_token(), absl::InfiniteFuture())),
              StatusIs(absl::StatusCode::kCancelled, ::testing::_));
}

}  // namespace
}  // namespace argmesh
