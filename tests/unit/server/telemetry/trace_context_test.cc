#include "server/telemetry/trace_context.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace argmesh {
namespace {

constexpr char kTrace[] = "0af7651916cd43dd8448eb211c80319c";
constexpr char kParent[] = "b7ad6b7169203331";

std::string Header(const std::string& version, const std::string& flags) {
  return version + "-" + kTrace + "-" + kParent + "-" + flags;
}

TEST(ParseTraceparent, ReadsTheIdsAndTheSampledFlag) {
  const TraceContext sampled = ParseTraceparent(Header("00", "01"));
  EXPECT_EQ(sampled.trace_id, kTrace);
  EXPECT_EQ(sampled.parent_id, kParent);
  EXPECT_TRUE(sampled.sampled);
  EXPECT_FALSE(ParseTraceparent(Header("00", "00")).sampled);
  EXPECT_FALSE(ParseTraceparent(Header("00", "02")).sampled);
  EXPECT_TRUE(ParseTraceparent(Header("00", "0b")).sampled);
}

TEST(ParseTraceparent, ReadsTheKnownPartOfANewerVersion) {
  EXPECT_EQ(ParseTraceparent(Header("01", "01")).trace_id, kTrace);
  EXPECT_EQ(ParseTraceparent(Header("cc", "01") + "-more").trace_id, kTrace);
}

TEST(ParseTraceparent, IgnoresWhatIsNotWellFormed) {
  const std::string zeros(32, '0');
  for (const std::string& header :
       {std::string(), std::string("00"), Header("ff", "01"),
        Header("0G", "01"), Header("00", "0x"), Header("00", "01") + "-more",
        Header("01", "01") + "more", Header("00", "01").substr(0, 54),
        "00-" + zeros + "-" + kParent + "-01",
        "00-" + std::string(kTrace) + "-0000000000000000-01",
        "00-0AF7651916CD43DD8448EB211C80319C-" + std::string(kParent) + "-01",
        "00_" + std::string(kTrace) + "-" + kParent + "-01"}) {
    EXPECT_TRUE(ParseTraceparent(header).empty()) << header;
  }
}

TEST(MakeTraceId, GivesIdsThatParse) {
  std::set<std::string> seen;
  for (int i = 0; i < 100; ++i) {
    const std::string trace = MakeTraceId();
    const std::string span = MakeSpanId();
    const TraceContext read =
        ParseTraceparent("00-" + trace + "-" + span + "-01");
    EXPECT_EQ(read.trace_id, trace);
    EXPECT_EQ(read.parent_id, span);
    EXPECT_TRUE(seen.insert(trace).second);
    EXPECT_TRUE(seen.insert(span).second);
  }
}

}  // namespace
}  // namespace argmesh
