#include "server/rpc/operation_registry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <future>
#include <map>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "google/protobuf/wrappers.pb.h"
#include "server/rpc/operation_record.h"

namespace argmesh {
namespace {

using google::longrunning::Operation;

class OperationRegistryTest : public ::testing::Test {
 protected:
  // Operations whose answers have so many bytes each, all of them done.
  void Finish(int operations, size_t answer_bytes) {
    google::protobuf::StringValue answer;
    answer.set_value(std::string(answer_bytes, 'x'));
    for (int i = 0; i < operations; ++i) {
      const auto started = registry_.Start(
          "method", "", [&](const RunControl&) { return Packed(answer); });
      ASSERT_TRUE(started.ok()) << started.status();
      while (registry_.running() > 0) std::this_thread::yield();
    }
  }

  // The id of an operation that ends once `go` is there.
  static std::string StartWaiting(OperationRegistry& registry,
                                  const std::shared_future<void>& go) {
    return OperationId(*registry.Start("method", "", [go](const RunControl&) {
      go.wait();
      return Packed(google::protobuf::StringValue());
    }));
  }

  std::ostringstream log_text_;
  EventLog log_{log_text_};
  OperationRegistry registry_{log_};
};

TEST_F(OperationRegistryTest, CutsPagesByCountAndByBytes) {
  Finish(/*operations=*/5, /*answer_bytes=*/1000);
  for (const auto& [limit, max_bytes, of_a_page] :
       std::vector<std::tuple<int, int64_t, size_t>>{
           {2, 1 << 20, 2}, {100, 2500, 2}, {100, 1, 1}, {5, 1 << 20, 5}}) {
    std::vector<std::string> ids;
    OperationRegistry::Page page = {.operations = {}, .more = true};
    while (page.more) {
      page = registry_.List(ids.empty() ? "" : ids.back(), limit, max_bytes);
      ASSERT_FALSE(page.operations.empty());
      EXPECT_LE(page.operations.size(), of_a_page);
      EXPECT_TRUE(!page.more || page.operations.size() == of_a_page);
      for (const Operation& operation : page.operations) {
        ids.push_back(OperationId(operation));
      }
    }
    EXPECT_EQ(ids.size(), 5U);
    EXPECT_TRUE(std::is_sorted(ids.begin(), ids.end()));
  }
}

TEST_F(OperationRegistryTest, HasNoMoreWhereThereIsNothing) {
  const OperationRegistry::Page page = registry_.List("", 10, 1000);
  EXPECT_TRUE(page.operations.empty());
  EXPECT_FALSE(page.more);
}

// What is kept outlives the registry.
class MapStore : public OperationStore {
 public:
  absl::Status Keep(std::string_view id, std::string_view bytes) override {
    kept_[std::string(id)] = bytes;
    return absl::OkStatus();
  }
  absl::Status Forget(std::string_view id) override {
    kept_.erase(std::string(id));
    return absl::OkStatus();
  }
  absl::StatusOr<std::vector<KeptOperation>> ReadAll() const override {
    std::vector<KeptOperation> all;
    for (const auto& [id, bytes] : kept_) all.push_back({id, bytes});
    return all;
  }
  size_t size() const { return kept_.size(); }

 private:
  std::map<std::string, std::string> kept_;
};

TEST_F(OperationRegistryTest, RemembersThoseOfTheProcessBefore) {
  MapStore store;
  std::string done;
  {
    OperationRegistry registry(log_, &store);
    done = OperationId(
        *registry.Start("method", "resource", [](const RunControl&) {
          return Packed(google::protobuf::StringValue());
        }));
    registry.EndAll();
  }
  OperationRegistry registry(log_, &store);
  const auto operation = registry.Get(done);
  ASSERT_TRUE(operation.ok()) << operation.status();
  EXPECT_TRUE(operation->done());
  EXPECT_TRUE(operation->has_response());
  EXPECT_TRUE(registry.Delete(done).ok());
  EXPECT_EQ(store.size(), 0U);
}

TEST_F(OperationRegistryTest, SaysThatAnOperationWasInterrupted) {
  // As it was kept when it began.
  MapStore left;
  const std::string id = [&] {
    MapStore store;
    std::promise<void> go;
    OperationRegistry registry(log_, &store);
    std::string begun = StartWaiting(registry, go.get_future().share());
    left = store;
    go.set_value();
    return begun;
  }();
  ASSERT_EQ(left.size(), 1U);
  for (int restart = 0; restart < 2; ++restart) {
    OperationRegistry registry(log_, &left);
    const auto operation = registry.Get(id);
    ASSERT_TRUE(operation.ok()) << operation.status();
    EXPECT_TRUE(operation->done());
    EXPECT_EQ(operation->error().code(), 1);  // CANCELLED
    EXPECT_NE(operation->error().message().find("call again"),
              std::string::npos);
    EXPECT_EQ(registry.running(), 0);
  }
}

TEST_F(OperationRegistryTest, ForgetsAnOperationThatWasDeletedWhileItRan) {
  MapStore store;
  std::promise<void> go;
  OperationRegistry registry(log_, &store);
  const std::string begun = StartWaiting(registry, go.get_future().share());
  EXPECT_TRUE(registry.Delete(begun).ok());
  go.set_value();
  registry.EndAll();
  EXPECT_EQ(store.size(), 0U);
}

}  // namespace
}  // namespace argmesh
