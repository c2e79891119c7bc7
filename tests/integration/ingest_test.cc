// IngestService.IngestShapes: one result for every item, whatever happens.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <utility>

#include "core/base/sha256.h"
#include "tests/integration/server_fixture.h"

namespace argmesh {
namespace {

using Stream =
    grpc::ClientReaderWriter<v1::IngestShapesRequest, v1::IngestShapesResponse>;

// A client that sends, and files what comes back.
class IngestStream {
 public:
  explicit IngestStream(TestServer& server) : IngestStream(server.ingest()) {}
  explicit IngestStream(v1::IngestService::Stub& ingest)
      : stream_(ingest.IngestShapes(&context_)) {}

  bool Hello(const std::string& collection, bool create_if_absent = false) {
    v1::IngestShapesRequest request;
    request.mutable_hello()->set_collection(collection);
    request.mutable_hello()->set_create_if_absent(create_if_absent);
    return Write(request);
  }

  static v1::IngestItem Item(const std::string& key, const std::string& bytes) {
    v1::IngestItem item;
    item.set_key(key);
    item.set_shape_id(key);
    item.set_size_bytes(static_cast<int64_t>(bytes.size()));
    item.set_sha256(ToHex(ComputeSha256(bytes)));
    return item;
  }

  bool Send(const v1::IngestItem& item) {
    v1::IngestShapesRequest request;
    *request.mutable_item() = item;
    return Write(request);
  }

  bool SendChunk(const std::string& bytes) {
    v1::IngestShapesRequest request;
    request.set_chunk(bytes);
    return Write(request);
  }

  bool SendAll(const std::string& key, const std::string& bytes) {
    return Send(Item(key, bytes)) && SendChunk(bytes.substr(0, 1000)) &&
           SendChunk(bytes.substr(1000));  // at most a message
  }

  bool Write(const v1::IngestShapesRequest& request) {
    return stream_->Write(request);
  }

  // One message; false at the end.
  bool Read() {
    v1::IngestShapesResponse response;
    if (!stream_->Read(&response)) return false;
    if (response.has_credit()) {
      credit_items += response.credit().items();
      credit_bytes += response.credit().bytes();
    } else if (response.has_go_away()) {
      go_away = true;
    } else {
      EXPECT_TRUE(
          results.emplace(response.result().key(), response.result()).second)
          << "a second result of " << response.result().key();
    }
    return true;
  }

  void HalfClose() {
    if (!std::exchange(half_closed_, true)) stream_->WritesDone();
  }

  grpc::Status Finish() {
    HalfClose();
    while (Read()) {
    }
    return stream_->Finish();
  }

  grpc::ClientContext& context() { return context_; }

  int64_t credit_items = 0;  // received in all
  int64_t credit_bytes = 0;
  bool go_away = false;
  std::map<std::string, v1::IngestItemResult> results;

 private:
  bool half_closed_ = false;
  grpc::ClientContext context_;
  std::unique_ptr<Stream> stream_;
};

class IngestTest : public ::testing::Test {
 protected:
  IngestTest() : server_(Options()) {}

  static TestServerOptions Options() {
    TestServerOptions options;
    options.rpc.limits.stream_idle_timeout = absl::Milliseconds(1500);
    options.rpc.limits.ingest_credit_items = 3;
    options.rpc.limits.ingest_credit_bytes = 1 << 20;
    options.engine.mesh_limits.max_bytes = 4 << 20;
    return options;
  }

  void SetUp() override {
    server_.Start();
    server_.MakeCollection("c");
  }

  int CountShapes() {
    grpc::ClientContext context;
    v1::GetCollectionRequest request;
    request.set_name("collections/c");
    v1::Collection collection;
    EXPECT_TRUE(server_.collections()
                    .GetCollection(&context, request, &collection)
                    .ok());
    return static_cast<int>(collection.shape_count());
  }

