#include "client/cli/progress_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace argmesh {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(FormatProgress, ShowsCountRateAndTimeLeft) {
  const std::string line = FormatProgress("ingest", 25, 100, absl::Seconds(10));
  EXPECT_THAT(line, HasSubstr("ingest [=======>"));
  EXPECT_THAT(line, HasSubstr("25/100  2.5/s  eta 30s"));
}

TEST(FormatProgress, GuessesNothingBeforeTheFirstItem) {
  const std::string line = FormatProgress("x", 0, 10, absl::Seconds(5));
  EXPECT_THAT(line, HasSubstr("0/10"));
  EXPECT_THAT(line, Not(HasSubstr("eta")));
}

TEST(FormatProgress, HasNoTimeLeftAtTheEndAndIsNeverOverfull) {
  EXPECT_THAT(FormatProgress("x", 10, 10, absl::Seconds(5)),
              Not(HasSubstr("eta")));
  EXPECT_EQ(FormatProgress("x", 12, 10, absl::Seconds(5)),
            FormatProgress("x", 10, 10, absl::Seconds(5)));
  EXPECT_THAT(FormatProgress("x", 0, 0, absl::ZeroDuration()),
              HasSubstr("0/0"));
}

TEST(FormatProgress, ShowsLongTimesInMinutesAndHours) {
  EXPECT_THAT(FormatProgress("x", 1, 91, absl::Seconds(1)),
              HasSubstr("eta 1m30s"));
  EXPECT_THAT(FormatProgress("x", 1, 7201, absl::Seconds(1)),
              HasSubstr("eta 2h00m"));
}

TEST(ProgressLine, IsSilentWithoutATerminal) {
  std::ostringstream out;
  {
    ProgressLine line(out, false, "x", 10);
    line.Advance(5);
    line.Print("failed a.off");
    line.Advance(10);
  }
  EXPECT_EQ(out.str(), "failed a.off\n");
}

TEST(ProgressLine, RemovesItselfFromATerminal) {
  std::ostringstream out;
  {
    ProgressLine line(out, true, "x", 10);
    line.Advance(5);
    line.Print("failed a.off");
  }
  EXPECT_THAT(out.str(), HasSubstr("\rfailed a.off\n\rx ["));
  EXPECT_TRUE(out.str().ends_with(" \r"));
}

}  // namespace
}  // namespace argmesh
