#include "server/rpc/operation_registry.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "google/protobuf/wrappers.pb.h"

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

  static std::string IdOf(const Operation& operation) {
    return operation.name().substr(operation.name().find('/') + 1);
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
        ids.push_back(IdOf(operation));
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

}  // namespace
}  // namespace argmesh