  TestServer server_;
};

TEST_F(IngestTest, StoresManyShapesWithinItsCredit) {
  IngestStream stream(server_);
  ASSERT_TRUE(stream.Hello("collections/c"));
  ASSERT_TRUE(stream.Read());
  EXPECT_EQ(stream.credit_items, 3);
  EXPECT_EQ(stream.credit_bytes, 1 << 20);
  constexpr int kItems = 8;
  int64_t sent_bytes = 0;
  for (int i = 0; i < kItems; ++i) {
    while (stream.credit_items <= i) ASSERT_TRUE(stream.Read());
    const std::string off = TorusOff(0.2 + 0.05 * i);
    sent_bytes += static_cast<int64_t>(off.size());
    ASSERT_TRUE(stream.SendAll("t" + std::to_string(i), off));
  }
  ASSERT_CALL_OK(stream.Finish());
  ASSERT_EQ(stream.results.size(), static_cast<size_t>(kItems));
  for (const auto& [key, result] : stream.results) {
    ASSERT_TRUE(result.has_shape()) << key << ErrorOf(result.error());
    EXPECT_EQ(result.shape().name(), "collections/c/shapes/" + key);
    EXPECT_FALSE(result.already_stored());
  }
  EXPECT_EQ(CountShapes(), kItems);
  // No credit is made up: what was granted beyond the window came back.
  EXPECT_LE(stream.credit_items, 3 + kItems);
  EXPECT_LE(stream.credit_bytes, (1 << 20) + sent_bytes);
}

TEST_F(IngestTest, AnswersABadItemAmongGoodOnesWithItsReason) {
  const std::string good = TorusOff();
  IngestStream stream(server_);
  ASSERT_TRUE(stream.Hello("collections/c"));
  int64_t sent = 0;
  const auto begin = [&](const v1::IngestItem& item) {
    while (stream.credit_items <= sent) ASSERT_TRUE(stream.Read());
    ++sent;
    ASSERT_TRUE(stream.Send(item));
  };
  begin(IngestStream::Item("first", good));
  stream.SendChunk(good);

  begin(IngestStream::Item("malformed", "OFF\n3 1 0\n0 0 0\n"));
  stream.SendChunk("OFF\n3 1 0\n0 0 0\n");

  v1::IngestItem item = IngestStream::Item("digest", good);
  item.set_sha256(std::string(64, '0'));
  begin(item);
  stream.SendChunk(good);

  item = IngestStream::Item("too-large", good);
  item.set_size_bytes(5 << 20);
  begin(item);
  stream.SendChunk("these bytes are dropped");

  begin(IngestStream::Item("too-long", good));
  stream.SendChunk(good + "more than announced");
  stream.SendChunk("and more");

  begin(IngestStream::Item("cut-short", good));
  stream.SendChunk(good.substr(0, 100));

  item = IngestStream::Item("bad-id", good);
  item.set_shape_id("Bad Id");
  begin(item);

  begin(IngestStream::Item("last", good));
  stream.SendChunk(good);
  ASSERT_CALL_OK(stream.Finish());

  const std::map<std::string, std::string> reasons = {
      {"malformed", "MESH_MALFORMED"},     {"digest", "MESH_DIGEST_MISMATCH"},
      {"too-large", "MESH_TOO_LARGE"},     {"too-long", "MESH_SIZE_MISMATCH"},
      {"cut-short", "MESH_SIZE_MISMATCH"}, {"bad-id", "NAME_INVALID"}};
  for (const auto& [key, reason] : reasons) {
    ASSERT_TRUE(stream.results.contains(key)) << key;
    const ErrorOf error(stream.results[key].error());
    EXPECT_EQ(error.reason, reason) << key << ": " << error;
    EXPECT_NE(error.code, grpc::StatusCode::OK) << key;
  }
  EXPECT_TRUE(stream.results["first"].has_shape());
  EXPECT_TRUE(stream.results["last"].has_shape());
  EXPECT_EQ(stream.results.size(), reasons.size() + 2);
  EXPECT_EQ(CountShapes(), 2);
}

TEST_F(IngestTest, TellsDuplicatesApartFromConflicts) {
  const std::string torus = TorusOff();
  const v1::Shape stored = server_.AddShape("c", "same", torus);
  server_.AddShape("c", "other", DumbbellOff());
  IngestStream stream(server_);
  ASSERT_TRUE(stream.Hello("collections/c"));
  ASSERT_TRUE(stream.Read());
  v1::IngestItem item = IngestStream::Item("same", torus);
  item.set_existing_shape_policy(v1::EXISTING_SHAPE_POLICY_ACCEPT_SAME_MESH);
  stream.Send(item);
  stream.SendChunk(torus);
  item = IngestStream::Item("other", torus);
  item.set_existing_shape_policy(v1::EXISTING_SHAPE_POLICY_ACCEPT_SAME_MESH);
  stream.Send(item);
  stream.SendChunk(torus);
  item = IngestStream::Item("refused", torus);
  item.set_shape_id("same");
  stream.Send(item);
  stream.SendChunk(torus);
  ASSERT_CALL_OK(stream.Finish());
  EXPECT_TRUE(stream.results["same"].already_stored());
  EXPECT_EQ(stream.results["same"].shape().uid(), stored.uid());
  EXPECT_EQ(ErrorOf(stream.results["other"].error()).reason, "SHAPE_EXISTS");
  EXPECT_EQ(ErrorOf(stream.results["refused"].error()).reason, "SHAPE_EXISTS");
}

TEST_F(IngestTest, MakesTheCollectionWhenAsked) {
  {
    IngestStream stream(server_);
    stream.Hello("collections/new");
    EXPECT_FAILS(stream.Finish(), NOT_FOUND, "COLLECTION_NOT_FOUND");
  }
  v1::IngestShapesRequest hello;
  hello.mutable_hello()->set_collection("collections/new");
  hello.mutable_hello()->set_create_if_absent(true);
  hello.mutable_hello()->mutable_settings()->set_vertex_budget(200);
  {
    IngestStream stream(server_);
    stream.Write(hello);
    ASSERT_TRUE(stream.Read());
    stream.SendAll("t", TorusOff());
    ASSERT_CALL_OK(stream.Finish());
    EXPECT_TRUE(stream.results["t"].has_shape());
  }
  {
    IngestStream stream(server_);
    stream.Write(hello);
    ASSERT_CALL_OK(stream.Finish());
  }
  hello.mutable_hello()->mutable_settings()->set_vertex_budget(201);
  IngestStream stream(server_);
  stream.Write(hello);
  EXPECT_FAILS(stream.Finish(), INVALID_ARGUMENT, "FIELD_INVALID");
}

TEST_F(IngestTest, EndsAStreamThatSendsMoreThanItsCredit) {
  IngestStream stream(server_);
  ASSERT_TRUE(stream.Hello("collections/c"));
  // Takes all of the bytes until its graph is computed.
  const std::string off = TorusOff() + std::string(3 << 20, '\n');
  ASSERT_TRUE(stream.SendAll("large", off));
  stream.Send(IngestStream::Item("next", off));
  EXPECT_FAILS(stream.Finish(), RESOURCE_EXHAUSTED, "CREDIT_EXCEEDED");
  EXPECT_TRUE(stream.results["large"].has_shape());
  EXPECT_FALSE(stream.results.contains("next"));
}

TEST_F(IngestTest, GivesNoCreditBackForResultsThatAreNotTaken) {
  // Without a socket a message is sent when the client reads it.
  const auto stub =
      v1::IngestService::NewStub(server_.rpc().InProcessChannel());
  IngestStream stream(*stub);
  ASSERT_TRUE(stream.Hello("collections/c"));
  const int credit = Options().rpc.limits.ingest_credit_items;
  v1::IngestItem refused;
  refused.set_key("refused");
  int taken = 0;
  while (taken < 10 * credit && stream.Send(refused)) ++taken;
  // The first beyond the credit is the last that is read.
  EXPECT_LE(taken, credit + 2);
  EXPECT_EQ(stream.Finish().error_code(), grpc::StatusCode::CANCELLED);
}

TEST_F(IngestTest, RefusesMessagesOutOfOrderAfterTheResultsOfWhatCameBefore) {
  {
    IngestStream stream(server_);
    stream.SendChunk("x");
    EXPECT_FAILS(stream.Finish(), INVALID_ARGUMENT, "STREAM_ORDER_INVALID");
  }
  {
    IngestStream stream(server_);
    EXPECT_FAILS(stream.Finish(), INVALID_ARGUMENT, "STREAM_ORDER_INVALID");
  }
  IngestStream stream(server_);
  stream.Hello("collections/c");
  stream.SendAll("good", TorusOff());
  stream.Hello("collections/c");
  EXPECT_FAILS(stream.Finish(), INVALID_ARGUMENT, "STREAM_ORDER_INVALID");
  EXPECT_TRUE(stream.results["good"].has_shape());
}

TEST_F(IngestTest, CutsASilentClientOff) {
  IngestStream stream(server_);
  ASSERT_TRUE(stream.Hello("collections/c"));
  ASSERT_TRUE(stream.Read());
  stream.Send(IngestStream::Item("never", TorusOff()));
  while (stream.Read()) {
  }
  EXPECT_FAILS(stream.Finish(), UNAVAILABLE, "STREAM_IDLE");
  EXPECT_EQ(CountShapes(), 0);
}

TEST_F(IngestTest, CutsAClientThatTricklesOff) {
  IngestStream stream(server_);
  ASSERT_TRUE(stream.Hello("collections/c"));
  ASSERT_TRUE(stream.Read());
  stream.Send(IngestStream::Item("slow", TorusOff()));
  // Each well before the idle timeout.
  while (stream.SendChunk("O")) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  EXPECT_FAILS(stream.Finish(), UNAVAILABLE, "STREAM_IDLE");
}

TEST_F(IngestTest, CutsAClientThatTakesItsResultsSlowlyOff) {
  // Without a socket a message is sent when the client reads it.
  const auto stub =
      v1::IngestService::NewStub(server_.rpc().InProcessChannel());
  IngestStream stream(*stub);
  ASSERT_TRUE(stream.Hello("collections/c"));
  for (const char* key : {"a", "b", "c"}) {
    v1::IngestItem refused;
    refused.set_key(key);
    ASSERT_TRUE(stream.Send(refused));
  }
  stream.HalfClose();
  // Each well before the idle timeout.
  while (stream.Read()) std::this_thread::sleep_for(std::chrono::seconds(1));
  EXPECT_EQ(stream.Finish().error_code(), grpc::StatusCode::CANCELLED);
}

TEST_F(IngestTest, LetsGoOfEverythingWhenTheClientCancels) {
  IngestStream stream(server_);
  ASSERT_TRUE(stream.Hello("collections/c"));
  ASSERT_TRUE(stream.Read());
  stream.SendAll("one", TorusOff());
  stream.Send(IngestStream::Item("two", TorusOff()));
  stream.context().TryCancel();
  EXPECT_EQ(stream.Finish().error_code(), grpc::StatusCode::CANCELLED);
  EXPECT_TRUE(server_.Stop(absl::Seconds(10)));
}

TEST_F(IngestTest, FinishesWhatWasBegunWhenTheServerGoesDown) {
  IngestStream stream(server_);
  ASSERT_TRUE(stream.Hello("collections/c"));
  ASSERT_TRUE(stream.Read());
  const std::string off = TorusOff();
  ASSERT_TRUE(stream.Send(IngestStream::Item("half", off)));
  ASSERT_TRUE(stream.SendChunk(off.substr(0, 500)));
  std::thread stop([&] { EXPECT_TRUE(server_.Stop(absl::Seconds(20))); });
  while (!stream.go_away && stream.Read()) {
  }
  EXPECT_TRUE(stream.go_away);
  stream.SendChunk(off.substr(500));
  while (stream.Read()) {  // a client that does not half-close
  }
  EXPECT_FAILS(stream.Finish(), UNAVAILABLE, "DRAINING");
  stop.join();
  // Either it was seen and is answered, or it was not begun.
  for (const auto& [key, result] : stream.results) {
    EXPECT_EQ(key, "half");
    EXPECT_TRUE(result.has_shape()) << ErrorOf(result.error());
  }
  server_.Start();
  EXPECT_EQ(CountShapes(), static_cast<int>(stream.results.size()));
}

}  // namespace
}  // namespace argmesh
