#include "server/rpc/admission.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "server/engine/error_reason.h"

namespace argmesh {
namespace {

TEST(Admission, AdmitsItsLimitAndRefusesTheNext) {
  Admission admission("searches", 2);
  auto first = admission.Admit("peer");
  auto second = admission.Admit("peer");
  ASSERT_TRUE(first.ok());
  ASSERT_TRUE(second.ok());
  const auto third = admission.Admit("peer");
  ASSERT_FALSE(third.ok());
  EXPECT_EQ(ReasonOf(third.status()), ErrorReason::kOverloaded);
  EXPECT_TRUE(RetryDelayOf(third.status()).has_value());
  EXPECT_EQ(MetadataOf(third.status()).at("limit"), "2");
}

TEST(Admission, GivesAPlaceBackOnceHoweverTheTicketMoves) {
  Admission admission("searches", 1);
  for (int i = 0; i < 3; ++i) {
    auto ticket = admission.Admit("peer");
    ASSERT_TRUE(ticket.ok()) << i;
    Admission::Ticket moved = *std::move(ticket);
    Admission::Ticket assigned;
    assigned = std::move(moved);
    EXPECT_FALSE(admission.Admit("peer").ok()) << i;
    assigned.Release();
    assigned.Release();
  }
  EXPECT_TRUE(admission.Admit("peer").ok());
}

TEST(Admission, KeepsTheLastQuarterForConnectionsThatHaveNone) {
  Admission admission("searches", 8);
  std::vector<Admission::Ticket> tickets;
  const auto admits = [&](const char* peer) {
    auto ticket = admission.Admit(peer);
    if (ticket.ok()) tickets.push_back(*std::move(ticket));
    return ticket.ok();
  };
  for (int i = 0; i < 6; ++i) EXPECT_TRUE(admits("greedy")) << i;
  EXPECT_FALSE(admits("greedy"));
  EXPECT_TRUE(admits("second"));
  EXPECT_FALSE(admits("second"));
  EXPECT_TRUE(admits("third"));
  EXPECT_FALSE(admits("fourth"));
  EXPECT_EQ(admission.used(), 8);
  tickets.clear();
  EXPECT_EQ(admission.used(), 0);
  EXPECT_TRUE(admits("greedy"));
}

TEST(Admission, HasNoPlacesToKeepOfAFew) {
  Admission admission("uploads", 3);
  const auto first = admission.Admit("peer");
  const auto second = admission.Admit("peer");
  EXPECT_TRUE(admission.Admit("peer").ok());
}

}  // namespace
}  // namespace argmesh
