#include "server/storage/operation_directory.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "server/engine/error_reason.h"
#include "tests/support/status_matchers.h"
#include "tests/support/temporary_directory.h"

namespace argmesh {
namespace {

constexpr char kOne[] = "11111111-1111-4111-8111-111111111111";
constexpr char kTwo[] = "22222222-2222-4222-8222-222222222222";

class OperationDirectoryTest : public testing::Test {
 protected:
  void SetUp() override { Reopen(); }

  void Reopen() {
    store_.reset();
    directory_.reset();
    ASSERT_OK_AND_ASSIGN(directory_, DataDirectory::Open(folder_.path()));
    ASSERT_OK_AND_ASSIGN(store_, OperationDirectory::Open(directory_));
  }

  // "id: bytes" of each; the reason in the place of damaged bytes.
  std::vector<std::string> All() {
    const auto kept = store_->ReadAll();
    EXPECT_TRUE(kept.ok()) << kept.status();
    std::vector<std::string> all;
    for (const KeptOperation& one : *kept) {
      all.push_back(one.id.substr(0, 1) + ": " +
                    (one.bytes.ok() ? *one.bytes
                                    : std::string(ErrorReasonName(
                                          *ReasonOf(one.bytes.status())))));
    }
    return all;
  }

  std::filesystem::path FileOf(const std::string& name) const {
    return directory_->operations_path() / name;
  }

  TemporaryDirectory folder_;
  std::shared_ptr<DataDirectory> directory_;
  std::unique_ptr<OperationDirectory> store_;
};

using Strings = std::vector<std::string>;

TEST_F(OperationDirectoryTest, HasTheLastOfEachAlsoAfterwards) {
  EXPECT_EQ(All(), Strings{});
  ASSERT_THAT(store_->Keep(kTwo, "begun"), IsOk());
  ASSERT_THAT(store_->Keep(kOne, ""), IsOk());
  ASSERT_THAT(store_->Keep(kTwo, "ended"), IsOk());
  EXPECT_EQ(All(), (Strings{"1: ", "2: ended"}));
  Reopen();
  EXPECT_EQ(All(), (Strings{"1: ", "2: ended"}));
  ASSERT_THAT(store_->Forget(kTwo), IsOk());
  ASSERT_THAT(store_->Forget(kTwo), IsOk());
  EXPECT_EQ(All(), Strings{"1: "});
}

TEST_F(OperationDirectoryTest, NoticesDamage) {
  ASSERT_THAT(store_->Keep(kOne, "what it was"), IsOk());
  ASSERT_THAT(store_->Keep(kTwo, "begun"), IsOk());
  std::filesystem::resize_file(FileOf(kOne), 25);
  EXPECT_EQ(All(), (Strings{"1: STORED_DATA_DAMAGED", "2: begun"}));
}

TEST_F(OperationDirectoryTest, RemovesWhatWasNotFinished) {
  ASSERT_THAT(store_->Keep(kOne, "begun"), IsOk());
  const std::string unfinished = std::string(kOne) + ".part";
  std::ofstream(FileOf(unfinished)) << "half of it";
  EXPECT_EQ(All(), Strings{"1: begun"});
  Reopen();
  EXPECT_FALSE(std::filesystem::exists(FileOf(unfinished)));
  EXPECT_EQ(All(), Strings{"1: begun"});
}

}  // namespace
}  // namespace argmesh
