// The server as a process sees it: health, reflection, limits, going down.
#include <gmock/gmock.h>
#include <grpcpp/generic/generic_stub.h>
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "tests/integration/server_fixture.h"

namespace argmesh {
namespace {

using ::testing::HasSubstr;

// Health and reflection have no generated code here: their messages are one
// string field 1 (the service) and one enum field 1 (SERVING is 1).
class RawCall {
 public:
  explicit RawCall(const std::shared_ptr<grpc::Channel>& channel)
      : stub_(channel) {}

  grpc::Status Unary(const std::string& method, const std::string& request,
                     std::string* response) {
    grpc::ClientContext context;
    grpc::CompletionQueue queue;
    grpc::Slice slice(request);
    const grpc::ByteBuffer message(&slice, 1);
    const auto call = stub_.PrepareUnaryCall(&context, method, message, &queue);
    call->StartCall();
    grpc::ByteBuffer answer;
    grpc::Status status;
    int tag = 0;
    call->Finish(&answer, &status, &tag);
    void* done = nullptr;
    bool ok = false;
    queue.Next(&done, &ok);
    std::vector<grpc::Slice> slices;
    if (status.ok() && answer.Dump(&slices).ok()) {
      for (const auto& part : slices) {
        response->append(reinterpret_cast<const char*>(part.begin()),
                         part.size());
      }
    }
    return status;
  }

  // "SERVING", "NOT_SERVING" or the code of the failure.
  std::string Health(const std::string& service) {
    std::string request;
    if (!service.empty()) {
      request =
          std::string("\x0a") + static_cast<char>(service.size()) + service;
    }
    std::string response;
    const grpc::Status status =
        Unary("/grpc.health.v1.Health/Check", request, &response);
    if (!status.ok()) return "code " + std::to_string(status.error_code());
    return response == std::string("\x08\x01", 2) ? "SERVING" : "NOT_SERVING";
  }

