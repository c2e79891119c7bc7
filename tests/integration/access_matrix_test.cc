// Every rpc x every role x {no key, a bad one, an expired one, another
// collection}, over the wire. The rpcs come from the descriptors: a new one is
// in the matrix by itself.
#include <google/protobuf/descriptor.h>
#include <google/protobuf/dynamic_message.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "server/rpc/access_rules.h"
#include "tests/integration/generic_call.h"
#include "tests/integration/server_fixture.h"
#include "tests/support/rpc_methods.h"

namespace argmesh {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::MessageFactory;
using google::protobuf::MethodDescriptor;

constexpr char kMine[] = "mine";
constexpr char kOther[] = "other";

// One field of a request, from the outside in, that names a resource.
using FieldPath = std::vector<const FieldDescriptor*>;

bool NamesAResource(const FieldDescriptor& field) {
  static const std::set<std::string> kNames = {
      "name", "names", "parent", "shape", "collection", "collection_id"};
  return field.cpp_type() == FieldDescriptor::CPPTYPE_STRING &&
         kNames.contains(field.name());
}

// Graphs hold names too, but of their levels.
bool IsLookedInto(const FieldDescriptor& field) {
  return field.cpp_type() == FieldDescriptor::CPPTYPE_MESSAGE &&
         !field.is_map() && field.message_type()->name() != "ShapeGraph";
}

void FindPaths(const google::protobuf::Descriptor& type, FieldPath outer,
               std::vector<FieldPath>& paths) {
  for (int i = 0; i < type.field_count(); ++i) {
    FieldPath path = outer;
    path.push_back(type.field(i));
    if (NamesAResource(*type.field(i))) {
      paths.push_back(path);
    } else if (IsLookedInto(*type.field(i))) {
      FindPaths(*type.field(i)->message_type(), path, paths);
    }
  }
}

void SetPath(Message& request, const FieldPath& path,
             const std::string& collection) {
  Message* message = &request;
  for (size_t i = 0; i + 1 < path.size(); ++i) {
    const auto* reflection = message->GetReflection();
    if (!path[i]->is_repeated()) {
      message = reflection->MutableMessage(message, path[i]);
    } else if (reflection->FieldSize(*message, path[i]) > 0) {
      message = reflection->MutableRepeatedMessage(message, path[i], 0);
    } else {
      message = reflection->AddMessage(message, path[i]);
    }
  }
  const FieldDescriptor* field = path.back();
  const std::string value =
      field->name() == "collection_id" ? collection
      : field->name() == "parent" || field->name() == "collection"
          ? "collections/" + collection
          : "collections/" + collection + "/shapes/x";
  const auto* reflection = message->GetReflection();
  if (field->is_repeated()) {
    reflection->AddString(message, field, value);
  } else {
    reflection->SetString(message, field, value);
  }
}

std::vector<FieldPath> PathsOf(const MethodDescriptor& method) {
  std::vector<FieldPath> paths;
  FindPaths(*method.input_type(), {}, paths);
  return paths;
}

// Every name of the request lies in `collection`.
std::unique_ptr<Message> RequestIn(const MethodDescriptor& method,
                                   const std::string& collection) {
  std::unique_ptr<Message> request(MessageFactory::generated_factory()
                                       ->GetPrototype(method.input_type())
                                       ->New());
  for (const FieldPath& path : PathsOf(method)) {
    SetPath(*request, path, collection);
  }
  return request;
}

const AccessRule& RuleOf(const MethodDescriptor& method) {
  const AccessRule* rule =
      FindAccessRule(method.service()->name() + "." + method.name());
  if (rule == nullptr) ADD_FAILURE() << method.full_name() << " has no rule";
  static const AccessRule kNothing = {"", AccessRole::kAdmin,
                                      AccessScope::kServer, true};
  return rule == nullptr ? kNothing : *rule;
}

class AccessMatrixTest : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const AccessRole role :
         {AccessRole::kRead, AccessRole::kWrite, AccessRole::kAdmin}) {
      const std::string name(AccessRoleName(role));
      free_[role] = AddKey(name, role, {}, absl::InfiniteFuture());
      bound_[role] =
          AddKey(name + "-bound", role, {kMine}, absl::InfiniteFuture());
    }
    expired_ = AddKey("expired", AccessRole::kAdmin, {},
                      absl::Now() - absl::Seconds(1));
    TestServerOptions options;
    options.rpc.keys = std::make_shared<const KeyRing>(keys_);
    server_ = std::make_unique<TestServer>(options);
    server_->Start();
  }

  std::string AddKey(const std::string& id, AccessRole role,
                     std::vector<std::string> collections, absl::Time expiry) {
    const std::string secret = MakeKeySecret();
    ApiKey key;
    key.id = id;
    key.secret_sha256 = HashKeySecret(secret);
    key.role = role;
    key.collections = std::move(collections);
    key.expire_time = expiry;
    keys_.emplace(id, key);
    return KeyText(id, secret);
  }

  // The reason of the call's failure; empty when it succeeded.
  std::string Call(const MethodDescriptor& method, const Message& request,
                   const std::string& key) {
    const grpc::Status status = CallGenerically(
        server_->channel(),
        "/" + method.service()->full_name() + "/" + method.name(), request,
        key);
    const ErrorOf error(status);
    EXPECT_TRUE(status.ok() || !error.reason.empty())
        << method.full_name() << ": " << status.error_message();
    return error.reason;
  }

  KeyRing keys_;
  std::map<AccessRole, std::string> free_;   // for all collections
  std::map<AccessRole, std::string> bound_;  // for kMine
  std::string expired_;
  std::unique_ptr<TestServer> server_;
};

