#include "server/rpc/access_rules.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "tests/support/rpc_methods.h"

namespace argmesh {
namespace {

using google::protobuf::MethodDescriptor;
using google::protobuf::MethodOptions;

std::string RuleNameOf(const MethodDescriptor& method) {
  return method.service()->name() + "." + method.name();
}

TEST(AccessRules, HaveExactlyOneForEveryRpc) {
  std::set<std::string> declared;
  for (const MethodDescriptor* method : AllMethods()) {
    declared.insert(RuleNameOf(*method));
    EXPECT_NE(FindAccessRule(RuleNameOf(*method)), nullptr)
        << RuleNameOf(*method);
  }
  std::set<std::string> ruled;
  for (const AccessRule& rule : AccessRules()) {
    EXPECT_TRUE(ruled.insert(std::string(rule.method)).second) << rule.method;
  }
  EXPECT_EQ(ruled, declared);
}

TEST(AccessRules, AuditNothingThatHasNoSideEffects) {
  for (const MethodDescriptor* method : AllMethods()) {
    const AccessRule* rule = FindAccessRule(RuleNameOf(*method));
    ASSERT_NE(rule, nullptr) << RuleNameOf(*method);
    if (method->options().idempotency_level() ==
        MethodOptions::NO_SIDE_EFFECTS) {
      EXPECT_FALSE(rule->writes) << rule->method;
    }
  }
}

TEST(AccessRules, LetNoReaderWrite) {
  for (const AccessRule& rule : AccessRules()) {
    if (rule.writes) {
      EXPECT_GE(rule.role, AccessRole::kWrite) << rule.method;
    }
  }
}

TEST(FindAccessRule, KnowsNothingElse) {
  EXPECT_EQ(FindAccessRule("ShapeService.StealShape"), nullptr);
  EXPECT_EQ(FindAccessRule(""), nullptr);
}

}  // namespace
}  // namespace argmesh
