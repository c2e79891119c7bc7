#include "server/engine/metadata_filter.h"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/base/random.h"
#include "server/engine/error_reason.h"
#include "tests/support/random_filter.h"
#include "tests/support/status_matchers.h"

namespace argmesh {
namespace {

using ::testing::HasSubstr;

const std::vector<MetadataKey>& Keys() {
  static const std::vector<MetadataKey> keys = SampleMetadataKeys();
  return keys;
}

bool Holds(const std::string& filter, const Metadata& metadata) {
  const auto parsed = MetadataFilter::Parse(filter, Keys());
  EXPECT_TRUE(parsed.ok()) << filter << ": " << parsed.status();
  return parsed.ok() && parsed->Matches(metadata);
}

absl::Status Refusal(const std::string& filter) {
  return MetadataFilter::Parse(filter, Keys()).status();
}

TEST(MetadataFilter, HoldsForEverythingWhenItIsEmpty) {
  EXPECT_TRUE(Holds("", {}));
  EXPECT_TRUE(Holds(" \t\n", {{"colour", "red"}}));
}

TEST(MetadataFilter, ComparesEachTypeInItsOwnOrder) {
  EXPECT_TRUE(Holds("mass < 10", {{"mass", "9"}}));
  EXPECT_TRUE(Holds("mass = 1e3", {{"mass", "1000.0"}}));
  EXPECT_TRUE(Holds("mass >= -2.5", {{"mass", "-2.5"}}));
  EXPECT_TRUE(Holds("colour < 9", {{"colour", "10"}}));
  EXPECT_TRUE(Holds("colour != red", {{"colour", "Red"}}));
  EXPECT_TRUE(Holds("colour > \"z\"", {{"colour", "ö"}}));
  EXPECT_TRUE(Holds("round = true", {{"round", "true"}}));
  EXPECT_TRUE(Holds("round:false", {{"round", "false"}}));
}

TEST(MetadataFilter, IsFalseForAnAbsentKeyUnlessNegated) {
  for (const char* filter : {"colour = red", "colour != red", "mass < 1",
                             "mass >= 1", "round:true", "colour:*"}) {
    EXPECT_FALSE(Holds(filter, {})) << filter;
    EXPECT_TRUE(Holds("NOT " + std::string(filter), {})) << filter;
    EXPECT_TRUE(Holds("-" + std::string(filter), {})) << filter;
  }
  EXPECT_TRUE(Holds("colour:*", {{"colour", ""}}));
}

TEST(MetadataFilter, BindsOrTighterThanAnd) {
  const Metadata red = {{"colour", "red"}};
  EXPECT_FALSE(Holds("colour=red OR mass=1 AND mass=2", red));
  EXPECT_TRUE(Holds("colour=red OR (mass=1 AND mass=2)", red));
  EXPECT_FALSE(Holds("NOT colour=red OR mass=1", red));
  EXPECT_FALSE(Holds("NOT (colour=red OR mass=1)", red));
  EXPECT_TRUE(Holds("NOT mass=1 AND colour=red", red));
}

TEST(MetadataFilter, TakesStringsAsTheyAreWritten) {
  EXPECT_TRUE(Holds(R"(colour = "a \"b\" \\")", {{"colour", R"(a "b" \)"}}));
  EXPECT_TRUE(Holds(R"(colour = 'it\'s')", {{"colour", "it's"}}));
  EXPECT_TRUE(Holds(R"("a \"key\"" = x)", {{"a \"key\"", "x"}}));
  EXPECT_TRUE(Holds("colour = größe", {{"colour", "größe"}}));
  EXPECT_TRUE(Holds("colour = \"*\"", {{"colour", "*"}}));
  EXPECT_FALSE(Holds("colour = \"*\"", {{"colour", "red"}}));
}

struct Refused {
  std::string filter;
  int position;
  std::string expected;
};

