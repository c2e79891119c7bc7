// Every kind of change that the store makes to its files fails once, or is the
// moment the process dies: at a migration, at start, in writes, commits and
// checkpoints, at the end.
//
// The failpoints are found by a run in which nothing fails: each kind of call
// on each kind of file, at ARGMESH_FAILPOINT_TIMES of its times spread over
// the run, first and last among them; 3 when not set.
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <new>
#include <set>
#include <string>
#include <vector>

#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "core/graph/graph_codec.h"
#include "server/engine/record_codec.h"
#include "server/storage/schema.h"
#include "tests/reliability/file_calls.h"
#include "tests/reliability/real_store.h"
#include "tests/reliability/store_script.h"
#include "tests/support/catalog_dump.h"
#include "tests/support/environment_number.h"
#include "tests/support/memory_mesh_store.h"
#include "tests/support/status_matchers.h"
#include "tests/support/temporary_directory.h"

namespace argmesh {
namespace {

namespace fs = std::filesystem;

constexpr size_t kSteps = 40;
constexpr size_t kStarts = 2;
constexpr int kDied = 77;

enum class Mode { kNothing, kError, kDeath };

struct Failpoint {
  std::string what;  // as FaultyDisk names it
  int64_t time = 0;  // the first is 1
  Mode mode = Mode::kNothing;
  int error = EIO;
};

// Counts calls by what they do to which kind of file; at one of them fails or
// ends the process.
class FaultyDisk : public FileCallObserver {
 public:
  FaultyDisk(fs::path root, Failpoint failpoint)
      : root_(std::move(root)), failpoint_(std::move(failpoint)) {}

  int Before(const FileCall& call) override {
    const std::string what = Name(call);
    if (++times_[what] != failpoint_.time || what != failpoint_.what) return 0;
    if (failpoint_.mode == Mode::kDeath) _exit(kDied);
    fired_ = true;
    return failpoint_.error;
  }
  void After(const FileCall&) override {}

  bool fired() const { return fired_; }
  const std::map<std::string, int64_t>& times() const { return times_; }

 private:
  // Such as "write catalog.db-wal", "sync blobs/XX".
  std::string Name(const FileCall& call) const {
    const fs::path path = fs::path(call.path).lexically_relative(root_);
    std::string name = *path.begin();
    if (name == "blobs" || name == "incoming") {
      const auto depth = std::distance(path.begin(), path.end());
      name += depth == 1 ? "" : depth == 2 ? "/X" : "/X/SHA";
    }
    return absl::StrCat(FileCallName(call.kind), " ", name);
  }

  const fs::path root_;
  const Failpoint failpoint_;
  std::map<std::string, int64_t> times_;
  std::atomic<bool> fired_ = false;
};

class FailpointTest : public testing::Test {
 protected:
  // A store of the first schema version, with a collection.
  void SetUp() override {
    const fs::path path = NewStore() / "catalog.db";
    auto connection =
        SqliteConnection::Open(path, SqliteConnection::Mode::kReadWrite);
    ASSERT_THAT(connection, IsOk());
    ASSERT_THAT(Migrate(**connection, path, CatalogMigrations().first(1)),
                IsOk());
    const std::string settings = SerializeCollectionSettings({});
    ASSERT_THAT(
        (*connection)
            ->Execute(absl::StrCat(
                "INSERT INTO collection(name, uid, display_name, settings, "
                "graph_version, create_us, update_us) VALUES('old', 'uid', "
                "'Old', x'",
                absl::BytesToHexString(settings), "', ", kShapeGraphVersion,
                ", 1, 1)")),
        IsOk());
    connection->reset();
    first_version_ = path.parent_path();
  }

  fs::path NewStore() {
    fs::path path = root_ / absl::StrCat("store-", next_store_++);
    fs::create_directory(path);
    return path;
  }

  fs::path CopyOfFirstVersion() {
    const fs::path path = NewStore();
    fs::copy(first_version_, path, fs::copy_options::recursive);
    return path;
  }

  // Runs the script on the store, which fails at most once: what is answered
  // with an error has not happened, everything else has.
  void RunWithError(const fs::path& path, FaultyDisk& disk) {
    MemoryCatalog twin;
    RunBesideTwin(path, disk, twin);
    ExpectWhole(path, {DumpCollection(twin, script_.collection())});
  }

