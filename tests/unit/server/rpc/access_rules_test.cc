#include "server/rpc/access_rules.h"

#include <google/protobuf/descriptor.h>
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "argmesh/v1/admin_service.pb.h"
#include "argmesh/v1/collection_service.pb.h"
#include "argmesh/v1/ingest_service.pb.h"
#include "argmesh/v1/search_service.pb.h"
#include "argmesh/v1/shape_service.pb.h"
#include "google/longrunning/operations.pb.h"

namespace argmesh {
namespace {

using google::protobuf::MethodDescriptor;
using google::protobuf::MethodOptions;
using google::protobuf::ServiceDescriptor;

std::vector<const MethodDescriptor*> AllMethods() {
  std::vector<const MethodDescriptor*> methods;
  for (const auto* file :
       {v1::GetServerInfoRequest::descriptor()->file(),
        v1::GetCollectionRequest::descriptor()->file(),
        v1::IngestHello::descriptor()->file(),
        v1::SearchShapesRequest::descriptor()->file(),
        v1::GetShapeRequest::descriptor()->file(),
        google::longrunning::Operation::descriptor()->file()}) {
    for (int s = 0; s < file->service_count(); ++s) {
      const ServiceDescriptor* service = file->service(s);
      for (int m = 0; m < service->method_count(); ++m) {
        methods.push_back(service->method(m));
      }
    }
  }
  return methods;
}

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
