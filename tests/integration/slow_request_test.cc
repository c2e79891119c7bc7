// Calls whose message does not come: what the server does with a call of which
// it has the headers only.
#include <gmock/gmock.h>
#include <grpcpp/generic/generic_stub.h>
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "absl/time/clock.h"
#include "core/access/key_file.h"
#include "tests/integration/gauge_wait.h"
#include "tests/integration/server_fixture.h"

namespace argmesh {
namespace {

constexpr char kGetShape[] = "/argmesh.v1.ShapeService/GetShape";
constexpr char kSearch[] = "/argmesh.v1.SearchService/SearchShapes";
constexpr char kDownload[] = "/argmesh.v1.ShapeService/DownloadMesh";

// A call that sends its headers and then nothing.
class SilentCall {
 public:
  SilentCall(const std::shared_ptr<grpc::Channel>& channel,
             const std::string& method)
      : stub_(channel) {
    context_.set_deadline(std::chrono::system_clock::now() +
                          std::chrono::seconds(20));
    stream_ = stub_.PrepareCall(&context_, method, &queue_);
    stream_->StartCall(nullptr);
    Wait();
  }
  ~SilentCall() {
    if (!ended_) Cancel();
    queue_.Shutdown();
  }

  // Half-closes without a message.
  void EndWithoutAMessage() {
    stream_->WritesDone(nullptr);
    Wait();
  }
  // Waits for the server to end it.
  ErrorOf End() {
    grpc::Status status;
    stream_->Finish(&status, nullptr);
    Wait();
    ended_ = true;
    return ErrorOf(status);
  }
  ErrorOf Cancel() {
    context_.TryCancel();
    return End();
  }

 private:
  void Wait() {
    void* tag = nullptr;
    bool ok = false;
    queue_.Next(&tag, &ok);
  }

  grpc::GenericStub stub_;
  grpc::ClientContext context_;
  grpc::CompletionQueue queue_;
  std::unique_ptr<grpc::GenericClientAsyncReaderWriter> stream_;
  bool ended_ = false;
};

std::shared_ptr<grpc::Channel> AnotherConnection(TestServer& server) {
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  return grpc::CreateCustomChannel(
      server.rpc().address(), grpc::InsecureChannelCredentials(), arguments);
}

TEST(SlowRequest, EndsWhenItsMessageDoesNotCome) {
  TestServerOptions options;
  options.rpc.limits.stream_idle_timeout = absl::Milliseconds(200);
  TestServer server(options);
  server.Start();
  for (const char* method : {kGetShape, kDownload}) {
    const ErrorOf error = SilentCall(server.channel(), method).End();
    EXPECT_EQ(error.code, grpc::StatusCode::UNAVAILABLE) << error;
    EXPECT_EQ(error.reason, "STREAM_IDLE") << method;
    EXPECT_TRUE(error.has_retry);
  }
  WaitForGauge(server, "argmesh_calls_in_flight", 0);
}

TEST(SlowRequest, WithoutAMessageIsRefused) {
  TestServer server;
  server.Start();
  for (const char* method : {kGetShape, kDownload}) {
    SilentCall call(server.channel(), method);
    call.EndWithoutAMessage();
    const ErrorOf error = call.End();
    EXPECT_EQ(error.code, grpc::StatusCode::INVALID_ARGUMENT) << error;
    EXPECT_EQ(error.reason, "STREAM_ORDER_INVALID") << method;
  }
}

TEST(SlowRequest, OfWhoMayNotMakeItIsRefusedAtOnce) {
  TestServer server;
  server.Start();
  server.rpc().SetKeys(std::make_shared<const KeyRing>());
  const ErrorOf error = SilentCall(server.channel(), kGetShape).End();
  EXPECT_EQ(error.reason, "KEY_MISSING") << error;
}

TEST(SlowRequest, TakesNoPlaceOfAnother) {
  TestServerOptions options;
  options.rpc.limits.max_inflight_searches = 1;
  TestServer server(options);
  server.Start();
  server.MakeCollection("c");
  server.AddShape("c", "torus", TorusOff());
  SilentCall silent(server.channel(), kSearch);
  WaitForGauge(server, "argmesh_calls_in_flight", 1);
  v1::SearchShapesRequest request;
  request.set_parent("collections/c");
  request.set_shape("collections/c/shapes/torus");
  grpc::ClientContext context;
  v1::SearchShapesResponse response;
  ASSERT_CALL_OK(server.search().SearchShapes(&context, request, &response));
  EXPECT_EQ(silent.Cancel().code, grpc::StatusCode::CANCELLED);
  WaitForGauge(server, "argmesh_calls_in_flight", 0);
}

TEST(SlowRequest, DoesNotHoldUpTheEndOfTheServer) {
  TestServer server;
  server.Start();
  SilentCall silent(server.channel(), kGetShape);
  WaitForGauge(server, "argmesh_calls_in_flight", 1);
  EXPECT_TRUE(server.rpc().Shutdown(absl::Now() + absl::Seconds(20)));
  const ErrorOf error = silent.End();
  EXPECT_EQ(error.reason, "DRAINING") << error;
}

TEST(SlowRequest, IsCutWhereItsConnectionHasTheMostAndAllAreTooMany) {
  TestServer server;
  server.Start();
  const auto one = AnotherConnection(server);
  SilentCall other(one, kGetShape);
  constexpr auto kMost =
      static_cast<size_t>(kMaxSlowRequestBytes / kMaxMessageBytes);
  std::vector<std::unique_ptr<SilentCall>> calls;
  for (size_t i = 0; i < kMost; ++i) {
    calls.push_back(std::make_unique<SilentCall>(server.channel(), kGetShape));
  }
  WaitForGauge(server, "argmesh_slow_requests_cut_total", 1);
  WaitForGauge(server, "argmesh_slow_request_bytes",
               static_cast<double>(kMaxSlowRequestBytes));
  WaitForGauge(server, "argmesh_calls_in_flight", kMost);
  EXPECT_EQ(other.Cancel().code, grpc::StatusCode::CANCELLED)
      << "it is not cut";
}

}  // namespace
}  // namespace argmesh
