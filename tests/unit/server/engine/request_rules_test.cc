#include "server/engine/request_rules.h"

#include <limits>
#include <string>
#include <vector>

#include "server/engine/error_reason.h"
#include "server/engine/page_token.h"
#include "server/engine/request_stamp.h"
#include "server/engine/uid.h"
#include "server/engine/utf8.h"
#include "tests/support/status_matchers.h"

namespace argmesh {
namespace {

NewShape GoodShape() {
  NewShape shape;
  shape.collection = "cups";
  shape.id = "red-1";
  return shape;
}

TEST(CheckNewShape, TakesAnythingWithinTheLimits) {
  NewShape shape = GoodShape();
  shape.display_name = std::string(256, 'x');
  shape.source_uri = std::string(2048, 'x');
  shape.metadata[std::string(64, 'k')] = std::string(1024, 'v');
  for (int i = 0; i < 14; ++i) {
    shape.metadata[std::to_string(i)] = std::string(1024, 'v');
  }
  EXPECT_THAT(CheckNewShape(shape), IsOk());
}

TEST(CheckNewShape, RefusesIdsOutsideTheRule) {
  for (const std::string& id :
       {std::string(), std::string("Red"), std::string("1red"),
        std::string("red-"), std::string("red/blue"), std::string("../red"),
        std::string(64, 'a'), std::string("r\0d", 3), std::string("größe")}) {
    NewShape shape = GoodShape();
    shape.id = id;
    EXPECT_EQ(ReasonOf(CheckNewShape(shape)), ErrorReason::kNameInvalid) << id;
    EXPECT_EQ(MetadataOf(CheckNewShape(shape))["field"], "shape") << id;
  }
}

TEST(CheckNewShape, NamesTheFieldThatIsTooLong) {
  NewShape shape = GoodShape();
  shape.display_name = std::string(257, 'x');
  EXPECT_EQ(MetadataOf(CheckNewShape(shape))["field"], "display_name");
  shape = GoodShape();
  shape.source_uri = "\xFF";
  EXPECT_EQ(MetadataOf(CheckNewShape(shape))["field"], "source_uri");
  shape = GoodShape();
  for (int i = 0; i < 65; ++i) shape.metadata[std::to_string(i)] = "";
  EXPECT_EQ(MetadataOf(CheckNewShape(shape))["field"], "metadata");
  shape = GoodShape();
  for (int i = 0; i < 16; ++i) {
    shape.metadata[std::to_string(i)] = std::string(1024, 'v');
  }
  EXPECT_EQ(MetadataOf(CheckNewShape(shape))["field"], "metadata");
  shape = GoodShape();
  shape.metadata[""] = "x";
  EXPECT_EQ(ReasonOf(CheckNewShape(shape)), ErrorReason::kFieldInvalid);
}

TEST(CheckSettings, KeepsToTheRangesOfTheHeader) {
  CollectionSettings settings;
  EXPECT_THAT(CheckSettings(settings), IsOk());
  settings.vertex_budget = 99;
  EXPECT_EQ(ReasonOf(CheckSettings(settings)), ErrorReason::kFieldInvalid);
  settings.vertex_budget = 100;
  settings.uniform_cells = 1001;
  EXPECT_EQ(ReasonOf(CheckSettings(settings)), ErrorReason::kFieldInvalid);
  settings.uniform_cells = 0;
  EXPECT_THAT(CheckSettings(settings), IsOk());
  settings.decomposition = DecompositionKind::kGiven;
  EXPECT_EQ(ReasonOf(CheckSettings(settings)), ErrorReason::kFieldInvalid);
}

TEST(CheckSearchQuery, RefusesLimitsAndThresholdsOutOfRange) {
  SearchQuery query;
  query.collection = "cups";
  EXPECT_THAT(CheckSearchQuery(query), IsOk());
  for (const int limit : {0, -1, 1001}) {
    query.limit = limit;
    EXPECT_EQ(MetadataOf(CheckSearchQuery(query))["field"], "limit");
  }
  query.limit = 1;
  for (const double score :
       {-0.1, 1.1, std::numeric_limits<double>::quiet_NaN()}) {
    query.min_score = score;
    EXPECT_EQ(MetadataOf(CheckSearchQuery(query))["field"], "min_score");
  }
}

TEST(PageToken, ComesBackOnlyForItsOwnList) {
  const std::string token = MakePageToken("shapes/cups", "red-1");
  ASSERT_OK_AND_ASSIGN(const std::string after,
                       ParsePageToken("shapes/cups", token));
  EXPECT_EQ(after, "red-1");
  ASSERT_OK_AND_ASSIGN(const std::string first,
                       ParsePageToken("shapes/cups", ""));
  EXPECT_EQ(first, "");
  for (const std::string& bad :
       {token + "AAAA", token.substr(1), std::string("!"), std::string("AAAA"),
        MakePageToken("shapes/jugs", "red-1"),
        MakePageToken("shapes/cups", "No Id")}) {
    EXPECT_EQ(ReasonOf(ParsePageToken("shapes/cups", bad).status()),
              ErrorReason::kPageTokenInvalid)
        << bad;
  }
}

TEST(PageSize, HasADefaultAndABound) {
  EXPECT_EQ(CheckPageSize(0).value(), 100);
  EXPECT_EQ(CheckPageSize(7).value(), 7);
  EXPECT_EQ(CheckPageSize(5000).value(), 1000);
  EXPECT_EQ(ReasonOf(CheckPageSize(-1).status()), ErrorReason::kFieldInvalid);
}

TEST(StampRequest, TellsRequestsApartByEveryField) {
  const RequestKey key{"me", "AAAAAAAA-0000-4000-8000-000000000001"};
  const auto hash = [&](const std::vector<std::string>& fields) {
    return StampRequest(key, "AddShape", fields, absl::UnixEpoch())
        .value()
        .hash;
  };
  EXPECT_EQ(hash({"a", "b"}), hash({"a", "b"}));
  EXPECT_NE(hash({"a", "b"}), hash({"ab", ""}));
  EXPECT_NE(hash({"a", "b"}), hash({"a", "b", ""}));
  EXPECT_NE(hash({"a\n1:b"}), hash({"a", "b"}));
  EXPECT_EQ(StampRequest(key, "m", {}, absl::UnixEpoch()).value().request_id,
            "aaaaaaaa-0000-4000-8000-000000000001");
  EXPECT_EQ(
      StampRequest({"me", ""}, "m", {}, absl::UnixEpoch()).value().request_id,
      "");
  EXPECT_EQ(
      ReasonOf(StampRequest({"me", "1"}, "m", {}, absl::UnixEpoch()).status()),
      ErrorReason::kFieldInvalid);
}

TEST(MakeUid, MakesVersionFourUuidsThatDiffer) {
  const std::string uid = MakeUid();
  EXPECT_TRUE(IsUid(uid)) << uid;
  EXPECT_EQ(uid[14], '4');
  EXPECT_NE(std::string("89ab").find(uid[19]), std::string::npos);
  EXPECT_NE(uid, MakeUid());
  EXPECT_FALSE(IsUid(uid + "0"));
  EXPECT_FALSE(IsUid("00000000-0000-4000-8000-00000000000g"));
  EXPECT_FALSE(IsUid("000000000-000-4000-8000-000000000000"));
}

TEST(IsUtf8, KnowsWellFormedSequences) {
  for (const char* good : {"", "abc", "größe", "\xE2\x82\xAC",
                           "\xF0\x9F\x98\x80", "\xF4\x8F\xBF\xBF"}) {
    EXPECT_TRUE(IsUtf8(good)) << good;
  }
  for (const char* bad :
       {"\x80", "\xC3", "\xC0\x80", "\xC1\xBF", "\xE0\x80\x80", "\xED\xA0\x80",
        "\xF0\x80\x80\x80", "\xF4\x90\x80\x80", "\xF8\x88\x80\x80\x80",
        "\xE2\x82", "a\xFFz", "\xC3("}) {
    EXPECT_FALSE(IsUtf8(bad)) << bad;
  }
}

}  // namespace
}  // namespace argmesh
