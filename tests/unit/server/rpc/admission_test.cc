#include "server/rpc/admission.h"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

#include "server/engine/error_reason.h"

namespace argmesh {
namespace {

TEST(Admission, AdmitsItsLimitAndRefusesTheNext) {
  Admission admission("searches", 2);
  auto first = admission.Admit();
  auto second = admission.Admit();
  ASSERT_TRUE(first.ok());
  ASSERT_TRUE(second.ok());
  const auto third = admission.Admit();
  ASSERT_FALSE(third.ok());
  EXPECT_EQ(ReasonOf(third.status()), ErrorReason::kOverloaded);
  EXPECT_TRUE(RetryDelayOf(third.status()).has_value());
  EXPECT_EQ(MetadataOf(third.status()).at("limit"), "2");
}

TEST(Admission, GivesAPlaceBackOnceHoweverTheTicketMoves) {
  Admission admission("searches", 1);
  for (int i = 0; i < 3; ++i) {
    auto ticket = admission.Admit();
    ASSERT_TRUE(ticket.ok()) << i;
    Admission::Ticket moved = *std::move(ticket);
    Admission::Ticket assigned;
    assigned = std::move(moved);
    EXPECT_FALSE(admission.Admit().ok()) << i;
    assigned.Release();
    assigned.Release();
  }
  EXPECT_TRUE(admission.Admit().ok());
}

}  // namespace
}  // namespace argmesh