  void RunBesideTwin(const fs::path& path, FaultyDisk& disk, Catalog& twin) {
    MemoryMeshStore twin_meshes;
    const FileCallObservation observation(path, &disk);
    for (size_t start = 0; start < kStarts; ++start) {
      bool fired = disk.fired();
      absl::StatusOr<RealStore> store = RealStore::Open(path);
      if (!store.ok() && disk.fired() != fired) store = RealStore::Open(path);
      ASSERT_THAT(store, IsOk());
      for (size_t i = kSteps * start / kStarts;
           i < kSteps * (start + 1) / kStarts; ++i) {
        fired = disk.fired();
        const absl::Status status =
            script_.Run(i, *store->catalog, *store->meshes);
        if (!status.ok() && disk.fired() != fired) continue;
        const absl::Status expected = script_.Run(i, twin, twin_meshes);
        ASSERT_EQ(status.code(), expected.code()) << "step " << i << status;
      }
      EXPECT_TRUE(Dump(*store) == DumpCollection(twin, script_.collection()));
      EXPECT_THAT(store->CheckWhole(), IsOk());
      fired = disk.fired();
      const absl::Status closed = store->catalog->Close();
      EXPECT_TRUE(closed.ok() || disk.fired() != fired) << closed;
    }
  }

  // Runs the script in a process that dies at the failpoint; how many steps it
  // was told of.
  size_t RunUntilDeath(const fs::path& path, const Failpoint& failpoint) {
    const pid_t child = fork();
    if (child == 0) {
      *acknowledged_ = 0;
      FaultyDisk disk(path, failpoint);
      const FileCallObservation observation(path, &disk);
      for (size_t start = 0; start < kStarts; ++start) {
        const absl::StatusOr<RealStore> store = RealStore::Open(path);
        for (size_t i = kSteps * start / kStarts;
             i < kSteps * (start + 1) / kStarts; ++i) {
          (void)script_.Run(i, *store->catalog, *store->meshes);
          *acknowledged_ = i + 1;
        }
        (void)store->catalog->Close();
      }
      _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == kDied) << status;
    return *acknowledged_;
  }

  // The store opens, is whole, and holds one of `states`.
  void ExpectWhole(const fs::path& path, const std::set<std::string>& states) {
    const absl::StatusOr<RealStore> store = RealStore::Open(path);
    ASSERT_THAT(store, IsOk());
    EXPECT_THAT(store->CheckWhole(), IsOk());
    EXPECT_TRUE(states.contains(Dump(*store)));
    const auto old = store->catalog->GetCollection("old");
    ASSERT_THAT(old, IsOk());
    EXPECT_EQ(old->display_name, "Old");
    EXPECT_THAT(store->catalog->Close(), IsOk());
  }

  std::string Dump(const RealStore& store) const {
    return DumpCollection(*store.catalog, script_.collection());
  }

  void Try(const Failpoint& failpoint) {
    const fs::path path = CopyOfFirstVersion();
    if (failpoint.mode == Mode::kDeath) {
      const size_t steps = RunUntilDeath(path, failpoint);
      ExpectWhole(path, {script_.StateAfter(steps),
                         script_.StateAfter(std::min(steps + 1, kSteps))});
    } else {
      FaultyDisk disk(path, failpoint);
      RunWithError(path, disk);
      EXPECT_TRUE(disk.fired());
    }
    fs::remove_all(path);
  }

  const TemporaryDirectory folder_;
  const fs::path root_ = fs::canonical(folder_.path());
  const StoreScript script_{"c", 5, kSteps};
  // Shared with the process that dies.
  std::atomic<size_t>* const acknowledged_ =
      new (mmap(nullptr, sizeof(std::atomic<size_t>), PROT_READ | PROT_WRITE,
                MAP_SHARED | MAP_ANONYMOUS, -1, 0)) std::atomic<size_t>(0);
  int next_store_ = 0;
  fs::path first_version_;
};

std::set<int64_t> Spread(int64_t last, int64_t count) {
  std::set<int64_t> times = {1, last};
  for (int64_t i = 1; i + 1 < count; ++i) {
    times.insert(1 + (last - 1) * i / (count - 1));
  }
  return times;
}

TEST_F(FailpointTest, AFailedCallIsAnErrorOrNothingAndDeathLosesNothing) {
  FaultyDisk counting(root_ / absl::StrCat("store-", next_store_), {});
  RunWithError(CopyOfFirstVersion(), counting);
  const auto times =
      static_cast<int64_t>(EnvironmentNumber("ARGMESH_FAILPOINT_TIMES", 3));
  int failpoints = 0;
  for (const auto& [what, last] : counting.times()) {
    for (const int64_t time : Spread(last, times)) {
      ++failpoints;
      for (const Mode mode : {Mode::kError, Mode::kDeath}) {
        SCOPED_TRACE(absl::StrCat(what, ", time ", time, " of ", last,
                                  mode == Mode::kDeath ? ", death" : ""));
        Try({what, time, mode, time % 2 == 0 ? ENOSPC : EIO});
      }
    }
  }
  EXPECT_GE(failpoints, 30);
  std::printf(
      "measured: %d failpoints in %zu kinds of file calls, each as error and "
      "as death: "
      "%s\n",
      failpoints, counting.times().size(),
      HasFailure() ? "failures found" : "0 failures");
}

}  // namespace
}  // namespace argmesh
