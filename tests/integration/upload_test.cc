// ShapeService.UploadShape: what a stream of chunks may and may not do.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <future>
#include <string>
#include <thread>
#include <vector>

#include "absl/synchronization/notification.h"
#include "core/base/sha256.h"
#include "tests/integration/server_fixture.h"

namespace argmesh {
namespace {

constexpr int64_t kMaxMeshBytes = 8 << 20;

TestServerOptions UploadTestOptions() {
  TestServerOptions options;
  options.engine.mesh_limits.max_bytes = kMaxMeshBytes;
  options.rpc.limits.stream_idle_timeout = absl::Milliseconds(400);
  options.rpc.limits.max_inflight_uploads = 2;
  return options;
}

v1::UploadShapeHeader Header(const std::string& bytes) {
  v1::UploadShapeHeader header;
  header.set_parent("collections/c");
  header.set_shape_id("s");
  header.set_format(v1::MESH_FORMAT_OFF);
  header.set_size_bytes(static_cast<int64_t>(bytes.size()));
  header.set_sha256(ToHex(ComputeSha256(bytes)));
  return header;
}

class UploadTest : public ::testing::Test {
 protected:
  UploadTest() : server_(UploadTestOptions()) {}

  void SetUp() override {
    server_.Start();
    server_.MakeCollection("c");
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

TEST_F(UploadTest, CutsAClientThatTricklesOff) {
  grpc::ClientContext context;
  v1::Shape shape;
  const auto writer = server_.shapes().UploadShape(&context, &shape);
  v1::UploadShapeRequest request;
  *request.mutable_header() = Header(TorusOff());
  // Each well before the idle timeout.
  while (writer->Write(request)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    request.set_chunk("O");
  }
  EXPECT_FAILS(writer->Finish(), UNAVAILABLE, "STREAM_IDLE");
}

TEST(UploadLimitTest, RefusesOneUploadMoreThanItsLimit) {
  TestServerOptions options = UploadTestOptions();
  options.rpc.limits.stream_idle_timeout = absl::Minutes(5);
  TestServer server(options);
  server.Start();
  server.MakeCollection("c");
  // Any of the three may arrive last; the two others stay open until then.
  grpc::ClientContext contexts[3];
  std::vector<std::future<grpc::Status>> uploads;
  absl::Notification ended;
  std::atomic<bool> is_first{true};
  for (grpc::ClientContext& context : contexts) {
    uploads.push_back(std::async(std::launch::async, [&] {
      v1::Shape shape;
      const auto writer = server.shapes().UploadShape(&context, &shape);
      v1::UploadShapeRequest request;
      *request.mutable_header() = Header(TorusOff());
      writer->Write(request);
      const grpc::Status status = writer->Finish();
      if (is_first.exchange(false)) ended.Notify();
      return status;
    }));
  }
  EXPECT_TRUE(ended.WaitForNotificationWithTimeout(absl::Minutes(1)));
  for (auto& context : contexts) context.TryCancel();
  int refused = 0;
  for (auto& upload : uploads) {
    const grpc::Status status = upload.get();
    if (status.error_code() == grpc::StatusCode::CANCELLED) continue;
    const ErrorOf error{status};
    EXPECT_EQ(error.code, grpc::StatusCode::RESOURCE_EXHAUSTED) << error;
    EXPECT_EQ(error.reason, "OVERLOADED") << error;
    EXPECT_TRUE(error.has_retry);
    EXPECT_TRUE(error.has_quota);
    ++refused;
  }
  EXPECT_EQ(refused, 1);
}

}  // namespace
}  // namespace argmesh
