// The Ingestor against a server in this process whose moods are scripted.
#include "client/ingestor.h"

#include <gmock/gmock.h>
#include <grpcpp/server.h>
#include <grpcpp/server_builder.h>

#include <atomic>
#include <map>
#include <mutex>
#include <set>

#include "absl/strings/str_format.h"
#include "argmesh/v1/ingest_service.grpc.pb.h"
#include "client/error_status.h"
#include "core/base/sha256.h"
#include "google/rpc/error_details.pb.h"
#include "tests/support/status_matchers.h"

namespace argmesh {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Stream =
    grpc::ServerReaderWriter<v1::IngestShapesResponse, v1::IngestShapesRequest>;

// Keeps what it is sent. Gives `credit_items` at first and one more after each
// result; checks that the client never oversteps it.
class ScriptedIngest final : public v1::IngestService::Service {
 public:
  int credit_items = 2;
  int64_t credit_bytes = 1000;
  int die_after = -1;          // results of the first stream, then a broken one
  int refuse_first_sends = 0;  // items answered with OVERLOADED
  bool go_away_once = false;   // the first stream asks for no more items

  std::mutex mutex;
  std::map<std::string, std::string> stored;  // id to bytes
  std::set<std::string> request_ids;
  int streams = 0;
  bool overstepped = false;

  grpc::Status IngestShapes(grpc::ServerContext* /*context*/,
                            Stream* stream) override {
    v1::IngestShapesRequest request;
    if (!stream->Read(&request) || !request.has_hello()) {
      return {grpc::StatusCode::INVALID_ARGUMENT, "hello comes first"};
    }
    if (request.hello().collection() != "collections/there") {
      return {grpc::StatusCode::NOT_FOUND, "no such collection"};
    }
    const std::lock_guard<std::mutex> lock(mutex);
    ++streams;
    return Serve(stream);
  }

 private:
  grpc::Status Serve(Stream* stream) {
    items_left_ = credit_items;
    bytes_left_ = credit_bytes;
    SendCredit(stream, credit_items, credit_bytes);
    if (go_away_once && streams == 1) {
      v1::IngestShapesResponse away;
      away.mutable_go_away();
      stream->Write(away);
      return {grpc::StatusCode::UNAVAILABLE, "draining"};
    }
    int results = 0;
    v1::IngestShapesRequest request;
    while (stream->Read(&request)) {
      if (request.has_item()) {
        overstepped |= items_left_ < 1 || bytes_left_ < 1;
        --items_left_;
        bytes_left_ -= request.item().size_bytes();
        item_ = request.item();
        bytes_.clear();
      } else {
        bytes_ += request.chunk();
      }
      if (static_cast<int64_t>(bytes_.size()) < item_.size_bytes()) continue;
      if (results++ == die_after && streams == 1) {
        return {grpc::StatusCode::UNAVAILABLE, "gone"};
      }
      Answer(stream);
    }
    return grpc::Status::OK;
  }

  void Answer(Stream* stream) {
    v1::IngestShapesResponse response;
    v1::IngestItemResult& result = *response.mutable_result();
    result.set_key(item_.key());
    if (refuse_first_sends > 0) {
      --refuse_first_sends;
      result.mutable_error()->set_code(8);
      google::rpc::RetryInfo retry;
      result.mutable_error()->add_details()->PackFrom(retry);
    } else if (bytes_ == "bad") {
      result.mutable_error()->set_code(3);
      result.mutable_error()->set_message("malformed");
    } else {
      EXPECT_EQ(item_.sha256(), ToHex(ComputeSha256(bytes_)));
      result.set_already_stored(stored.contains(item_.shape_id()));
      stored[item_.shape_id()] = bytes_;
      request_ids.insert(item_.request_id());
      result.mutable_shape()->set_name(item_.shape_id());
    }
    stream->Write(response);
    ++items_left_;
    bytes_left_ += item_.size_bytes();
    SendCredit(stream, 1, item_.size_bytes());
  }

