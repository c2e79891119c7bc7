#include "server/storage/stopped_queries.h"

#include <functional>
#include <memory>

#include "absl/time/time.h"
#include "server/storage/schema.h"
#include "tests/support/large_database.h"
#include "tests/support/status_matchers.h"
#include "tests/support/temporary_directory.h"

namespace argmesh {
namespace {

constexpr int64_t kManyRows = 2'000'000;

class StoppedQueriesTest : public ::testing::Test {
 protected:
  void Open(int64_t rows) {
    ASSERT_THAT(MakeLarge(path_, rows), IsOk());
    ASSERT_OK_AND_ASSIGN(
        connection_,
        SqliteConnection::Open(path_, SqliteConnection::Mode::kReadOnly));
  }

  // `query` takes long, but not when it is stopped.
  void ExpectStops(const std::function<absl::Status()>& query) {
    const double begin = ThreadSeconds();
    ASSERT_THAT(query(), IsOk());
    const double whole = ThreadSeconds() - begin;
    const StopToken over({}, absl::UnixEpoch());
    const StoppedQueries queries(*connection_, over);
    const absl::Status stopped = OrStopped(query(), over);
    EXPECT_EQ(stopped.code(), absl::StatusCode::kDeadlineExceeded) << stopped;
    EXPECT_LT(ThreadSeconds() - begin - whole, whole / 2);
  }

  TemporaryDirectory folder_;
  std::filesystem::path path_ = folder_.path() / "test.db";
  std::unique_ptr<SqliteConnection> connection_;
};

TEST_F(StoppedQueriesTest, StopACheckOfTheStructure) {
  ASSERT_NO_FATAL_FAILURE(Open(kManyRows));
  ExpectStops([&] { return CheckDatabase(*connection_); });
}

TEST_F(StoppedQueriesTest, StopACopy) {
  ASSERT_NO_FATAL_FAILURE(Open(kManyRows));
  ASSERT_THAT(connection_->Execute("PRAGMA query_only=OFF"), IsOk());
  ExpectStops([&] {
    const std::filesystem::path copy = folder_.path() / "copy.db";
    std::filesystem::remove(copy);
    const std::string name = copy.string();
    return connection_->Run("VACUUM INTO ?", name).status();
  });
}

TEST_F(StoppedQueriesTest, LeaveOthersAlone) {
  ASSERT_NO_FATAL_FAILURE(Open(1));
  const StoppedQueries queries(*connection_, {});
  EXPECT_THAT(CheckDatabase(*connection_), IsOk());
  const absl::Status other = absl::NotFoundError("other");
  EXPECT_EQ(OrStopped(other, {}), other);
}

}  // namespace
}  // namespace argmesh