TEST_F(AccessMatrixTest, RefusesEveryRpcWithoutAGoodKey) {
  const std::string& good = free_[AccessRole::kAdmin];
  const std::string other_secret = KeyText("admin", MakeKeySecret());
  for (const MethodDescriptor* method : AllMethods()) {
    const auto request = RequestIn(*method, kMine);
    EXPECT_EQ(Call(*method, *request, ""), "KEY_MISSING")
        << method->full_name();
    EXPECT_EQ(Call(*method, *request, other_secret), "KEY_INVALID")
        << method->full_name();
    EXPECT_EQ(Call(*method, *request, good.substr(0, good.size() - 1)),
              "KEY_INVALID")
        << method->full_name();
    EXPECT_EQ(Call(*method, *request, expired_), "KEY_EXPIRED")
        << method->full_name();
  }
}

TEST_F(AccessMatrixTest, AsksEveryRpcForItsRole) {
  for (const MethodDescriptor* method : AllMethods()) {
    const AccessRule& rule = RuleOf(*method);
    for (const auto& [role, key] : free_) {
      const std::string reason = Call(*method, *RequestIn(*method, kMine), key);
      EXPECT_EQ(reason == "PERMISSION_DENIED", role < rule.role)
          << method->full_name() << " as " << AccessRoleName(role) << ": "
          << reason;
    }
  }
}

TEST_F(AccessMatrixTest, KeepsBoundKeysInTheirCollections) {
  for (const MethodDescriptor* method : AllMethods()) {
    const AccessRule& rule = RuleOf(*method);
    for (const auto& [role, key] : bound_) {
      const bool may = role >= rule.role && rule.scope != AccessScope::kServer;
      const std::string mine = Call(*method, *RequestIn(*method, kMine), key);
      EXPECT_EQ(mine == "PERMISSION_DENIED", !may)
          << method->full_name() << " as " << AccessRoleName(role) << ": "
          << mine;
      if (rule.scope != AccessScope::kCollection) continue;
      const std::string other = Call(*method, *RequestIn(*method, kOther), key);
      EXPECT_EQ(other, "PERMISSION_DENIED")
          << method->full_name() << " as " << AccessRoleName(role);
    }
  }
}

TEST_F(AccessMatrixTest, LooksAtEveryNameOfARequest) {
  for (const MethodDescriptor* method : AllMethods()) {
    const AccessRule& rule = RuleOf(*method);
    if (rule.scope != AccessScope::kCollection) continue;
    const std::vector<FieldPath> paths = PathsOf(*method);
    EXPECT_FALSE(paths.empty()) << method->full_name() << " names nothing";
    for (const FieldPath& path : paths) {
      const auto request = RequestIn(*method, kMine);
      SetPath(*request, path, kOther);
      const std::string reason =
          Call(*method, *request, bound_[AccessRole::kAdmin]);
      EXPECT_EQ(reason, "PERMISSION_DENIED")
          << method->full_name() << ", field " << path.back()->full_name();
    }
  }
}

TEST_F(AccessMatrixTest, ListsOnlyWhatTheCallerMaySee) {
  for (const char* id : {kMine, kOther}) {
    v1::CreateCollectionRequest request;
    request.set_collection_id(id);
    grpc::ClientContext context;
    context.AddMetadata("authorization", "Bearer " + free_[AccessRole::kWrite]);
    v1::Collection collection;
    ASSERT_CALL_OK(server_->collections().CreateCollection(&context, request,
                                                           &collection));
  }
  const auto list = [&](const std::string& key) {
    grpc::ClientContext context;
    context.AddMetadata("authorization", "Bearer " + key);
    v1::ListCollectionsResponse response;
    const grpc::Status status = server_->collections().ListCollections(
        &context, v1::ListCollectionsRequest(), &response);
    EXPECT_TRUE(status.ok()) << ErrorOf(status);
    std::vector<std::string> names;
    for (const auto& c : response.collections()) names.push_back(c.name());
    return names;
  };
  EXPECT_EQ(list(bound_[AccessRole::kRead]),
            std::vector<std::string>{"collections/mine"});
  EXPECT_EQ(
      list(free_[AccessRole::kRead]),
      (std::vector<std::string>{"collections/mine", "collections/other"}));
}

TEST_F(AccessMatrixTest, FollowsARevocation) {
  const MethodDescriptor* method =
      v1::GetServerInfoRequest::descriptor()->file()->service(0)->method(0);
  const auto request = RequestIn(*method, kMine);
  const std::string& key = free_[AccessRole::kRead];
  EXPECT_EQ(Call(*method, *request, key), "");
  keys_.erase("read");
  server_->rpc().SetKeys(std::make_shared<const KeyRing>(keys_));
  EXPECT_EQ(Call(*method, *request, key), "KEY_INVALID");
}

}  // namespace
}  // namespace argmesh