  static void SendCredit(Stream* stream, int items, int64_t bytes) {
    v1::IngestShapesResponse response;
    response.mutable_credit()->set_items(items);
    response.mutable_credit()->set_bytes(bytes);
    stream->Write(response);
  }

  v1::IngestItem item_;
  std::string bytes_;
  int64_t items_left_ = 0;
  int64_t bytes_left_ = 0;
};

class IngestorTest : public testing::Test {
 protected:
  void SetUp() override {
    grpc::ServerBuilder builder;
    int port = 0;
    builder.AddListeningPort("127.0.0.1:0", grpc::InsecureServerCredentials(),
                             &port);
    builder.RegisterService(&service_);
    server_ = builder.BuildAndStart();
    ASSERT_NE(server_, nullptr);
    ClientOptions options;
    options.call_timeout = absl::Seconds(20);
    ASSERT_OK_AND_ASSIGN(
        client_,
        Client::Connect(absl::StrFormat("127.0.0.1:%d", port), options));
    options_.collection = "collections/there";
    options_.reconnect.initial_backoff = absl::Milliseconds(10);
    options_.reconnect.max_attempts = 4;
  }
  void TearDown() override { server_->Shutdown(); }

  void AddEntry(const std::string& id, const std::string& bytes) {
    IngestEntry entry;
    entry.shape_id = id;
    entry.read = [bytes]() -> absl::StatusOr<std::string> { return bytes; };
    entries_.push_back(std::move(entry));
  }
  void AddEntries(int count) {
    for (int i = 0; i < count; ++i) {
      AddEntry(absl::StrFormat("s%d", i), absl::StrFormat("mesh %d", i));
    }
  }

  absl::Status Run(std::stop_token stop = {}) {
    Ingestor ingestor(*client_, options_);
    return ingestor.Run(
        entries_,
        [this](const IngestOutcome& outcome) {
          outcomes_[outcome.index] = outcome;
          ++reports_;
        },
        std::move(stop));
  }

