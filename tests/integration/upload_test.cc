// ShapeService.UploadShape: what a stream of chunks may and may not do.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <string>

#include "core/base/sha256.h"
#include "tests/integration/server_fixture.h"

namespace argmesh {
namespace {

constexpr int64_t kMaxMeshBytes = 8 << 20;

class UploadTest : public ::testing::Test {
 protected:
  UploadTest() : server_(Options()) {}

  static TestServerOptions Options() {
    TestServerOptions options;
    options.engine.mesh_limits.max_bytes = kMaxMeshBytes;
    options.rpc.limits.stream_idle_timeout = absl::Milliseconds(400);
    options.rpc.limits.max_inflight_uploads = 2;
    return options;
  }

  void SetUp() override {
    server_.Start();
    server_.MakeCollection("c");
  }

  static v1::UploadShapeHeader Header(const std::string& bytes) {
    v1::UploadShapeHeader header;
    header.set_parent("collections/c");
    header.set_shape_id("s");
    header.set_format(v1::MESH_FORMAT_OFF);
    header.set_size_bytes(static_cast<int64_t>(bytes.size()));
    header.set_sha256(ToHex(ComputeSha256(bytes)));
    return header;
  }

  grpc::Status Upload(const v1::UploadShapeHeader& header,
                      const std::string& bytes, v1::Shape* response,
                      size_t chunk_bytes = 64 << 10) {
    grpc::ClientContext context;
    const auto writer = server_.shapes().UploadShape(&context, response);
    v1::UploadShapeRequest request;
    *request.mutable_header() = header;
    bool open = writer->Write(request);
    for (size_t at = 0; open && at < bytes.size(); at += chunk_bytes) {
      request.set_chunk(bytes.substr(at, chunk_bytes));
      open = writer->Write(request);
    }
    writer->WritesDone();
    return writer->Finish();
  }

  bool IsStored() {
    grpc::ClientContext context;
    v1::GetShapeRequest request;
    request.set_name("collections/c/shapes/s");
    v1::Shape shape;
    return server_.shapes().GetShape(&context, request, &shape).ok();
  }

