// SearchService.StreamSearchShapes: what a query in chunks may and may not do.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "core/base/sha256.h"
#include "tests/integration/gauge_wait.h"
#include "tests/integration/server_fixture.h"

namespace argmesh {
namespace {

constexpr int64_t kMaxMeshBytes = 8 << 20;

using Stream = grpc::ClientReaderWriter<v1::StreamSearchShapesRequest,
                                        v1::StreamSearchShapesResponse>;

struct Found {
  v1::StreamedQuery query;
  std::vector<v1::Match> matches;
  v1::SearchStats stats;
  std::string order;  // one letter for each message
  grpc::Status status;
};

class StreamSearchTest : public ::testing::Test {
 protected:
  explicit StreamSearchTest(
      absl::Duration stream_idle_timeout = absl::Milliseconds(400))
      : server_(Options(stream_idle_timeout)) {}

  static TestServerOptions Options(absl::Duration stream_idle_timeout) {
    TestServerOptions options;
    options.engine.mesh_limits.max_bytes = kMaxMeshBytes;
    options.rpc.limits.stream_idle_timeout = stream_idle_timeout;
    options.rpc.limits.max_inflight_searches = 1;
    return options;
  }

  void SetUp() override {
    server_.Start();
    server_.MakeCollection("c");
    server_.AddShape("c", "dumbbell", DumbbellOff());
    server_.AddShape("c", "sphere", SphereOff());
    server_.AddShape("c", "torus", TorusOff());
  }

  static v1::StreamSearchShapesHeader Header(const std::string& bytes) {
    v1::StreamSearchShapesHeader header;
    header.mutable_search()->set_parent("collections/c");
    header.set_size_bytes(static_cast<int64_t>(bytes.size()));
    header.set_sha256(ToHex(ComputeSha256(bytes)));
    return header;
  }

  static bool Send(Stream& stream, const v1::StreamSearchShapesHeader& header,
                   const std::string& bytes) {
    v1::StreamSearchShapesRequest request;
    *request.mutable_header() = header;
    bool open = stream.Write(request);
    for (size_t at = 0; open && at < bytes.size(); at += 256 << 10) {
      request.set_chunk(bytes.substr(at, 256 << 10));
      open = stream.Write(request);
    }
    return open;
  }

  static Found Receive(Stream& stream) {
    Found found;
    v1::StreamSearchShapesResponse response;
    while (stream.Read(&response)) {
      if (response.has_query()) {
        found.query = response.query();
        found.order += 'q';
      } else if (response.has_match()) {
        found.matches.push_back(response.match());
        found.order += 'm';
      } else {
        found.stats = response.stats();
        found.order += 's';
      }
    }
    found.status = stream.Finish();
    return found;
  }

  Found Search(const v1::StreamSearchShapesHeader& header,
               const std::string& bytes) {
    grpc::ClientContext context;
    const auto stream = server_.search().StreamSearchShapes(&context);
    Send(*stream, header, bytes);
    stream->WritesDone();
    return Receive(*stream);
  }

