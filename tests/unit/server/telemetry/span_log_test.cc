#include "server/telemetry/span_log.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/temporary_directory.h"

namespace argmesh {
namespace {

using Json = nlohmann::json;

const absl::Time kBegin = absl::FromUnixSeconds(1'700'000'000);

CallRecord Record() {
  CallRecord record;
  record.method = "ShapeService.GetShape";
  record.peer = "ipv4:127.0.0.1:1";
  record.trace = {.trace_id = "0af7651916cd43dd8448eb211c80319c",
                  .parent_id = "b7ad6b7169203331"};
  record.begin = kBegin;
  record.work_begin = kBegin + absl::Milliseconds(2);
  record.end = kBegin + absl::Milliseconds(5);
  return record;
}

Json SpansOf(const CallRecord& record) {
  const std::string line = SpanLine(record);
  EXPECT_EQ(line.find('\n'), std::string::npos);
  return Json::parse(line)["resourceSpans"][0]["scopeSpans"][0]["spans"];
}

TEST(SpanLine, ContinuesTheTraceOfTheCaller) {
  const Json spans = SpansOf(Record());
  ASSERT_EQ(spans.size(), 3U);
  EXPECT_EQ(spans[0]["name"], "argmesh.v1.ShapeService/GetShape");
  EXPECT_EQ(spans[0]["parentSpanId"], "b7ad6b7169203331");
  EXPECT_EQ(spans[0]["kind"], 2);
  for (const Json& span : spans) {
    EXPECT_EQ(span["traceId"], "0af7651916cd43dd8448eb211c80319c");
  }
}

TEST(SpanLine, NamesAServiceByItsOwnPackage) {
  CallRecord record = Record();
  record.method = "Operations.GetOperation";
  const Json spans = SpansOf(record);
  EXPECT_EQ(spans[0]["name"], "google.longrunning.Operations/GetOperation");
  EXPECT_EQ(spans[0]["attributes"][1]["value"]["stringValue"],
            "google.longrunning.Operations");
}

TEST(SpanLine, SplitsACallIntoQueueAndWork) {
  const Json spans = SpansOf(Record());
  EXPECT_EQ(spans[1]["name"], "queue");
  EXPECT_EQ(spans[2]["name"], "work");
  EXPECT_EQ(spans[1]["parentSpanId"], spans[0]["spanId"]);
  EXPECT_EQ(spans[2]["parentSpanId"], spans[0]["spanId"]);
  EXPECT_EQ(spans[0]["startTimeUnixNano"], "1700000000000000000");
  EXPECT_EQ(spans[1]["endTimeUnixNano"], "1700000000002000000");
  EXPECT_EQ(spans[2]["startTimeUnixNano"], "1700000000002000000");
  EXPECT_EQ(spans[2]["endTimeUnixNano"], "1700000000005000000");
}

TEST(SpanLine, BeginsATraceWhereTheCallerSentNone) {
  CallRecord record = Record();
  record.trace = {};
  record.work_begin = absl::InfiniteFuture();
  const Json spans = SpansOf(record);
  ASSERT_EQ(spans.size(), 1U);
  EXPECT_EQ(spans[0]["traceId"].get<std::string>().size(), 32U);
  EXPECT_FALSE(spans[0].contains("parentSpanId"));
  EXPECT_FALSE(spans[0].contains("status"));
}

TEST(SpanLine, SaysHowACallFailed) {
  CallRecord record = Record();
  record.code = absl::StatusCode::kNotFound;
  record.reason = "SHAPE_NOT_FOUND";
  const Json span = SpansOf(record)[0];
  EXPECT_EQ(span["status"]["code"], 2);
  bool found = false;
  for (const Json& attribute : span["attributes"]) {
    if (attribute["key"] == "rpc.grpc.status_code") {
      EXPECT_EQ(attribute["value"]["intValue"], "5");
    }
    found |= attribute["value"].value("stringValue", "") == "SHAPE_NOT_FOUND";
  }
  EXPECT_TRUE(found);
}

TEST(SpanLog, LeavesOutWhatTheCallerDoesNotSample) {
  const TemporaryDirectory folder;
  const std::string path = folder.path() / "spans";
  auto file = LineFile::Open(path);
  ASSERT_TRUE(file.ok()) << file.status();
  SpanLog log(*std::move(file));
  CallRecord record = Record();
  log.Write(record);
  record.trace.sampled = false;
  log.Write(record);
  std::ifstream in(path);
  int lines = 0;
  for (std::string line; std::getline(in, line);) ++lines;
  EXPECT_EQ(lines, 1);
}

}  // namespace
}  // namespace argmesh