  TestServer server_;
};

TEST_F(UploadTest, StoresAMeshLargerThanAMessage) {
  const std::string off = TorusOff() + std::string(6 << 20, '\n');
  v1::Shape shape;
  ASSERT_CALL_OK(Upload(Header(off), off, &shape, 1 << 20));
  EXPECT_EQ(shape.name(), "collections/c/shapes/s");
  EXPECT_EQ(shape.mesh().size_bytes(), static_cast<int64_t>(off.size()));
  EXPECT_EQ(shape.state(), v1::SHAPE_STATE_ACTIVE);
  EXPECT_GT(shape.graph().levels_size(), 0);
  EXPECT_TRUE(IsStored());
}

TEST_F(UploadTest, TakesChunksOfAnySize) {
  const std::string off = TorusOff();
  v1::Shape shape;
  ASSERT_CALL_OK(Upload(Header(off), off, &shape, 997));
  EXPECT_EQ(shape.mesh().sha256(), ToHex(ComputeSha256(off)));
}

TEST_F(UploadTest, StoresNothingWhenTheDigestIsAnother) {
  const std::string off = TorusOff();
  v1::UploadShapeHeader header = Header(off);
  header.set_sha256(ToHex(ComputeSha256("another")));
  v1::Shape shape;
  EXPECT_FAILS(Upload(header, off, &shape), INVALID_ARGUMENT,
               "MESH_DIGEST_MISMATCH");
  EXPECT_FALSE(IsStored());
}

TEST_F(UploadTest, StoresNothingWhenBytesAreMissingOrTooMany) {
  const std::string off = TorusOff();
  v1::Shape shape;
  EXPECT_FAILS(Upload(Header(off), off.substr(0, off.size() - 1), &shape),
               INVALID_ARGUMENT, "MESH_SIZE_MISMATCH");
  EXPECT_FAILS(Upload(Header(off), off + "\n", &shape), INVALID_ARGUMENT,
               "MESH_SIZE_MISMATCH");
  EXPECT_FALSE(IsStored());
}

TEST_F(UploadTest, RefusesAnAnnouncementBeforeTheBytes) {
  const std::string off = TorusOff();
  v1::Shape shape;
  v1::UploadShapeHeader header = Header(off);
  header.set_size_bytes(kMaxMeshBytes + 1);
  const grpc::Status too_large = Upload(header, "", &shape);
  EXPECT_FAILS(too_large, RESOURCE_EXHAUSTED, "MESH_TOO_LARGE");
  EXPECT_TRUE(ErrorOf(too_large).has_quota);
  header.set_size_bytes(0);
  EXPECT_FAILS(Upload(header, "", &shape), INVALID_ARGUMENT, "FIELD_INVALID");
  header = Header(off);
  header.set_sha256("abc");
  EXPECT_FAILS(Upload(header, "", &shape), INVALID_ARGUMENT, "FIELD_INVALID");
  header.clear_sha256();
  EXPECT_FAILS(Upload(header, "", &shape), INVALID_ARGUMENT, "FIELD_REQUIRED");
  header = Header(off);
  header.set_parent("collections/none");
  EXPECT_FAILS(Upload(header, "", &shape), NOT_FOUND, "COLLECTION_NOT_FOUND");
}

TEST_F(UploadTest, RefusesMessagesOutOfOrder) {
  v1::Shape shape;
  {
    grpc::ClientContext context;
    const auto writer = server_.shapes().UploadShape(&context, &shape);
    v1::UploadShapeRequest request;
    request.set_chunk("OFF");
    writer->Write(request);
    EXPECT_FAILS(writer->Finish(), INVALID_ARGUMENT, "STREAM_ORDER_INVALID");
  }
  {
    grpc::ClientContext context;
    const auto writer = server_.shapes().UploadShape(&context, &shape);
    v1::UploadShapeRequest request;
    *request.mutable_header() = Header("OFF");
    writer->Write(request);
    writer->Write(request);
    EXPECT_FAILS(writer->Finish(), INVALID_ARGUMENT, "STREAM_ORDER_INVALID");
  }
  {
    grpc::ClientContext context;
    const auto writer = server_.shapes().UploadShape(&context, &shape);
    writer->WritesDone();
    EXPECT_FAILS(writer->Finish(), INVALID_ARGUMENT, "STREAM_ORDER_INVALID");
  }
}

TEST_F(UploadTest, CutsASilentClientOffAndStoresNothing) {
  const std::string off = TorusOff();
  grpc::ClientContext context;
  v1::Shape shape;
  const auto writer = server_.shapes().UploadShape(&context, &shape);
  v1::UploadShapeRequest request;
  *request.mutable_header() = Header(off);
  writer->Write(request);
  request.set_chunk(off);  // all of it, but never half-closed
  writer->Write(request);
  EXPECT_FAILS(writer->Finish(), UNAVAILABLE, "STREAM_IDLE");
  EXPECT_FALSE(IsStored());
  EXPECT_TRUE(server_.Stop(absl::Seconds(5)));
}

TEST_F(UploadTest, ForgetsAnUploadThatIsCancelledInTheMiddle) {
  const std::string off = TorusOff();
  {
    grpc::ClientContext context;
    v1::Shape shape;
    const auto writer = server_.shapes().UploadShape(&context, &shape);
    v1::UploadShapeRequest request;
    *request.mutable_header() = Header(off);
    writer->Write(request);
    request.set_chunk(off.substr(0, 1000));
    writer->Write(request);
    context.TryCancel();
    EXPECT_EQ(writer->Finish().error_code(), grpc::StatusCode::CANCELLED);
  }
  EXPECT_TRUE(server_.Stop(absl::Seconds(5)));
  server_.Start();
  EXPECT_FALSE(IsStored());
}

TEST_F(UploadTest, RefusesUploadsBeyondItsLimitWhileOthersAreOpen) {
  const std::string off = TorusOff();
  grpc::ClientContext contexts[2];
  v1::Shape shapes[2];
  std::unique_ptr<grpc::ClientWriter<v1::UploadShapeRequest>> writers[2];
  for (int i = 0; i < 2; ++i) {
    writers[i] = server_.shapes().UploadShape(&contexts[i], &shapes[i]);
    v1::UploadShapeRequest request;
    *request.mutable_header() = Header(off);
    writers[i]->Write(request);
  }
  // The two may arrive later than a third: only a refusal counts.
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(5);
  ErrorOf error{grpc::Status::OK};
  while (error.reason != "OVERLOADED" &&
         std::chrono::steady_clock::now() < end) {
    v1::Shape shape;
    v1::UploadShapeHeader header = Header(off);
    header.set_shape_id("another");
    error = ErrorOf(Upload(header, "", &shape));
  }
  EXPECT_EQ(error.code, grpc::StatusCode::RESOURCE_EXHAUSTED) << error;
  EXPECT_EQ(error.reason, "OVERLOADED") << error;
  EXPECT_TRUE(error.has_retry);
  EXPECT_TRUE(error.has_quota);
  for (auto& context : contexts) context.TryCancel();
  for (auto& writer : writers) writer->Finish();
}

}  // namespace
}  // namespace argmesh
