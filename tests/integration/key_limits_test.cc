// Limits of API keys over the wire: who reaches them waits, nobody else does.
#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "tests/integration/generic_call.h"
#include "tests/integration/server_fixture.h"

namespace argmesh {
namespace {

class KeyLimitsTest : public ::testing::Test {
 protected:
  KeyLimitsTest() {
    server_.Start();
    server_.MakeCollection("c");
  }

  // Two keys; the first with the limits.
  void SetLimits(const KeyLimits& limits) {
    KeyRing ring;
    for (const char* id : {"limited", "other"}) {
      ApiKey& key = ring[id];
      key.id = id;
      key.secret_sha256 = HashKeySecret(kSecret);
      key.role = AccessRole::kWrite;
    }
    ring["limited"].limits = limits;
    server_.rpc().SetKeys(std::make_shared<const KeyRing>(ring));
  }

  grpc::Status Get(const std::string& id) {
    v1::GetCollectionRequest request;
    request.set_name("collections/c");
    return CallGenerically(server_.channel(),
                           "/argmesh.v1.CollectionService/GetCollection",
                           request, KeyText(id, kSecret));
  }

  static void ExpectLimited(const grpc::Status& status,
                            const std::string& limit) {
    EXPECT_FAILS(status, RESOURCE_EXHAUSTED, "KEY_LIMIT_EXCEEDED");
    ErrorOf error(status);
    EXPECT_TRUE(error.has_retry);
    EXPECT_TRUE(error.has_quota);
    EXPECT_EQ(error.metadata["limit"], limit);
    EXPECT_EQ(error.metadata["principal"], "limited");
  }

  const std::string kSecret = std::string(43, 's');
  TestServer server_;
};

TEST_F(KeyLimitsTest, RefuseCallsBeyondTheBurstUntilTheLimitIsRaised) {
  SetLimits({.requests_per_second = 0.001, .burst = 2, .concurrent_calls = 0});
  ASSERT_CALL_OK(Get("limited"));
  ASSERT_CALL_OK(Get("limited"));
  ExpectLimited(Get("limited"), "requests_per_second");
  for (int i = 0; i < 5; ++i) ASSERT_CALL_OK(Get("other"));
  SetLimits({});
  for (int i = 0; i < 5; ++i) ASSERT_CALL_OK(Get("limited"));
}

TEST_F(KeyLimitsTest, CountAStreamUntilItHasEnded) {
  SetLimits({.requests_per_second = 0, .burst = 0, .concurrent_calls = 1});
  grpc::ClientContext context;
  context.AddMetadata("authorization", "Bearer " + KeyText("limited", kSecret));
  const auto stream = server_.ingest().IngestShapes(&context);
  v1::IngestShapesRequest hello;
  hello.mutable_hello()->set_collection("collections/c");
  stream->Write(hello);
  v1::IngestShapesResponse credit;
  ASSERT_TRUE(stream->Read(&credit));  // it has been let in
  ExpectLimited(Get("limited"), "concurrent_calls");
  ASSERT_CALL_OK(Get("other"));
  stream->WritesDone();
  while (stream->Read(&credit)) {
  }
  ASSERT_CALL_OK(stream->Finish());
  for (int i = 0; i < 5; ++i) ASSERT_CALL_OK(Get("limited"));
}

}  // namespace
}  // namespace argmesh