  ScriptedIngest service_;
  std::unique_ptr<grpc::Server> server_;
  std::unique_ptr<Client> client_;
  IngestOptions options_;
  std::vector<IngestEntry> entries_;
  std::map<size_t, IngestOutcome> outcomes_;
  size_t reports_ = 0;
};

TEST_F(IngestorTest, StoresEveryEntryWithinItsCredit) {
  AddEntries(25);
  EXPECT_THAT(Run(), IsOk());
  EXPECT_EQ(reports_, 25U);
  EXPECT_EQ(service_.stored.size(), 25U);
  EXPECT_EQ(service_.stored["s7"], "mesh 7");
  EXPECT_FALSE(service_.overstepped);
  for (const auto& [index, outcome] : outcomes_) {
    EXPECT_THAT(outcome.status, IsOk());
    EXPECT_FALSE(outcome.already_stored);
  }
}

TEST_F(IngestorTest, SendsAnItemLargerThanTheCreditAndThanAMessage) {
  AddEntry("large", std::string(5 << 20, 'x'));
  AddEntry("small", "mesh");
  EXPECT_THAT(Run(), IsOk());
  EXPECT_EQ(service_.stored["large"].size(), size_t{5} << 20);
  EXPECT_EQ(service_.stored.size(), 2U);
  EXPECT_FALSE(service_.overstepped);
}

TEST_F(IngestorTest, ReportsABadItemAndGoesOn) {
  AddEntry("a", "mesh a");
  AddEntry("b", "bad");
  AddEntry("c", "");
  AddEntry("d", "mesh d");
  entries_.push_back({});
  entries_.back().read = []() -> absl::StatusOr<std::string> {
    return absl::NotFoundError("no file");
  };
  EXPECT_THAT(Run(), IsOk());
  EXPECT_EQ(reports_, 5U);
  EXPECT_EQ(service_.stored.size(), 2U);
  EXPECT_THAT(outcomes_[1].status, StatusIs(absl::StatusCode::kInvalidArgument,
                                            HasSubstr("malformed")));
  EXPECT_EQ(ErrorReason(outcomes_[2].status), "MESH_EMPTY");
  EXPECT_THAT(outcomes_[4].status,
              StatusIs(absl::StatusCode::kNotFound, HasSubstr("no file")));
}

TEST_F(IngestorTest, GoesOnAfterABrokenStreamWithoutLosingAnEntry) {
  service_.die_after = 3;
  AddEntries(10);
  EXPECT_THAT(Run(), IsOk());
  EXPECT_EQ(reports_, 10U);
  EXPECT_EQ(service_.stored.size(), 10U);
  EXPECT_GE(service_.streams, 2);
  EXPECT_EQ(service_.request_ids.size(), 10U);
}

TEST_F(IngestorTest, CountsAnEntrySentTwiceAsNew) {
  // Stored, but its result is lost with the stream.
  service_.die_after = 0;
  service_.stored["s0"] = "mesh 0";
  AddEntries(1);
  EXPECT_THAT(Run(), IsOk());
  EXPECT_FALSE(outcomes_[0].already_stored);
}

TEST_F(IngestorTest, GoesElsewhereWhenAskedTo) {
  service_.go_away_once = true;
  AddEntries(3);
  EXPECT_THAT(Run(), IsOk());
  EXPECT_EQ(service_.stored.size(), 3U);
  EXPECT_EQ(service_.streams, 2);
}

TEST_F(IngestorTest, SendsAgainWhatTheServerWantsLater) {
  service_.refuse_first_sends = 2;
  AddEntries(4);
  EXPECT_THAT(Run(), IsOk());
  EXPECT_EQ(reports_, 4U);
  EXPECT_EQ(service_.stored.size(), 4U);
}

TEST_F(IngestorTest, SkipsWhatIsThereWithoutASecondLook) {
  AddEntries(3);
  options_.decide =
      [](size_t index,
         const std::string& sha256) -> absl::StatusOr<IngestDecision> {
    EXPECT_EQ(sha256, ToHex(ComputeSha256(absl::StrFormat("mesh %d", index))));
    return index == 1 ? IngestDecision::kSkip : IngestDecision::kSend;
  };
  EXPECT_THAT(Run(), IsOk());
  EXPECT_TRUE(outcomes_[1].already_stored);
  EXPECT_FALSE(service_.stored.contains("s1"));
  EXPECT_EQ(service_.stored.size(), 2U);
}

TEST_F(IngestorTest, OpensNoStreamWhenNothingHasToBeSent) {
  EXPECT_THAT(Run(), IsOk());
  EXPECT_EQ(service_.streams, 0);
}

TEST_F(IngestorTest, StopsWhenAskedToAndSaysSo) {
  AddEntries(50);
  std::stop_source source;
  entries_[5].read = [&source]() -> absl::StatusOr<std::string> {
    source.request_stop();
    return std::string("mesh 5");
  };
  EXPECT_THAT(Run(source.get_token()),
              StatusIs(absl::StatusCode::kCancelled, testing::_));
  EXPECT_LT(reports_, 50U);
  // What was begun was waited for: stored and reported agree.
  EXPECT_EQ(service_.stored.size(), reports_);
}

TEST_F(IngestorTest, PassesARefusedStreamOn) {
  options_.collection = "collections/elsewhere";
  AddEntries(2);
  EXPECT_THAT(Run(), StatusIs(absl::StatusCode::kNotFound,
                              HasSubstr("no such collection")));
  EXPECT_EQ(reports_, 0U);
}

TEST_F(IngestorTest, GivesUpOnAServerThatStaysAway) {
  server_->Shutdown();
  AddEntries(2);
  const absl::Status status = Run();
  EXPECT_TRUE(IsUnreachable(status)) << status;
  EXPECT_THAT(std::string(status.message()), HasSubstr("no argmesh server"));
}

}  // namespace
}  // namespace argmesh
