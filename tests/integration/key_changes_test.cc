// Keys that change while a stream is open: its next message is checked against
// the keys as they are then.
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "absl/time/clock.h"
#include "tests/integration/server_fixture.h"

namespace argmesh {
namespace {

class KeyChangesTest : public ::testing::Test {
 protected:
  KeyChangesTest() {
    server_.Start();
    server_.MakeCollection("c");
    SetKey(Key());
  }

  ApiKey Key() const {
    ApiKey key;
    key.id = "writer";
    key.secret_sha256 = HashKeySecret(kSecret);
    key.role = AccessRole::kWrite;
    return key;
  }

  void SetKey(const ApiKey& key) {
    server_.rpc().SetKeys(
        std::make_shared<const KeyRing>(KeyRing{{key.id, key}}));
  }

  // How an ingest stream ends that sends a message more after `change`.
  template <typename Change>
  grpc::Status IngestAround(Change&& change) {
    grpc::ClientContext context;
    context.AddMetadata("authorization",
                        "Bearer " + KeyText("writer", kSecret));
    const auto stream = server_.ingest().IngestShapes(&context);
    v1::IngestShapesRequest request;
    request.mutable_hello()->set_collection("collections/c");
    stream->Write(request);
    v1::IngestShapesResponse response;
    EXPECT_TRUE(stream->Read(&response));  // it has been let in
    change();
    request.mutable_item()->set_key("an item that is none");
    stream->Write(request);
    stream->WritesDone();
    while (stream->Read(&response)) {
    }
    return stream->Finish();
  }

  const std::string kSecret = std::string(43, 's');
  TestServer server_;
};

TEST_F(KeyChangesTest, LeaveAStreamAloneThatStillMay) {
  EXPECT_TRUE(IngestAround([] {}).ok());
  EXPECT_TRUE(IngestAround([this] {
                ApiKey key = Key();
                key.collections = {"c"};
                SetKey(key);
              }).ok());
}

TEST_F(KeyChangesTest, EndAStreamWhoseKeyWasRevoked) {
  EXPECT_FAILS(IngestAround([this] {
                 server_.rpc().SetKeys(std::make_shared<const KeyRing>());
               }),
               UNAUTHENTICATED, "KEY_INVALID");
}

TEST_F(KeyChangesTest, EndAStreamWhoseKeyHasExpired) {
  EXPECT_FAILS(IngestAround([this] {
                 ApiKey key = Key();
                 key.expire_time = absl::Now();
                 SetKey(key);
               }),
               UNAUTHENTICATED, "KEY_EXPIRED");
}

TEST_F(KeyChangesTest, EndAStreamWhoseKeyMayLess) {
  EXPECT_FAILS(IngestAround([this] {
                 ApiKey key = Key();
                 key.role = AccessRole::kRead;
                 SetKey(key);
               }),
               PERMISSION_DENIED, "PERMISSION_DENIED");
}

TEST_F(KeyChangesTest, EndAStreamToACollectionThatTheKeyIsNotForAnyMore) {
  EXPECT_FAILS(IngestAround([this] {
                 ApiKey key = Key();
                 key.collections = {"another"};
                 SetKey(key);
               }),
               PERMISSION_DENIED, "PERMISSION_DENIED");
}

}  // namespace
}  // namespace argmesh