TEST(MetadataFilter, SaysWhereItCannotBeReadAndWhatWasExpected) {
  const std::vector<Refused> rows = {
      {"colour", 6, "expected = != < <= > >= or :, found the end"},
      {"colour = ", 9, "a value of colour, a STRING, found the end"},
      {"colour ~ x", 7, "found \"~\""},
      {"mass = heavy", 7, "a value of mass, a NUMBER, found \"heavy\""},
      {"mass = 1e999", 7, "a value of mass, a NUMBER"},
      {"mass = \"\"", 7, "a value of mass, a NUMBER"},
      {"mass:x", 5, "a value of mass, a NUMBER, or *"},
      {"mass = *", 7, "a value of mass, a NUMBER, found \"*\""},
      {"round < true", 6, "expected = != or :, found \"<\""},
      {"round = 1", 8, "a value of round, a BOOL"},
      {"colour = AND", 9, "a value of colour"},
      {"AND", 0, "expected a metadata key, found \"AND\""},
      {"colour = red AND", 16, "a metadata key, found the end"},
      {"colour = red mass = 1", 13, "expected AND, OR or the end"},
      {"colour = red and mass = 1", 13, "expected AND, OR or the end"},
      {"(colour = red", 13, "expected AND, OR or ), found the end"},
      {"colour = red)", 12, "expected AND, OR or the end, found \")\""},
      {"()", 1, "a metadata key, found \")\""},
      {"NOT NOT round = true", 4, "a metadata key, found \"NOT\""},
      {"colour = \"red", 9, "has no closing \""},
      {"colour = 'a\\'", 9, "has no closing '"},
      {"colour = re*", 11, "expected AND, OR or the end, found \"*\""},
      {"= red", 0, "a metadata key"},
      {"colour == red", 8, "a value of colour"},
      {"\xff", 0, "is not UTF-8"},
      {std::string("colour = \0", 10), 9, "a value of colour"},
      {std::string(65, 'k') + " = 1", 0, "a key of 65 bytes"},
  };
  for (const Refused& row : rows) {
    const absl::Status status = Refusal(row.filter);
    EXPECT_EQ(ReasonOf(status), ErrorReason::kFilterInvalid) << row.filter;
    EXPECT_EQ(MetadataOf(status)["position"], std::to_string(row.position))
        << row.filter;
    EXPECT_THAT(std::string(status.message()), HasSubstr(row.expected));
  }
}

TEST(MetadataFilter, NamesAKeyThatIsNotDeclared) {
  const absl::Status status = Refusal("round = true AND weight < 3");
  EXPECT_EQ(ReasonOf(status), ErrorReason::kFilterKeyUndeclared);
  EXPECT_EQ(MetadataOf(status)["key"], "weight");
  EXPECT_EQ(MetadataOf(status)["position"], "17");
  EXPECT_THAT(std::string(status.message()), HasSubstr("colour, a \"key\""));
  EXPECT_EQ(ReasonOf(MetadataFilter::Parse("a=1", {}).status()),
            ErrorReason::kFilterKeyUndeclared);
}

std::string Repeat(const std::string& text, int count) {
  std::string repeated;
  for (int i = 0; i < count; ++i) repeated += text;
  return repeated;
}

TEST(MetadataFilter, HasLimitsOfLengthTermsAndDepth) {
  const auto terms = [](int count) {
    return "mass=1" + Repeat(" OR mass=1", count - 1);
  };
  EXPECT_THAT(Refusal(terms(kMaxFilterTerms)), IsOk());
  EXPECT_THAT(std::string(Refusal(terms(kMaxFilterTerms + 1)).message()),
              HasSubstr("more than 64 terms"));
  const auto nested = [](int depth) {
    return Repeat("NOT (", depth) + "mass=1" + Repeat(")", depth);
  };
  EXPECT_THAT(Refusal(nested(kMaxFilterDepth)), IsOk());
  EXPECT_THAT(std::string(Refusal(nested(kMaxFilterDepth + 1)).message()),
              HasSubstr("more than 16 parentheses"));
  EXPECT_THAT(Refusal(Repeat("(mass=1) OR ", 40) + "mass=2"), IsOk());
  const std::string longest(kMaxFilterBytes - 6, ' ');
  EXPECT_THAT(Refusal(longest + "mass=1"), IsOk());
  EXPECT_THAT(std::string(Refusal(longest + " mass=1").message()),
              HasSubstr("4097 bytes, more than 4096"));
  EXPECT_EQ(ReasonOf(Refusal(std::string(1 << 20, '('))),
            ErrorReason::kFilterInvalid);
}

// ARGMESH_FILTER_SEED, 1 when not set.
TEST(MetadataFilter, AgreesWithAnotherEvaluatorOnRandomFilters) {
  const char* given = std::getenv("ARGMESH_FILTER_SEED");
  const uint64_t seed =
      given == nullptr ? 1 : std::strtoull(given, nullptr, 10);
  std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
  Random random(seed);
  int held = 0;
  for (int i = 0; i < 20'000; ++i) {
    const RandomFilter filter = MakeRandomFilter(random, Keys());
    const auto parsed = MetadataFilter::Parse(filter.text, Keys());
    ASSERT_TRUE(parsed.ok()) << filter.text << ": " << parsed.status();
    const Metadata metadata = MakeRandomMetadata(random, Keys());
    ASSERT_EQ(parsed->Matches(metadata), filter.holds(metadata))
        << "seed " << seed << ": " << filter.text;
    held += filter.holds(metadata) ? 1 : 0;
  }
  EXPECT_GT(held, 2000);
  EXPECT_LT(held, 18'000);
}

}  // namespace
}  // namespace argmesh