  TestServer server_;
};

TEST_F(StreamSearchTest, FindsAMeshLargerThanAMessage) {
  const std::string off = TorusOff() + std::string(6 << 20, '\n');
  const Found found = Search(Header(off), off);
  ASSERT_CALL_OK(found.status);
  ASSERT_EQ(found.matches.size(), 3U);
  EXPECT_EQ(found.matches[0].shape().name(), "collections/c/shapes/torus");
  EXPECT_GT(found.matches[0].component_pairs_size(), 0);
  EXPECT_EQ(found.order, "qmmms");
  EXPECT_EQ(found.stats.shapes_considered(), 3);
  EXPECT_EQ(found.query.query_report().faces(), 2 * 24 * 12);
}

TEST_F(StreamSearchTest, AnswersAsASearchWithTheMeshInTheMessage) {
  const std::string off = DumbbellOff();
  for (const auto mode : {v1::SEARCH_MODE_GLOBAL, v1::SEARCH_MODE_PARTIAL}) {
    v1::StreamSearchShapesHeader header = Header(off);
    v1::SearchShapesRequest& search = *header.mutable_search();
    search.set_mode(mode);
    search.set_limit(2);
    search.set_explain(true);
    search.set_return_query_graph(true);
    const Found found = Search(header, off);
    ASSERT_CALL_OK(found.status);
    search.mutable_mesh()->set_data(off);
    grpc::ClientContext context;
    v1::SearchShapesResponse alone;
    ASSERT_CALL_OK(server_.search().SearchShapes(&context, search, &alone));
    ASSERT_EQ(static_cast<int>(found.matches.size()), alone.matches_size());
    for (int i = 0; i < alone.matches_size(); ++i) {
      EXPECT_EQ(found.matches[static_cast<size_t>(i)].SerializeAsString(),
                alone.matches(i).SerializeAsString());
    }
    EXPECT_EQ(found.query.query_graph().SerializeAsString(),
              alone.query_graph().SerializeAsString());
    EXPECT_EQ(found.query.query_face_labels_size(),
              alone.query_face_labels_size());
  }
}

TEST_F(StreamSearchTest, SearchesNothingWhenTheBytesAreNotThoseAnnounced) {
  const std::string off = TorusOff();
  v1::StreamSearchShapesHeader header = Header(off);
  header.set_sha256(ToHex(ComputeSha256("another")));
  EXPECT_FAILS(Search(header, off).status, INVALID_ARGUMENT,
               "MESH_DIGEST_MISMATCH");
  EXPECT_FAILS(Search(Header(off), off + "\n").status, INVALID_ARGUMENT,
               "MESH_SIZE_MISMATCH");
  EXPECT_FAILS(Search(Header(off), off.substr(1)).status, INVALID_ARGUMENT,
               "MESH_SIZE_MISMATCH");
}

TEST_F(StreamSearchTest, RefusesAHeaderBeforeTheBytes) {
  const std::string off = TorusOff();
  v1::StreamSearchShapesHeader header = Header(off);
  header.set_size_bytes(kMaxMeshBytes + 1);
  EXPECT_FAILS(Search(header, "").status, RESOURCE_EXHAUSTED, "MESH_TOO_LARGE");
  header.set_size_bytes(0);
  EXPECT_FAILS(Search(header, "").status, INVALID_ARGUMENT, "FIELD_INVALID");
  header = Header(off);
  header.clear_sha256();
  EXPECT_FAILS(Search(header, "").status, INVALID_ARGUMENT, "FIELD_REQUIRED");
  header = Header(off);
  header.mutable_search()->set_parent("collections/none");
  EXPECT_FAILS(Search(header, "").status, NOT_FOUND, "COLLECTION_NOT_FOUND");
  header = Header(off);
  header.mutable_search()->set_shape("collections/c/shapes/torus");
  EXPECT_FAILS(Search(header, "").status, INVALID_ARGUMENT, "FIELD_INVALID");
  header = Header(off);
  header.mutable_search()->set_limit(1001);
  EXPECT_FAILS(Search(header, "").status, INVALID_ARGUMENT, "FIELD_INVALID");
}

TEST_F(StreamSearchTest, RefusesMessagesOutOfOrder) {
  grpc::ClientContext contexts[3];
  v1::StreamSearchShapesRequest chunk;
  chunk.set_chunk("OFF");
  const auto first = server_.search().StreamSearchShapes(&contexts[0]);
  first->Write(chunk);
  EXPECT_FAILS(Receive(*first).status, INVALID_ARGUMENT,
               "STREAM_ORDER_INVALID");
  const auto second = server_.search().StreamSearchShapes(&contexts[1]);
  Send(*second, Header("OFF"), "");
  Send(*second, Header("OFF"), "");
  EXPECT_FAILS(Receive(*second).status, INVALID_ARGUMENT,
               "STREAM_ORDER_INVALID");
  const auto third = server_.search().StreamSearchShapes(&contexts[2]);
  third->WritesDone();
  EXPECT_FAILS(Receive(*third).status, INVALID_ARGUMENT,
               "STREAM_ORDER_INVALID");
}

TEST_F(StreamSearchTest, SaysWhatIsWrongWithTheMesh) {
  const std::string bytes = "OFF\n1 1 0\n";
  EXPECT_FAILS(Search(Header(bytes), bytes).status, INVALID_ARGUMENT,
               "MESH_MALFORMED");
}

TEST_F(StreamSearchTest, CutsASilentClientOff) {
  const std::string off = TorusOff();
  grpc::ClientContext context;
  const auto stream = server_.search().StreamSearchShapes(&context);
  Send(*stream, Header(off), off);  // but never half-closed
  EXPECT_FAILS(Receive(*stream).status, UNAVAILABLE, "STREAM_IDLE");
  EXPECT_TRUE(server_.Stop(absl::Seconds(5)));
}

TEST_F(StreamSearchTest, CutsAClientThatTricklesOff) {
  const std::string off = TorusOff();
  grpc::ClientContext context;
  const auto stream = server_.search().StreamSearchShapes(&context);
  Send(*stream, Header(off), "");
  v1::StreamSearchShapesRequest byte;
  byte.set_chunk("O");
  // Each well before the idle timeout.
  while (stream->Write(byte)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  EXPECT_FAILS(Receive(*stream).status, UNAVAILABLE, "STREAM_IDLE");
}

TEST_F(StreamSearchTest, StopsWhenItIsCancelled) {
  const std::string off = SphereOff(200);
  grpc::ClientContext context;
  const auto stream = server_.search().StreamSearchShapes(&context);
  Send(*stream, Header(off), off);
  stream->WritesDone();
  context.TryCancel();
  EXPECT_EQ(Receive(*stream).status.error_code(), grpc::StatusCode::CANCELLED);
  EXPECT_TRUE(server_.Stop(absl::Seconds(5)));
}

// Peers that take their time, with one place for searches.
class SlowStreamSearchTest : public StreamSearchTest {
 protected:
  SlowStreamSearchTest() : StreamSearchTest(absl::Minutes(5)) {}

  grpc::Status SearchByShape() {
    v1::SearchShapesRequest request;
    request.set_parent("collections/c");
    request.set_shape("collections/c/shapes/torus");
    grpc::ClientContext context;
    v1::SearchShapesResponse response;
    return server_.search().SearchShapes(&context, request, &response);
  }

  void AwaitPlaces(const std::string& what, double places) {
    WaitForGauge(server_, "argmesh_admission_used", places, what);
  }
};

TEST_F(SlowStreamSearchTest, TakesNoPlaceOfASearchWhileTheMeshComes) {
  grpc::ClientContext context;
  const auto stream = server_.search().StreamSearchShapes(&context);
  Send(*stream, Header(TorusOff()), "");
  AwaitPlaces("query streams", 1);
  ASSERT_CALL_OK(SearchByShape());
  stream->WritesDone();
  EXPECT_FAILS(Receive(*stream).status, INVALID_ARGUMENT, "MESH_SIZE_MISMATCH");
}

TEST_F(SlowStreamSearchTest, LetsOnlySoManyMeshesComeAtATime) {
  const std::string off = TorusOff();
  grpc::ClientContext context;
  const auto stream = server_.search().StreamSearchShapes(&context);
  Send(*stream, Header(off), "");
  AwaitPlaces("query streams", 1);
  EXPECT_FAILS(Search(Header(off), off).status, RESOURCE_EXHAUSTED,
               "OVERLOADED");
  context.TryCancel();
  Receive(*stream);
  AwaitPlaces("query streams", 0);
}

TEST_F(SlowStreamSearchTest, TakesNoPlaceOfASearchWhileItsAnswerIsNotTaken) {
  // Without a socket a message is sent when the client reads it.
  const auto stub =
      v1::SearchService::NewStub(server_.rpc().InProcessChannel());
  const std::string off = TorusOff();
  grpc::ClientContext context;
  const auto stream = stub->StreamSearchShapes(&context);
  Send(*stream, Header(off), off);
  stream->WritesDone();
  v1::StreamSearchShapesResponse first;
  ASSERT_TRUE(stream->Read(&first));
  EXPECT_TRUE(first.has_query());
  ASSERT_CALL_OK(SearchByShape());
  EXPECT_GT(GaugeOf(server_, "argmesh_unread_answer_bytes"), 0);
  const Found found = Receive(*stream);
  ASSERT_CALL_OK(found.status);
  EXPECT_EQ(found.order, "mmms");
}

}  // namespace
}  // namespace argmesh
