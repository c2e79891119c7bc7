#include "core/access/api_key.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace argmesh {
namespace {

TEST(MakeKeySecret, GivesOtherSecretsThatParse) {
  std::set<std::string> seen;
  for (int i = 0; i < 100; ++i) {
    const std::string secret = MakeKeySecret();
    EXPECT_TRUE(seen.insert(secret).second);
    const auto presented = ParseKeyText(KeyText("ci-2", secret));
    ASSERT_TRUE(presented.ok()) << presented.status();
    EXPECT_EQ(presented->id, "ci-2");
    EXPECT_EQ(presented->secret_sha256, HashKeySecret(secret));
  }
}

TEST(ParseKeyText, RefusesWhatIsNoKeyWithoutQuotingIt) {
  const std::string secret(43, 's');
  for (const std::string& text :
       {std::string(), std::string("."), secret, "ci." + secret + "s",
        "ci." + secret.substr(1), "Ci." + secret, "." + secret, "ci-." + secret,
        "ci " + secret}) {
    const auto presented = ParseKeyText(text);
    ASSERT_FALSE(presented.ok()) << text;
    EXPECT_EQ(std::string(presented.status().message()).find("sss"),
              std::string::npos);
  }
}

TEST(SameSecret, SeesEveryByte) {
  const Sha256Digest a = HashKeySecret("a");
  EXPECT_TRUE(SameSecret(a, a));
  for (size_t i = 0; i < a.size(); ++i) {
    Sha256Digest b = a;
    b[i] ^= 1;
    EXPECT_FALSE(SameSecret(a, b)) << i;
  }
}

TEST(ParseAccessRole, ReadsBackEveryNameAndOrdersTheRoles) {
  for (const AccessRole role :
       {AccessRole::kRead, AccessRole::kWrite, AccessRole::kAdmin}) {
    EXPECT_EQ(ParseAccessRole(AccessRoleName(role)).value(), role);
  }
  EXPECT_FALSE(ParseAccessRole("root").ok());
  EXPECT_LT(AccessRole::kRead, AccessRole::kWrite);
  EXPECT_LT(AccessRole::kWrite, AccessRole::kAdmin);
}

}  // namespace
}  // namespace argmesh
