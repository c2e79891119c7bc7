#include "server/telemetry/event_log.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace argmesh {
namespace {

TEST(EventLog, WritesOneObjectALine) {
  std::ostringstream out;
  EventLog log(out);
  log.Write(LogLevel::kWarning, "something",
            {{"text", std::string("a \"b\"\n\xff")},
             {"count", int64_t{7}},
             {"share", 0.5},
             {"yes", true}});
  const std::string line = out.str();
  ASSERT_EQ(std::count(line.begin(), line.end(), '\n'), 1);
  const auto object = nlohmann::json::parse(line);
  EXPECT_EQ(object["level"], "warning");
  EXPECT_EQ(object["msg"], "something");
  EXPECT_EQ(object["count"], 7);
  EXPECT_EQ(object["share"], 0.5);
  EXPECT_EQ(object["yes"], true);
  EXPECT_EQ(object["text"].get<std::string>().substr(0, 6), "a \"b\"\n");
  EXPECT_EQ(object["ts"].get<std::string>().back(), 'Z');
}

TEST(EventLog, KeepsLinesOfManyThreadsWhole) {
  std::ostringstream out;
  EventLog log(out);
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&log] {
      for (int i = 0; i < 50; ++i) log.Write(LogLevel::kInfo, "tick");
    });
  }
  for (std::thread& thread : threads) thread.join();
  std::istringstream in(out.str());
  std::string line;
  int lines = 0;
  for (; std::getline(in, line); ++lines) {
    EXPECT_EQ(nlohmann::json::parse(line)["msg"], "tick");
  }
  EXPECT_EQ(lines, 200);
}

TEST(EventLog, DropsEventsBelowItsLevel) {
  std::ostringstream out;
  EventLog log(out);
  log.Write(LogLevel::kDebug, "dropped");
  EXPECT_EQ(out.str(), "");
  log.SetLowest(LogLevel::kDebug);
  log.Write(LogLevel::kDebug, "kept");
  EXPECT_EQ(nlohmann::json::parse(out.str())["level"], "debug");
}

TEST(ParseLogLevel, ReadsBackEveryName) {
  for (const LogLevel level : {LogLevel::kDebug, LogLevel::kInfo,
                               LogLevel::kWarning, LogLevel::kError}) {
    const auto parsed = ParseLogLevel(LogLevelName(level));
    ASSERT_TRUE(parsed.ok());
    EXPECT_EQ(*parsed, level);
  }
  EXPECT_FALSE(ParseLogLevel("loud").ok());
  EXPECT_FALSE(ParseLogLevel("").ok());
}

}  // namespace
}  // namespace argmesh
