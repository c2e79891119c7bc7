// Calls whose answers are not taken: no more is made for their connection
// meanwhile, and nothing is lost to who takes them in the end.
#include <gmock/gmock.h>
#include <grpcpp/generic/generic_stub.h>
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "tests/integration/gauge_wait.h"
#include "tests/integration/server_fixture.h"

namespace argmesh {
namespace {

using ::testing::AllOf;
using ::testing::Gt;
using ::testing::Lt;

constexpr int kCalls = 40;
constexpr int kShapesOfACall = 70;
constexpr char kPostponedBytes[] = "argmesh_postponed_request_bytes";
constexpr char kOverloaded[] = "8 OVERLOADED";
constexpr char kDraining[] = "14 DRAINING";

// Lets 64 KiB of an answer come before it is taken.
std::shared_ptr<grpc::Channel> SmallWindow(const std::string& address) {
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_HTTP2_BDP_PROBE, 0);
  arguments.SetInt(GRPC_ARG_HTTP2_STREAM_LOOKAHEAD_BYTES, 1 << 16);
  return grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(),
                                   arguments);
}

// Many calls of one connection, each with an answer of a megabyte.
class ManyCalls {
 public:
  explicit ManyCalls(TestServer& server)
      : stub_(SmallWindow(server.rpc().address())) {
    v1::BatchGetShapesRequest request;
    request.set_parent("collections/parts");
    for (int i = 0; i < kShapesOfACall; ++i) {
      request.add_names("collections/parts/shapes/large");
    }
    const grpc::Slice slice(request.SerializeAsString());
    const grpc::ByteBuffer message(&slice, 1);
    for (int i = 0; i < kCalls; ++i) {
      Call& call = *calls_.emplace_back(std::make_unique<Call>());
      call.context.set_deadline(
          absl::ToChronoTime(absl::Now() + absl::Seconds(60)));
      call.stream = stub_.PrepareCall(
          &call.context, "/argmesh.v1.ShapeService/BatchGetShapes", &queue_);
      call.stream->StartCall(nullptr);
      AwaitOperations(1);
      call.stream->Write(message, grpc::WriteOptions().set_last_message(),
                         nullptr);
      AwaitOperations(1);
    }
  }
  ~ManyCalls() { queue_.Shutdown(); }

  // How each ended, once all have: "OK" with the whole answer, or the reason.
  std::vector<std::string> Take() {
    for (const auto& call : calls_) call->stream->Read(&call->answer, nullptr);
    AwaitOperations(kCalls);
    for (const auto& call : calls_)
      call->stream->Finish(&call->status, nullptr);
    AwaitOperations(kCalls);
    std::vector<std::string> ends;
    for (const auto& call : calls_) {
      const ErrorOf error(call->status);
      ends.push_back(call->status.ok()
                         ? call->answer.Length() > 1'000'000 ? "OK" : "cut"
                         : absl::StrCat(error.code, " ", error.reason));
    }
    return ends;
  }
  void Cancel() {
    for (const auto& call : calls_) call->context.TryCancel();
  }

 private:
  struct Call {
    grpc::ClientContext context;
    grpc::ByteBuffer answer;
    grpc::Status status;
    std::unique_ptr<grpc::GenericClientAsyncReaderWriter> stream;
  };

  void AwaitOperations(int count) {
    void* tag = nullptr;
    bool ok = false;
    for (int i = 0; i < count; ++i) queue_.Next(&tag, &ok);
  }

  grpc::GenericStub stub_;
  grpc::CompletionQueue queue_;
  std::vector<std::unique_ptr<Call>> calls_;
};

class UnreadAnswersTest : public testing::Test {
 protected:
  // Fewer threads than calls.
  void SetUp() override {
    TestServerOptions options;
    options.engine.pool.threads = {2, 1, 2, 2};
    server_ = std::make_unique<TestServer>(options);
    server_->Start();
    server_->MakeCollection("parts");
    std::map<std::string, std::string> notes;
    for (int i = 0; i < 15; ++i) {
      notes[absl::StrCat("note", i)] = std::string(1000, 'n');
    }
    server_->AddShape("parts", "large", TorusOff(), notes);
  }

  std::unique_ptr<TestServer> server_;
};

TEST_F(UnreadAnswersTest, AreAllThereForWhoTakesThemLate) {
  ManyCalls calls(*server_);
  WaitForGauge(*server_, kPostponedBytes, Gt(0));
  absl::SleepFor(absl::Milliseconds(300));
  // The room, and one more for each thread.
  EXPECT_THAT(GaugeOf(*server_, "argmesh_unread_answer_bytes"),
              AllOf(Gt(1e6), Lt(5e6)));
  EXPECT_THAT(calls.Take(), testing::Each("OK"));
  WaitForGauge(*server_, kPostponedBytes, 0);
}

TEST_F(UnreadAnswersTest, EndTheCallsThatWaitForThemWhenNobodyTakesThem) {
  ServiceLimits limits;
  limits.stream_idle_timeout = absl::Milliseconds(300);
  server_->rpc().SetLimits(limits);
  ManyCalls calls(*server_);
  WaitForGauge(*server_, kPostponedBytes, Gt(0));
  WaitForGauge(*server_, "argmesh_calls_in_flight", 0);
  EXPECT_EQ(GaugeOf(*server_, kPostponedBytes), 0);
  EXPECT_THAT(calls.Take(), testing::Contains(kOverloaded));
}

TEST_F(UnreadAnswersTest, KeepNoCallThatIsCancelled) {
  ManyCalls calls(*server_);
  WaitForGauge(*server_, kPostponedBytes, Gt(0));
  calls.Cancel();
  calls.Take();
  WaitForGauge(*server_, "argmesh_calls_in_flight", 0);
  EXPECT_EQ(GaugeOf(*server_, kPostponedBytes), 0);
  EXPECT_EQ(GaugeOf(*server_, "argmesh_unread_answer_bytes"), 0);
}

TEST_F(UnreadAnswersTest, DoNotHoldUpADrain) {
  ManyCalls calls(*server_);
  WaitForGauge(*server_, kPostponedBytes, Gt(0));
  std::thread shutdown([this] {
    EXPECT_TRUE(server_->rpc().Shutdown(absl::Now() + absl::Seconds(20)));
  });
  // Nobody takes anything until all that wait have been told.
  WaitForGauge(*server_, "argmesh_draining", Gt(0));
  absl::SleepFor(absl::Milliseconds(300));
  const std::vector<std::string> ends = calls.Take();
  shutdown.join();
  EXPECT_THAT(ends, testing::Contains(kDraining));
  EXPECT_THAT(ends, testing::Each(testing::AnyOf("OK", kDraining)));
}

}  // namespace
}  // namespace argmesh
