#include "server/telemetry/telemetry.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/temporary_directory.h"

namespace argmesh {
namespace {

using Json = nlohmann::json;

class TelemetryTest : public ::testing::Test {
 protected:
  void Open(LogLevel level) {
    auto opened = Telemetry::Open(
        {.log_level = level, .audit_log = audit_path_, .trace_log = ""}, log_);
    ASSERT_TRUE(opened.ok()) << opened.status();
    telemetry_ = *std::move(opened);
  }

  static CallRecord Record(absl::StatusCode code, bool writes = false) {
    CallRecord record;
    record.method = "ShapeService.GetShape";
    record.code = code;
    record.writes = writes;
    record.begin = absl::FromUnixSeconds(1'700'000'000);
    record.end = record.begin + absl::Milliseconds(1);
    return record;
  }

  static std::vector<Json> LinesOf(std::istream& in) {
    std::vector<Json> lines;
    for (std::string line; std::getline(in, line);) {
      lines.push_back(Json::parse(line));
    }
    return lines;
  }
  std::vector<Json> Log() {
    std::istringstream in(log_.str());
    return LinesOf(in);
  }
  std::vector<Json> Audit() {
    std::ifstream in(audit_path_);
    return LinesOf(in);
  }

  const TemporaryDirectory folder_;
  const std::string audit_path_ = folder_.path() / "audit";
  std::ostringstream log_;
  std::unique_ptr<Telemetry> telemetry_;
};

TEST_F(TelemetryTest, LogsACallByHowItEnded) {
  Open(LogLevel::kDebug);
  const std::vector<std::pair<absl::StatusCode, std::string>> cases = {
      {absl::StatusCode::kOk, "debug"},
      {absl::StatusCode::kNotFound, "info"},
      {absl::StatusCode::kResourceExhausted, "warning"},
      {absl::StatusCode::kPermissionDenied, "warning"},
      {absl::StatusCode::kInternal, "error"},
      {absl::StatusCode::kDataLoss, "error"}};
  for (const auto& [code, level] : cases) {
    telemetry_->CallFinished(Record(code));
    const Json line = Log().back();
    EXPECT_EQ(line["level"], level);
    EXPECT_EQ(line["msg"], "call");
    EXPECT_EQ(line["code"], absl::StatusCodeToString(code));
  }
}

TEST_F(TelemetryTest, DropsWhatIsBelowTheLevelUntilItChanges) {
  Open(LogLevel::kWarning);
  telemetry_->CallFinished(Record(absl::StatusCode::kOk));
  telemetry_->CallFinished(Record(absl::StatusCode::kNotFound));
  EXPECT_TRUE(Log().empty());
  telemetry_->log().SetLowest(LogLevel::kDebug);
  telemetry_->CallFinished(Record(absl::StatusCode::kOk));
  EXPECT_EQ(Log().size(), 1U);
}

TEST_F(TelemetryTest, KeepsInternalsInTheLogAndOutOfTheAuditLog) {
  Open(LogLevel::kInfo);
  CallRecord record = Record(absl::StatusCode::kInternal, /*writes=*/true);
  record.internals = "stack of a defect";
  record.request_id = "r-1";
  telemetry_->CallFinished(record);
  EXPECT_EQ(Log().back()["error"], "stack of a defect");
  EXPECT_EQ(Log().back()["request_id"], "r-1");
  EXPECT_FALSE(Audit().back().contains("error"));
}

TEST_F(TelemetryTest, AuditsWritesAndDenialsOnly) {
  Open(LogLevel::kError);
  telemetry_->CallFinished(Record(absl::StatusCode::kOk));
  telemetry_->CallFinished(Record(absl::StatusCode::kNotFound));
  EXPECT_TRUE(Audit().empty());
  CallRecord write = Record(absl::StatusCode::kOk, /*writes=*/true);
  write.principal = "ci";
  write.resource = "collections/parts";
  telemetry_->CallFinished(write);
  telemetry_->CallFinished(Record(absl::StatusCode::kUnauthenticated));
  telemetry_->CallFinished(Record(absl::StatusCode::kPermissionDenied));
  const std::vector<Json> audit = Audit();
  ASSERT_EQ(audit.size(), 3U);
  EXPECT_EQ(audit[0]["principal"], "ci");
  EXPECT_EQ(audit[0]["resource"], "collections/parts");
  EXPECT_EQ(audit[0]["code"], "OK");
  EXPECT_EQ(audit[0]["ts"], "2023-11-14T22:13:20.001Z");
  EXPECT_EQ(audit[2]["code"], "PERMISSION_DENIED");
}

TEST_F(TelemetryTest, FailsWhenAFileCannotBeOpened) {
  const auto opened = Telemetry::Open({.log_level = LogLevel::kInfo,
                                       .audit_log = "",
                                       .trace_log = "/no/such/folder/spans"},
                                      log_);
  EXPECT_EQ(opened.status().code(), absl::StatusCode::kUnavailable);
}

}  // namespace
}  // namespace argmesh
