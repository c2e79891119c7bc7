#include "core/mesh/text_scanner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/status_matchers.h"

namespace argmesh {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<std::string> WordsByLine(std::string_view text,
                                     const TextScannerOptions& options) {
  TextScanner scanner(text, options);
  std::vector<std::string> words;
  for (std::string_view word = scanner.Next(); !word.empty();
       word = scanner.Next()) {
    words.push_back(std::to_string(scanner.line()) + ":" + std::string(word));
  }
  return words;
}

TEST(TextScanner, CountsLinesWithEveryLineEnd) {
  for (const std::string_view text :
       {"a b\n\nc\nd", "a b\r\n\r\nc\r\nd\r\n", "a b\r\rc\rd\r"}) {
    EXPECT_THAT(WordsByLine(text, {}), ElementsAre("1:a", "1:b", "3:c", "4:d"));
  }
}

TEST(TextScanner, SkipsCommentsWhereTheyAreAllowed) {
  EXPECT_THAT(WordsByLine("#x\na#y z\nb # c", {}), ElementsAre("2:a", "3:b"));
  EXPECT_THAT(WordsByLine("a #b", {.hash_comments = false}),
              ElementsAre("1:a", "1:#b"));
}

TEST(TextScanner, JoinsContinuedLinesWhereTheyAreAllowed) {
  const TextScannerOptions joining = {.continuations = true};
  TextScanner scanner("f 1 \\\n 2\\\r\n3\nv", joining);
  for (const std::string_view word : {"f", "1", "2", "3", ""}) {
    EXPECT_EQ(scanner.NextOnLine(), word);
  }
  EXPECT_TRUE(scanner.NextLine());
  EXPECT_EQ(scanner.line(), 4);
  EXPECT_THAT(WordsByLine("a \\\nb", {}), ElementsAre("1:a", "1:\\", "2:b"));
}

TEST(TextScanner, JoinsNothingToACommentThatEndsWithABackslash) {
  TextScanner scanner("# C:\\models\\\nv", {.continuations = true});
  EXPECT_TRUE(scanner.NextLine());
  EXPECT_EQ(scanner.NextOnLine(), "v");
}

TEST(TextScanner, EndsWithAStatusAtALineThatIsTooLong) {
  const std::string text = "ok\n" + std::string(50, 'x') + "\nmore";
  TextScanner scanner(text, {.format_name = "OBJ", .max_line_bytes = 49});
  EXPECT_EQ(scanner.Next(), "ok");
  EXPECT_EQ(scanner.Next(), "");
  EXPECT_THAT(scanner.status(),
              StatusIs(absl::StatusCode::kResourceExhausted,
                       HasSubstr("OBJ line 2: the line has more than 49")));
  EXPECT_EQ(scanner.Next(), "");
  EXPECT_THAT(scanner.Malformed("something else"),
              StatusIs(absl::StatusCode::kResourceExhausted, HasSubstr("49")));
}

TEST(TextScanner, CountsJoinedLinesAndCommentsAgainstTheLineLimit) {
  const std::string joined(100, 'x');
  std::string text;
  for (int i = 0; i < 100; ++i) text += "x \\\n";
  TextScanner words(text, {.continuations = true, .max_line_bytes = 100});
  while (!words.NextOnLine().empty()) {
  }
  EXPECT_THAT(words.status(),
              StatusIs(absl::StatusCode::kResourceExhausted, HasSubstr("100")));
  const std::string long_comment = "#" + joined;
  TextScanner comment(long_comment, {.max_line_bytes = 100});
  EXPECT_TRUE(comment.AtEnd());
  EXPECT_FALSE(comment.status().ok());
}

TEST(ParseCoordinate, TakesEveryUsualForm) {
  EXPECT_EQ(ParseCoordinate("1"), 1.0);
  EXPECT_EQ(ParseCoordinate("+1.5"), 1.5);
  EXPECT_EQ(ParseCoordinate("-.5"), -0.5);
  EXPECT_EQ(ParseCoordinate("5."), 5.0);
  EXPECT_EQ(ParseCoordinate("-1.25E+2"), -125.0);
  EXPECT_EQ(ParseCoordinate("1e-400"), 0.0);
  EXPECT_EQ(ParseCoordinate("1e-310"), 1e-310);
  EXPECT_EQ(ParseCoordinate("0." + std::string(900, '3')), 1.0 / 3);
}

TEST(ParseCoordinate, RefusesWhatIsNoFiniteNumber) {
  for (const std::string word :
       {"", "+", "-", ".", "e5", "+-1", "++1", "1,5", "1.0f", "0x10", "nan",
        "inf", "-Infinity", "1e39", "-1e400", "1 "}) {
    EXPECT_EQ(ParseCoordinate(word), std::nullopt) << word;
  }
  EXPECT_EQ(ParseCoordinate(std::string(400, '9')), std::nullopt);
}

TEST(ParseInteger, RefusesFractionsAndOverflow) {
  EXPECT_EQ(ParseInteger("+12"), 12);
  EXPECT_EQ(ParseInteger("-3"), -3);
  for (const std::string word :
       {"", "1.0", "1e3", "+-1", "99999999999999999999", "0x1", "1/2"}) {
    EXPECT_EQ(ParseInteger(word), std::nullopt) << word;
  }
}

TEST(QuoteWord, CutsAndEscapes) {
  EXPECT_EQ(QuoteWord("a\x01"), "\"a\\x01\"");
  EXPECT_EQ(QuoteWord(std::string(41, 'a')),
            '"' + std::string(40, 'a') + "...\"");
}

}  // namespace
}  // namespace argmesh
