#include "server/engine/metadata_key.h"

#include <string>

#include "server/engine/error_reason.h"
#include "tests/support/status_matchers.h"

namespace argmesh {
namespace {

using ::testing::HasSubstr;

TEST(ReadMetadataValue, TakesAnyTextAsAString) {
  for (const std::string& text :
       {std::string(), std::string("1e999"), std::string("a\0b", 3)}) {
    EXPECT_EQ(ReadMetadataValue(MetadataType::kString, text),
              MetadataValue(text));
  }
}

TEST(ReadMetadataValue, TakesFiniteDecimalNumbers) {
  const auto number = [](const char* text) {
    return ReadMetadataValue(MetadataType::kNumber, text);
  };
  EXPECT_EQ(number("3"), MetadataValue(3.0));
  EXPECT_EQ(number("-0.5"), MetadataValue(-0.5));
  EXPECT_EQ(number("1e6"), MetadataValue(1e6));
  for (const char* text : {"", "heavy", "1e999", "inf", "-inf", "nan", "3 kg",
                           " 3", "0x10", "1,5", "--3"}) {
    EXPECT_EQ(number(text), std::nullopt) << text;
  }
}

TEST(ReadMetadataValue, TakesTrueAndFalseAlone) {
  const auto truth = [](const char* text) {
    return ReadMetadataValue(MetadataType::kBool, text);
  };
  EXPECT_EQ(truth("true"), MetadataValue(true));
  EXPECT_EQ(truth("false"), MetadataValue(false));
  for (const char* text : {"", "True", "1", "yes", "true "}) {
    EXPECT_EQ(truth(text), std::nullopt) << text;
  }
}

TEST(CheckMetadataKeys, TakesAsManyAsTheLimitOfAnyName) {
  std::vector<MetadataKey> keys;
  for (size_t i = 0; i < kMaxMetadataKeys; ++i) {
    keys.push_back({"größe " + std::to_string(i), MetadataType::kNumber});
  }
  EXPECT_THAT(CheckMetadataKeys(keys), IsOk());
  keys.push_back({"one more", MetadataType::kBool});
  EXPECT_EQ(ReasonOf(CheckMetadataKeys(keys)), ErrorReason::kFieldInvalid);
}

TEST(CheckMetadataKeys, RefusesNamesThatAreNone) {
  for (const std::string& key :
       {std::string(), std::string(65, 'k'), std::string("\xff")}) {
    EXPECT_EQ(ReasonOf(CheckMetadataKeys({{key}})), ErrorReason::kFieldInvalid);
  }
  EXPECT_THAT(
      CheckMetadataKeys({{"a"}, {"b"}, {"a", MetadataType::kBool}}),
      StatusIs(absl::StatusCode::kInvalidArgument, HasSubstr("\"a\" twice")));
}

TEST(CheckDeclaredValues, LooksAtDeclaredKeysOnly) {
  const std::vector<MetadataKey> keys = {{"mass", MetadataType::kNumber}};
  EXPECT_THAT(CheckDeclaredValues(keys, {{"mass", "3"}, {"note", "heavy"}}),
              IsOk());
  EXPECT_THAT(CheckDeclaredValues(keys, {}), IsOk());
  EXPECT_THAT(CheckDeclaredValues(keys, {{"mass", "heavy"}}),
              StatusIs(absl::StatusCode::kInvalidArgument,
                       HasSubstr("\"mass\" is \"heavy\"")));
}

}  // namespace
}  // namespace argmesh
