#include "server/rpc/access_control.h"

#include <gtest/gtest.h>

#include <string>

#include "server/engine/error_reason.h"

namespace argmesh {
namespace {

const absl::Time kNow = absl::FromUnixSeconds(1'700'000'000);

class CallerOfBearerTest : public ::testing::Test {
 protected:
  CallerOfBearerTest() {
    ApiKey key;
    key.id = "ci";
    key.secret_sha256 = HashKeySecret(secret_);
    key.role = AccessRole::kWrite;
    key.collections = {"parts"};
    key.expire_time = kNow + absl::Hours(1);
    keys_.emplace(key.id, key);
  }

  const std::string secret_ = MakeKeySecret();
  KeyRing keys_;
};

TEST_F(CallerOfBearerTest, KnowsTheKey) {
  const auto caller =
      CallerOfBearer(keys_, "Bearer " + KeyText("ci", secret_), kNow);
  ASSERT_TRUE(caller.ok()) << caller.status();
  EXPECT_EQ(caller->principal, "ci");
  EXPECT_EQ(caller->role, AccessRole::kWrite);
  EXPECT_TRUE(caller->Covers("parts"));
  EXPECT_FALSE(caller->Covers("tools"));
  EXPECT_FALSE(caller->Covers(""));
}

TEST_F(CallerOfBearerTest, RefusesOtherSecretsIdsAndForms) {
  for (const std::string& header :
       {"Bearer " + KeyText("ci", MakeKeySecret()),
        "Bearer " + KeyText("ops", secret_), "bearer " + KeyText("ci", secret_),
        "Basic " + KeyText("ci", secret_), KeyText("ci", secret_),
        std::string("Bearer "), std::string()}) {
    const auto caller = CallerOfBearer(keys_, header, kNow);
    EXPECT_EQ(ReasonOf(caller.status()), ErrorReason::kKeyInvalid) << header;
  }
}

TEST_F(CallerOfBearerTest, RefusesAKeyFromTheMomentItExpires) {
  const std::string header = "Bearer " + KeyText("ci", secret_);
  const absl::Time end = kNow + absl::Hours(1);
  EXPECT_TRUE(CallerOfBearer(keys_, header, end - absl::Nanoseconds(1)).ok());
  EXPECT_EQ(ReasonOf(CallerOfBearer(keys_, header, end).status()),
            ErrorReason::kKeyExpired);
}

TEST(CheckRole, RefusesAMethodWithoutARule) {
  EXPECT_EQ(ReasonOf(CheckRole(Caller{}, "ShapeService.StealShape")),
            ErrorReason::kPermissionDenied);
  EXPECT_EQ(ReasonOf(CheckNames(Caller{}, "ShapeService.StealShape", {})),
            ErrorReason::kPermissionDenied);
}

TEST(CheckRole, KeepsBoundCallersFromTheWholeServer) {
  Caller caller;
  caller.principal = "ops";
  EXPECT_TRUE(CheckRole(caller, "AdminService.CreateSnapshot").ok());
  caller.collections = {"parts"};
  EXPECT_EQ(ReasonOf(CheckRole(caller, "AdminService.CreateSnapshot")),
            ErrorReason::kPermissionDenied);
}

TEST(CheckNames, WantsEveryNameInTheCallersCollections) {
  const Caller caller{.principal = "ci",
                      .role = AccessRole::kRead,
                      .collections = {"parts", "tools"}};
  const char* method = "ShapeService.BatchGetShapes";
  EXPECT_TRUE(
      CheckNames(caller, method, {"collections/parts", "collections/tools"})
          .ok());
  for (const std::vector<std::string>& names :
       std::vector<std::vector<std::string>>{
           {},
           {"collections/parts", "collections/other/shapes/x"},
           {"collections/partsx"},
           {"parts"},
           {"operations/parts"}}) {
    EXPECT_EQ(ReasonOf(CheckNames(caller, method, names)),
              ErrorReason::kPermissionDenied);
  }
}

}  // namespace
}  // namespace argmesh
