#include "server/options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace argmesh {
namespace {

using ::testing::HasSubstr;

class ServerOptionsTest : public ::testing::Test {
 protected:
  ~ServerOptionsTest() override { std::filesystem::remove(file_); }

  absl::StatusOr<ParsedOptions> Parse(std::vector<std::string> arguments) {
    return ParseServerOptions(
        arguments,
        [this](const std::string& name) -> std::optional<std::string> {
          const auto it = environment_.find(name);
          if (it == environment_.end()) return std::nullopt;
          return it->second;
        },
        "1.2.3");
  }

  std::string WriteFile(const std::string& text) {
    std::ofstream(file_) << text;
    return "--config=" + file_;
  }

  std::map<std::string, std::string> environment_;
  const std::string file_ =
      ::testing::TempDir() + "argmesh-options-" +
      ::testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST_F(ServerOptionsTest, HasDefaultsForEverythingButTheFolder) {
  const auto parsed = Parse({});
  ASSERT_TRUE(parsed.ok()) << parsed.status();
  EXPECT_EQ(parsed->options.data, "");
  EXPECT_EQ(parsed->options.listen, "127.0.0.1:7411");
  EXPECT_EQ(parsed->options.max_mesh_bytes, 512LL << 20);
  EXPECT_EQ(parsed->options.drain_timeout, absl::Seconds(20));
  EXPECT_TRUE(parsed->options.reflection);
  EXPECT_FALSE(parsed->answer.has_value());
}

TEST_F(ServerOptionsTest, LetsFlagsWinOverTheEnvironmentAndThatOverTheFile) {
  const std::string config =
      WriteFile("threads=1\ndrain-delay=1\nlisten=\"127.0.0.1:1\"\n");
  auto parsed = Parse({config});
  ASSERT_TRUE(parsed.ok()) << parsed.status();
  EXPECT_EQ(parsed->options.threads, 1);
  EXPECT_EQ(parsed->options.drain_delay, absl::Seconds(1));
  EXPECT_EQ(parsed->options.listen, "127.0.0.1:1");

  environment_["ARGMESH_THREADS"] = "2";
  environment_["ARGMESH_DRAIN_DELAY"] = "2.5";
  parsed = Parse({config});
  ASSERT_TRUE(parsed.ok()) << parsed.status();
  EXPECT_EQ(parsed->options.threads, 2);
  EXPECT_EQ(parsed->options.drain_delay, absl::Milliseconds(2500));
  EXPECT_EQ(parsed->options.listen, "127.0.0.1:1");

  parsed = Parse({config, "--threads", "3"});
  ASSERT_TRUE(parsed.ok()) << parsed.status();
  EXPECT_EQ(parsed->options.threads, 3);
  EXPECT_EQ(parsed->options.drain_delay, absl::Milliseconds(2500));
}

TEST_F(ServerOptionsTest, TakesFlagsFromTheEnvironmentAndTheFile) {
  environment_["ARGMESH_INSECURE_REMOTE"] = "true";
  auto parsed = Parse({WriteFile("reflection=off\n")});
  ASSERT_TRUE(parsed.ok()) << parsed.status();
  EXPECT_TRUE(parsed->options.insecure_remote);
  EXPECT_FALSE(parsed->options.reflection);
  parsed = Parse({"--insecure-remote=false", "--reflection", "on"});
  ASSERT_TRUE(parsed.ok()) << parsed.status();
  EXPECT_FALSE(parsed->options.insecure_remote);
}

TEST_F(ServerOptionsTest, TakesAnEmptyVariableAsNone) {
  environment_["ARGMESH_METRICS_LISTEN"] = "";
  environment_["ARGMESH_THREADS"] = "";
  const auto parsed = Parse({});
  ASSERT_TRUE(parsed.ok()) << parsed.status();
  EXPECT_EQ(parsed->options.metrics_listen, "");
  EXPECT_EQ(parsed->options.threads, 0);
}

TEST_F(ServerOptionsTest, NamesTheKeyOfTheFileThatIsNoOption) {
  const auto parsed = Parse({WriteFile("threads=1\nthraeds=2\n")});
  ASSERT_FALSE(parsed.ok());
  EXPECT_THAT(std::string(parsed.status().message()), HasSubstr("thraeds"));
}

TEST_F(ServerOptionsTest, NamesTheKeyOfTheFileThatHasNoValue) {
  const auto parsed = Parse({WriteFile("threads=1\n\"listen\"=[,")});
  ASSERT_FALSE(parsed.ok());
  EXPECT_THAT(std::string(parsed.status().message()), HasSubstr("listen"));
}

TEST_F(ServerOptionsTest, RefusesValuesOutsideTheirRange) {
  for (const auto& arguments :
       std::vector<std::vector<std::string>>{{"--threads", "-1"},
                                             {"--threads", "many"},
                                             {"--max-mesh-bytes", "0"},
                                             {"--max-inflight-searches", "0"},
                                             {"--drain-timeout", "-1"},
                                             {"--stream-idle-timeout", "0"},
                                             {"--reflection", "perhaps"},
                                             {"--log-level", "loud"},
                                             {"--no-such-option"},
                                             {"leftover"},
                                             {"--config", "/no/such/file"}}) {
    const auto parsed = Parse(arguments);
    EXPECT_FALSE(parsed.ok()) << arguments[0];
  }
}

TEST_F(ServerOptionsTest, NamesTheVariableThatIsWrong) {
  environment_["ARGMESH_MAX_INFLIGHT_UPLOADS"] = "zero";
  const auto parsed = Parse({});
  ASSERT_FALSE(parsed.ok());
  EXPECT_THAT(std::string(parsed.status().message()),
              HasSubstr("max-inflight-uploads"));
  EXPECT_THAT(std::string(parsed.status().message()), HasSubstr("environment"));
}

TEST_F(ServerOptionsTest, RefusesATextThatNoFileCanHave) {
  // As CLI11 reads a text with a # in it.
  EXPECT_FALSE(Parse({WriteFile("data=\"/srv/parts#2\"\n")}).ok());
  for (const char* text :
       {"a\nb", "a\x7f", "\"", "/srv/parts#2", "/srv/parts\\"}) {
    const auto parsed = Parse({"--port-file", text});
    ASSERT_FALSE(parsed.ok()) << text;
    EXPECT_THAT(std::string(parsed.status().message()),
                HasSubstr("--port-file has a control character"));
  }
}

TEST_F(ServerOptionsTest, ReadsBackWhatItPrints) {
  const auto first = Parse({"--data",
                            "/a 'quoted' folder",
                            "--threads",
                            "5",
                            "--drain-delay",
                            "1.25",
                            "--reflection",
                            "off",
                            "--insecure-remote",
                            "--max-mesh-bytes",
                            "123456",
                            "--tls-cert",
                            "c.pem",
                            "--tls-key",
                            "k.pem",
                            "--tls-client-ca",
                            "ca.pem",
                            "--keys",
                            "keys.json",
                            "--log-level",
                            "debug",
                            "--audit-log",
                            "audit",
                            "--trace-log",
                            "spans",
                            "--max-log-bytes",
                            "7000",
                            "--metrics-listen",
                            "127.0.0.1:9464",
                            "--import-root",
                            "/srv/meshes"});
  ASSERT_TRUE(first.ok()) << first.status();
  const std::string text = FormatServerOptions(first->options);
  const auto second = Parse({WriteFile(text)});
  ASSERT_TRUE(second.ok()) << second.status() << "\n" << text;
  EXPECT_EQ(FormatServerOptions(second->options), text);
  EXPECT_EQ(second->options.threads, 5);
  EXPECT_EQ(second->options.drain_delay, absl::Milliseconds(1250));
  EXPECT_TRUE(second->options.insecure_remote);
  EXPECT_EQ(second->options.tls_cert, "c.pem");
  EXPECT_EQ(second->options.tls_key, "k.pem");
  EXPECT_EQ(second->options.tls_client_ca, "ca.pem");
  EXPECT_EQ(second->options.keys, "keys.json");
  EXPECT_EQ(second->options.log_level, "debug");
  EXPECT_EQ(second->options.audit_log, "audit");
  EXPECT_EQ(second->options.trace_log, "spans");
  EXPECT_EQ(second->options.max_log_bytes, 7000);
  EXPECT_EQ(second->options.metrics_listen, "127.0.0.1:9464");
  EXPECT_EQ(second->options.import_root, "/srv/meshes");
}

TEST_F(ServerOptionsTest, ReadsBackEveryText) {
  for (const char* text : {"'", "a\\b", "it's", " a ", "[a,b]", "a;b", "a=b",
                           "{}", "'a'", "%{a}"}) {
    const auto first = Parse({"--port-file", text});
    ASSERT_TRUE(first.ok()) << first.status();
    const auto second = Parse({WriteFile(FormatServerOptions(first->options))});
    ASSERT_TRUE(second.ok()) << second.status();
    EXPECT_EQ(second->options.port_file, text);
  }
}

TEST_F(ServerOptionsTest, AnswersHelpAndVersion) {
  const auto version = Parse({"--version"});
  ASSERT_TRUE(version.ok());
  EXPECT_EQ(version->answer, "argmeshd 1.2.3\n");
  const auto help = Parse({"--help"});
  ASSERT_TRUE(help.ok());
  for (const char* option : {"--data", "--listen", "--port-file", "--config"}) {
    EXPECT_THAT(*help->answer, HasSubstr(option));
  }
}

TEST_F(ServerOptionsTest, KeepsCheckAndPrintOutOfTheFile) {
  EXPECT_TRUE(Parse({"--check-config"})->options.check_config);
  EXPECT_TRUE(Parse({"--print-config"})->options.print_config);
  EXPECT_FALSE(Parse({WriteFile("check-config=true\n")}).ok());
}

}  // namespace
}  // namespace argmesh
