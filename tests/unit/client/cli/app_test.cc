#include "client/cli/app.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "client/cli/json.h"
#include "tests/unit/client/cli/scratch_folder.h"

namespace argmesh {
namespace {

using testing::HasSubstr;

struct Outcome {
  int exit_code = 0;
  std::string out;
  std::string err;
};

// Nothing listens on port 1.
Outcome Command(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(),
                   {"argmesh", "--server", "127.0.0.1:1", "--timeout", "2"});
  std::ostringstream out;
  std::ostringstream err;
  Outcome outcome;
  outcome.exit_code = RunArgmesh(static_cast<int>(arguments.size()),
                                 arguments.data(), out, err, false);
  outcome.out = out.str();
  outcome.err = err.str();
  return outcome;
}

TEST(RunArgmesh, HelpsWithEveryCommand) {
  const std::vector<std::vector<const char*>> commands = {
      {"--help"},
      {"ingest", "--help"},
      {"search", "--help"},
      {"compare", "--help"},
      {"list", "--help"},
      {"get", "--help"},
      {"declare", "--help"},
      {"delete", "--help"},
      {"graph", "--help"},
      {"evaluate", "--help"},
      {"picture", "--help"},
      {"picture", "levels", "--help"},
      {"picture", "modes", "--help"},
      {"picture", "match", "--help"},
      {"picture", "results", "--help"},
      {"picture", "matrix", "--help"},
      {"picture", "ply", "--help"},
      {"sample", "--help"},
      {"info", "--help"},
      {"operations", "list", "--help"},
      {"operations", "cancel", "--help"},
      {"health", "--help"},
      {"completion", "--help"}};
  for (const auto& command : commands) {
    SCOPED_TRACE(command.front());
    const Outcome outcome = Command(command);
    EXPECT_EQ(outcome.exit_code, 0);
    EXPECT_THAT(outcome.out, HasSubstr("Example"));
    EXPECT_EQ(outcome.err, "");
  }
}

TEST(RunArgmesh, TellsItsVersion) {
  const Outcome outcome = Command({"--version"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("argmesh 0."));
}

TEST(RunArgmesh, AnswersAWrongCommandLineWithTwo) {
  const std::vector<std::vector<const char*>> wrong = {
      {},
      {"nonsense"},
      {"search", "--collection", "c"},
      {"search", "x.off"},
      {"search", "--collection", "c", "--shape", "s", "--mode", "sideways"},
      {"search", "--collection", "c", "--shape", "s", "--limit", "0"},
      {"search", "--collection", "c", "--shape", "Not An Id"},
      {"search", "--collection", "c", "--shape", "s", "x.off"},
      {"compare", "--collection", "c", "a"},
      {"ingest", "--collection", "c"},
      {"ingest", "--collection", "c", "--no-such-flag", "x"},
      {"ingest", "--collection", "Bad Id", "/tmp"},
      {"ingest", "--collection", "c", "--labels", "/no/such/file", "/tmp"},
      {"picture"},
      {"picture", "levels", "--collection", "c", "s"},
      {"completion", "powershell"}};
  for (const auto& command : wrong) {
    std::string line;
    for (const char* word : command) line += std::string(word) + " ";
    SCOPED_TRACE(line);
    const Outcome outcome = Command(command);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err, "");
  }
}

TEST(RunArgmesh, AnswersAnAbsentServerWithThree) {
  const Outcome outcome = Command({"info"});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.err,
              HasSubstr("no argmesh server answers at 127.0.0.1:1"));
  EXPECT_EQ(Command({"health"}).exit_code, 3);
}

TEST(RunArgmesh, TellsProgramsOfAnErrorInJson) {
  const Outcome outcome = Command({"list", "--json"});
  EXPECT_EQ(outcome.exit_code, 3);
  const Json json = Json::parse(outcome.out);
  EXPECT_EQ(json["error"]["code"], "UNAVAILABLE");
}

TEST(RunArgmesh, SamplesTheSameFilesForTheSameSeed) {
  const ScratchFolder folder;
  const std::string one = (folder.path() / "one").string();
  const std::string two = (folder.path() / "two").string();
  for (const std::string& out : {one, two}) {
    const Outcome outcome =
        Command({"sample", "--out", out.c_str(), "--shapes-per-class", "1",
                 "--classes", "mug,table", "--vertices", "1000", "--json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_EQ(Json::parse(outcome.out)["shapes"], 2);
  }
  const auto read = [](const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  EXPECT_EQ(read(one + "/labels.tsv"),
            "mug/mug-01.off\tmug\ntable/table-01.off\ttable\n");
  EXPECT_NE(read(one + "/mug/mug-01.off"), "");
  EXPECT_EQ(read(one + "/mug/mug-01.off"), read(two + "/mug/mug-01.off"));
  EXPECT_EQ(Command({"sample", "--out", one.c_str(), "--classes", "unicorn"})
                .exit_code,
            2);
}

TEST(RunArgmesh, PrintsCompletionOfEveryCommand) {
  const Outcome outcome = Command({"completion", "bash"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("command='picture match'"));
  EXPECT_THAT(outcome.out, HasSubstr("--min-score"));
}

}  // namespace
}  // namespace argmesh
