#include "client/cli/completion_script.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>

#include "tests/unit/client/cli/scratch_folder.h"

namespace argmesh {
namespace {

using testing::HasSubstr;

std::vector<CompletionCommand> Example() {
  return {{"",
           {{"list", "It's a list."}, {"picture", "Draw."}},
           {{"--json", "As JSON"}}},
          {"list", {}, {{"--limit", "At most"}}},
          {"picture", {{"match", "Two."}}, {}},
          {"picture match", {}, {{"--out", "File"}}}};
}

// What bash offers after `line`, whose last word is being typed.
std::string Complete(const std::vector<std::string>& words) {
  const ScratchFolder folder;
  std::string script = BashCompletion("tool", Example()) + "COMP_WORDS=(tool";
  for (const std::string& word : words) script += " '" + word + "'";
  script += ")\nCOMP_CWORD=" + std::to_string(words.size()) +
            "\n_tool\necho \"${COMPREPLY[*]}\"\n";
  const std::string file = folder.Add("complete.sh", script);
  FILE* pipe = popen(("bash '" + file + "' 2>&1").c_str(), "r");
  std::string output;
  std::array<char, 256> buffer{};
  while (fgets(buffer.data(), static_cast<int>(buffer.size()), pipe)) {
    output += buffer.data();
  }
  pclose(pipe);
  return output;
}

TEST(BashCompletion, OffersCommandsThenTheirOptions) {
  EXPECT_EQ(Complete({""}), "list picture --json\n");
  EXPECT_EQ(Complete({"li"}), "list\n");
  EXPECT_EQ(Complete({"list", "--"}), "--limit\n");
  EXPECT_EQ(Complete({"picture", ""}), "match\n");
  EXPECT_EQ(Complete({"--json", "picture", "match", "a", "--o"}), "--out\n");
}

TEST(FishCompletion, QuotesDescriptions) {
  EXPECT_THAT(FishCompletion("tool", Example()),
              HasSubstr("-a list -d 'It'\\''s a list.'"));
}

TEST(ZshCompletion, LoadsTheRulesOfBashFirst) {
  EXPECT_THAT(ZshCompletion("tool", Example()), HasSubstr("bashcompinit\n#"));
}

}  // namespace
}  // namespace argmesh