 private:
  grpc::GenericStub stub_;
};

TEST(Lifecycle, TellsTheHealthOfEveryService) {
  TestServer server;
  server.Start();
  RawCall raw(server.channel());
  for (const char* name :
       {"", "argmesh.v1.SearchService", "argmesh.v1.CollectionService",
        "argmesh.v1.ShapeService", "argmesh.v1.IngestService",
        "argmesh.v1.AdminService", "liveness"}) {
    EXPECT_EQ(raw.Health(name), "SERVING") << name;
  }
  EXPECT_EQ(raw.Health("argmesh.v1.NoSuchService"), "code 5");
  server.rpc().StopAdvertising();
  EXPECT_EQ(raw.Health(""), "NOT_SERVING");
  EXPECT_EQ(raw.Health("argmesh.v1.SearchService"), "NOT_SERVING");
  EXPECT_EQ(raw.Health("argmesh.v1.IngestService"), "NOT_SERVING");
  EXPECT_EQ(raw.Health("liveness"), "SERVING");
  // Not advertised, but calls still come in.
  grpc::ClientContext context;
  v1::GetServerInfoResponse response;
  ASSERT_CALL_OK(server.admin().GetServerInfo(&context, {}, &response));
}

TEST(Lifecycle, ServesReflectionOnlyWhenAsked) {
  for (const bool reflection : {true, false}) {
    TestServerOptions options;
    options.rpc.reflection = reflection;
    TestServer server(options);
    server.Start();
    RawCall raw(server.channel());
    std::string response;
    // list_services is field 7, a string.
    const grpc::Status status = raw.Unary(
        "/grpc.reflection.v1alpha.ServerReflection/ServerReflectionInfo",
        std::string("\x3a\x01*", 3), &response);
    EXPECT_EQ(status.ok(), reflection) << status.error_message();
    if (reflection) {
      EXPECT_THAT(response, HasSubstr("argmesh.v1.SearchService"));
    } else {
      EXPECT_EQ(status.error_code(), grpc::StatusCode::UNIMPLEMENTED);
    }
  }
}

TEST(Lifecycle, TellsWhatItIsAndWhatItTakes) {
  TestServerOptions options;
  options.engine.mesh_limits.max_bytes = 12345;
  options.rpc.limits.max_inflight_searches = 17;
  TestServer server(options);
  server.Start();
  server.MakeCollection("c");
  server.AddShape("c", "s",
                  "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n"
                  "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 0 3 2\n");
  grpc::ClientContext context;
  v1::GetServerInfoResponse info;
  ASSERT_CALL_OK(server.admin().GetServerInfo(&context, {}, &info));
  EXPECT_EQ(info.version(), "test");
  EXPECT_EQ(info.limits().max_mesh_bytes(), 12345);
  EXPECT_EQ(info.limits().max_inflight_searches(), 17);
  EXPECT_EQ(info.limits().max_message_bytes(), 4 << 20);
  // The call itself; gRPC may not be done with the one before.
  EXPECT_GE(info.calls_in_flight(), 1);
  EXPECT_LE(info.calls_in_flight(), 2);
  EXPECT_EQ(info.collection_count(), 1);
  EXPECT_EQ(info.shape_count(), 1);
  EXPECT_FALSE(info.draining());
}

TEST(Lifecycle, NeverSharesItsPort) {
  TestServer first;
  first.Start();
  RpcServerOptions options;
  options.listen = first.rpc().address();
  std::ostringstream text;
  const auto telemetry = Telemetry::Open({}, text);
  ASSERT_TRUE(telemetry.ok()) << telemetry.status();
  const auto second = RpcServer::Start(options, first.engine(), **telemetry);
  ASSERT_FALSE(second.ok());
  EXPECT_EQ(second.status().code(), absl::StatusCode::kUnavailable);
  EXPECT_THAT(std::string(second.status().message()),
              HasSubstr(first.rpc().address()));
}

TEST(Lifecycle, RefusesToBeReachedFromElsewhereUnlessToldSo) {
  RpcServerOptions options;
  options.listen = "0.0.0.0:0";
  const absl::Status refused = CheckListenAddress(options);
  EXPECT_EQ(refused.code(), absl::StatusCode::kInvalidArgument);
  EXPECT_THAT(std::string(refused.message()), HasSubstr("--insecure-remote"));
  options.insecure_remote = true;
  EXPECT_TRUE(CheckListenAddress(options).ok());
}

// Until the server has begun `count` pieces of work of the class.
void WaitForWork(TestServer& server, WorkClass work_class, int64_t count) {
  while (server.engine().pool().Load(work_class).admitted < count) {
    std::this_thread::yield();
  }
}

// An upload that the server has begun and that goes no further.
std::unique_ptr<grpc::ClientWriter<v1::UploadShapeRequest>> OpenUpload(
    TestServer& server, grpc::ClientContext* context, v1::Shape* shape) {
  const int64_t before =
      server.engine().pool().Load(WorkClass::kQuick).admitted;
  auto upload = server.shapes().UploadShape(context, shape);
  v1::UploadShapeRequest request;
  v1::UploadShapeHeader& header = *request.mutable_header();
  header.set_parent("collections/c");
  header.set_shape_id("s");
  header.set_size_bytes(1000);
  header.set_sha256(std::string(64, '0'));
  EXPECT_TRUE(upload->Write(request));
  WaitForWork(server, WorkClass::kQuick, before + 1);
  return upload;
}

TEST(Lifecycle, FinishesTheCallInFlightAndRefusesTheNext) {
  TestServer server;
  server.Start();
  server.MakeCollection("c");
  v1::CreateShapeRequest request;
  request.set_parent("collections/c");
  request.set_shape_id("s");
  request.mutable_mesh()->set_data(SphereOff(120));
  grpc::Status in_flight;
  std::thread caller([&] {
    grpc::ClientContext context;
    v1::Shape shape;
    in_flight = server.shapes().CreateShape(&context, request, &shape);
  });
  WaitForWork(server, WorkClass::kCompute, 1);
  EXPECT_TRUE(server.rpc().Shutdown(absl::Now() + absl::Seconds(30)));
  caller.join();
  EXPECT_TRUE(in_flight.ok()) << ErrorOf(in_flight);
  grpc::ClientContext context;
  v1::GetServerInfoResponse info;
  EXPECT_EQ(server.admin().GetServerInfo(&context, {}, &info).error_code(),
            grpc::StatusCode::UNAVAILABLE);
}

TEST(Lifecycle, RefusesNewCallsWithAReasonWhileItDrains) {
  TestServer server;
  server.Start();
  server.MakeCollection("c");
  // An upload that stays open keeps the server draining.
  grpc::ClientContext upload_context;
  v1::Shape shape;
  const auto upload = OpenUpload(server, &upload_context, &shape);
  std::thread stopper(
      [&] { server.rpc().Shutdown(absl::Now() + absl::Seconds(20)); });
  ErrorOf error{grpc::Status::OK};
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (error.reason.empty() && std::chrono::steady_clock::now() < end) {
    grpc::ClientContext context;
    v1::GetServerInfoResponse info;
    error = ErrorOf(server.admin().GetServerInfo(&context, {}, &info));
  }
  EXPECT_EQ(error.code, grpc::StatusCode::UNAVAILABLE) << error;
  EXPECT_EQ(error.reason, "DRAINING") << error;
  EXPECT_TRUE(error.has_retry);
  upload_context.TryCancel();
  upload->Finish();
  stopper.join();
}

TEST(Lifecycle, CutsCallsOffWhenTheGraceIsOver) {
  TestServer server;
  server.Start();
  server.MakeCollection("c");
  grpc::ClientContext context;
  v1::Shape shape;
  const auto upload = OpenUpload(server, &context, &shape);
  EXPECT_FALSE(server.rpc().Shutdown(absl::Now() + absl::Milliseconds(100)));
  EXPECT_FALSE(upload->Finish().ok());
}

TEST(Lifecycle, SurvivesBytesThatAreNoMessage) {
  TestServer server;
  server.Start();
  grpc::ClientContext context;
  std::string response;
  RawCall raw(server.channel());
  const grpc::Status status =
      raw.Unary("/argmesh.v1.ShapeService/GetShape", "\xff\xff\xff", &response);
  EXPECT_FAILS(status, INVALID_ARGUMENT, "STREAM_ORDER_INVALID");
  // The server still serves.
  v1::GetServerInfoResponse info;
  ASSERT_CALL_OK(server.admin().GetServerInfo(&context, {}, &info));
}

}  // namespace
}  // namespace argmesh
