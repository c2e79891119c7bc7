// Calls of the kinds that work long, each cancelled at a random moment: its
// work stops, and nothing of it stays behind.
//
// ARGMESH_CANCELLED_CALLS of them, 39 when not set; from seed
// ARGMESH_CANCELLED_SEED, 1. How soon the work stops is printed. Other work on
// the machine has a part in that, so what is asked is the time on a CPU that
// this process takes meanwhile: what is promised, for each thread of a search.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include "core/base/random.h"
#include "core/base/sha256.h"
#include "core/mesh/mesh_write.h"
#include "server/storage/import_root.h"
#include "server/telemetry/gauge_sheet.h"
#include "tests/integration/operation_wait.h"
#include "tests/integration/server_fixture.h"
#include "tests/reliability/process_memory.h"
#include "tests/support/environment_number.h"
#include "tests/support/test_meshes.h"

namespace argmesh {
namespace {

using Clock = std::chrono::steady_clock;
using google::longrunning::Operation;
using std::chrono::duration;
using std::chrono::milliseconds;

constexpr char kCalls[] = "ARGMESH_CANCELLED_CALLS";
constexpr char kParts[] = "collections/parts";
constexpr int kShapes = 6;
constexpr int kFiles = 4;
constexpr size_t kDownloadBytes = 16 << 20;
constexpr double kPromisedMilliseconds = 50;
constexpr auto kPatience = std::chrono::seconds(20);
constexpr int64_t kMostGrowth = 128 << 20;

double MillisecondsSince(Clock::time_point begin) {
  return duration<double, std::milli>(Clock::now() - begin).count();
}

// Of all threads of this process, which the machine's other work has no part
// in.
double CpuMilliseconds() {
  timespec time = {};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) +
         1e-6 * static_cast<double>(time.tv_nsec);
}

double Quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  return values[static_cast<size_t>(share *
                                    static_cast<double>(values.size() - 1))];
}

std::string LargeMesh(uint64_t seed) {
  return *SerializeMesh(RandomlyMoved(MakeDumbbell(160), seed),
                        MeshFormat::kOff);
}

// One call under way, which Cancel ends and Finish waits for.
struct Call {
  std::function<void()> cancel;
  std::function<grpc::StatusCode()> finish;
};

struct Kind {
  const char* name;
  std::function<Call()> start;
  double typical_milliseconds = 0;   // when it is not cancelled
  std::vector<double> stopped = {};  // milliseconds, one a cancelled call
  std::vector<double> cpu = {};      // of the process meanwhile
};

class CancellationTest : public testing::Test {
 protected:
  void SetUp() override {
    for (int i = 0; i < kFiles; ++i) {
      std::ofstream(files_.path() / ("file" + std::to_string(i) + ".off"))
          << LargeMesh(static_cast<uint64_t>(i));
    }
    auto root = ImportRoot::Open(files_.path());
    ASSERT_TRUE(root.ok()) << root.status();
    root_ = *std::move(root);
    TestServerOptions options;
    options.rpc.import_source = root_.get();
    server_ = std::make_unique<TestServer>(options);
    server_->Start();
    v1::CreateCollectionRequest request;
    request.set_collection_id("parts");
    grpc::ClientContext context;
    v1::Collection made;
    ASSERT_CALL_OK(
        server_->collections().CreateCollection(&context, request, &made));
    for (int i = 0; i < kShapes; ++i) {
      server_->AddShape("parts", "torus-" + std::to_string(i),
                        TorusOff(0.3 + 0.1 * i));
    }
    server_->MakeCollection("reindexed");
    for (int i = 0; i < kShapes; ++i) {
      server_->AddShape("reindexed", "torus-" + std::to_string(i),
                        TorusOff(0.3 + 0.1 * i));
    }
    NewShape downloaded;
    downloaded.collection = "parts";
    downloaded.id = "downloaded";
    ASSERT_TRUE(server_->engine()
                    .AddShape(downloaded,
                              TorusOff() + std::string(kDownloadBytes, '\n'))
                    .ok());
  }

  std::vector<Kind> Kinds() {
    return {{"SearchShapes", [this] { return Search(false); }},
            {"SearchShapes, partial", [this] { return Search(true); }},
            {"BatchSearchShapes", [this] { return BatchSearch(); }},
            {"StreamSearchShapes", [this] { return StreamSearch(); }},
            {"CompareShapes", [this] { return Compare(); }},
            {"CreateShape", [this] { return Create(); }},
            {"UploadShape", [this] { return Upload(); }},
            {"IngestShapes", [this] { return Ingest(); }},
            {"DownloadMesh", [this] { return Download(); }},
            {"ImportShapes", [this] { return Import(); }},
            {"ReindexCollection", [this] { return Reindex(); }},
            {"CreateSnapshot", [this] { return Snapshot(); }},
            {"VerifyStorage", [this] { return Verify(); }}};
  }

  // `call` on a thread of its own.
  static Call Background(
      std::function<grpc::Status(grpc::ClientContext*)> call) {
    struct State {
      grpc::ClientContext context;
      grpc::Status status;
      std::thread thread;
    };
    const auto state = std::make_shared<State>();
    state->thread = std::thread([state, call = std::move(call)] {
      state->status = call(&state->context);
    });
    return {[state] { state->context.TryCancel(); },
            [state] {
              state->thread.join();
              return state->status.error_code();
            }};
  }

  template <typename Stub, typename Request, typename Response>
  static Call Unary(Stub& stub,
                    grpc::Status (Stub::*method)(grpc::ClientContext*,
                                                 const Request&, Response*),
                    const Request& request) {
    return Background([&stub, method, request](grpc::ClientContext* context) {
      Response response;
      return (stub.*method)(context, request, &response);
    });
  }

  v1::SearchShapesRequest SearchRequest(bool partial) {
    v1::SearchShapesRequest request;
    request.set_parent(kParts);
    request.set_mode(partial ? v1::SEARCH_MODE_PARTIAL
                             : v1::SEARCH_MODE_GLOBAL);
    request.mutable_mesh()->set_data(LargeMesh(next_++));
    return request;
  }

  Call Search(bool partial) {
    return Unary(server_->search(), &v1::SearchService::Stub::SearchShapes,
                 SearchRequest(partial));
  }

  Call BatchSearch() {
    v1::BatchSearchShapesRequest request;
    request.set_parent(kParts);
    for (int i = 0; i < 3; ++i) *request.add_requests() = SearchRequest(i == 1);
    return Unary(server_->search(), &v1::SearchService::Stub::BatchSearchShapes,
                 request);
  }

  Call Compare() {
    v1::CompareShapesRequest request;
    request.set_parent(kParts);
    request.mutable_query()->mutable_mesh()->set_data(LargeMesh(next_++));
    request.mutable_target()->mutable_mesh()->set_data(LargeMesh(next_++));
    return Unary(server_->search(), &v1::SearchService::Stub::CompareShapes,
                 request);
  }

  Call Create() {
    v1::CreateShapeRequest request;
    request.set_parent(kParts);
    request.set_shape_id("made-" + std::to_string(next_));
    request.mutable_mesh()->set_data(LargeMesh(next_++));
    return Unary(server_->shapes(), &v1::ShapeService::Stub::CreateShape,
                 request);
  }

  // A stream that sends `messages`, then reads to the end.
  template <typename Request, typename Response>
  static Call Stream(
      std::function<std::unique_ptr<
          grpc::ClientReaderWriter<Request, Response>>(grpc::ClientContext*)>
          open,
      std::vector<Request> messages) {
    return Background([open = std::move(open), messages = std::move(messages)](
                          grpc::ClientContext* context) {
      const auto stream = open(context);
      for (const Request& message : messages) {
        if (!stream->Write(message)) break;
      }
      stream->WritesDone();
      Response response;
      while (stream->Read(&response)) {
      }
      return stream->Finish();
    });
  }

  Call StreamSearch() {
    const std::string mesh = LargeMesh(next_++);
    std::vector<v1::StreamSearchShapesRequest> messages(2);
    v1::StreamSearchShapesHeader& header = *messages[0].mutable_header();
    header.mutable_search()->set_parent(kParts);
    header.set_size_bytes(static_cast<int64_t>(mesh.size()));
    header.set_sha256(ToHex(ComputeSha256(mesh)));
    messages[1].set_chunk(mesh);
    return Stream<v1::StreamSearchShapesRequest,
                  v1::StreamSearchShapesResponse>(
        [this](grpc::ClientContext* context) {
          return server_->search().StreamSearchShapes(context);
        },
        messages);
  }

  Call Ingest() {
    std::vector<v1::IngestShapesRequest> messages(1);
    messages[0].mutable_hello()->set_collection(kParts);
    for (int i = 0; i < 3; ++i) {
      const std::string id = "ingested-" + std::to_string(next_);
      const std::string mesh = LargeMesh(next_++);
      v1::IngestItem& item = *messages.emplace_back().mutable_item();
      item.set_key(id);
      item.set_shape_id(id);
      item.set_size_bytes(static_cast<int64_t>(mesh.size()));
      item.set_sha256(ToHex(ComputeSha256(mesh)));
      messages.emplace_back().set_chunk(mesh);
    }
    return Stream<v1::IngestShapesRequest, v1::IngestShapesResponse>(
        [this](grpc::ClientContext* context) {
          return server_->ingest().IngestShapes(context);
        },
        messages);
  }

  Call Upload() {
    const std::string id = "uploaded-" + std::to_string(next_);
    return Background(
        [this, id, mesh = LargeMesh(next_++)](grpc::ClientContext* context) {
          v1::Shape shape;
          const auto writer = server_->shapes().UploadShape(context, &shape);
          v1::UploadShapeRequest request;
          v1::UploadShapeHeader& header = *request.mutable_header();
          header.set_parent(kParts);
          header.set_shape_id(id);
          header.set_size_bytes(static_cast<int64_t>(mesh.size()));
          header.set_sha256(ToHex(ComputeSha256(mesh)));
          if (writer->Write(request)) {
            request.set_chunk(mesh);
            writer->Write(request);
          }
          writer->WritesDone();
          return writer->Finish();
        });
  }

  Call Download() {
    return Background([this](grpc::ClientContext* context) {
      v1::DownloadMeshRequest request;
      request.set_name(std::string(kParts) + "/shapes/downloaded");
      const auto reader = server_->shapes().DownloadMesh(context, request);
      v1::DownloadMeshResponse response;
      while (reader->Read(&response)) {
      }
      return reader->Finish();
    });
  }

  // An operation that has been started.
  Call Started(const grpc::Status& status, const Operation& operation) {
    EXPECT_TRUE(status.ok()) << ErrorOf(status);
    const std::string name = operation.name();
    return {[this, name] { CancelOperation(*server_, name); },
            [this, name] {
              return static_cast<grpc::StatusCode>(
                  WaitForOperation(*server_, name).error().code());
            }};
  }

  Call Import() {
    v1::ImportShapesRequest request;
    request.set_parent(kParts);
    request.set_existing_shape_policy(v1::EXISTING_SHAPE_POLICY_REPLACE);
    grpc::ClientContext context;
    Operation operation;
    const grpc::Status status =
        server_->ingest().ImportShapes(&context, request, &operation);
    return Started(status, operation);
  }

  // With settings that the collection has not.
  Call Reindex() {
    v1::ReindexCollectionRequest request;
    request.set_name("collections/reindexed");
    request.mutable_settings()->set_vertex_budget(
        static_cast<int32_t>(1000 + next_++));
    grpc::ClientContext context;
    Operation operation;
    const grpc::Status status =
        server_->collections().ReindexCollection(&context, request, &operation);
    return Started(status, operation);
  }

  Call Snapshot() {
    v1::CreateSnapshotRequest request;
    request.set_snapshot_id("snapshot-" + std::to_string(next_++));
    grpc::ClientContext context;
    Operation operation;
    const grpc::Status status =
        server_->admin().CreateSnapshot(&context, request, &operation);
    return Started(status, operation);
  }

  Call Verify() {
    grpc::ClientContext context;
    Operation operation;
    const grpc::Status status =
        server_->admin().VerifyStorage(&context, {}, &operation);
    return Started(status, operation);
  }

  // No thread of a pool works, no call is under way or has a place.
  bool IsIdle() {
    for (const WorkClass work :
         {WorkClass::kSearch, WorkClass::kCompute, WorkClass::kQuick}) {
      const WorkLoad load = server_->engine().pool().Load(work);
      if (load.running != 0 || load.queued != 0) return false;
    }
    GaugeSheet sheet;
    server_->rpc().WriteGauges(sheet);
    for (const char* name :
         {"argmesh_calls_in_flight", "argmesh_admission_used",
          "argmesh_operations_running"}) {
      for (const auto& sample : sheet.families().at(name).samples) {
        if (sample.value != 0) return false;
      }
    }
    return true;
  }

  bool BecomesIdle() {
    const auto end = Clock::now() + kPatience;
    while (!IsIdle()) {
      if (Clock::now() > end) return false;
      std::this_thread::sleep_for(milliseconds(1));
    }
    return true;
  }

  void CancelOne(Kind& kind, Random& random) {
    const Call call = kind.start();
    std::this_thread::sleep_for(duration<double, std::milli>(
        kind.typical_milliseconds * random.Uniform()));
    const auto begin = Clock::now();
    const double cpu = CpuMilliseconds();
    call.cancel();
    ASSERT_TRUE(BecomesIdle()) << kind.name << " goes on for ever";
    const double stopped = MillisecondsSince(begin);
    const double used = CpuMilliseconds() - cpu;
    const grpc::StatusCode code = call.finish();
    // It may have come to the server after that.
    ASSERT_TRUE(BecomesIdle()) << kind.name << " goes on for ever";
    if (code == grpc::StatusCode::OK) return;  // it was faster
    EXPECT_EQ(code, grpc::StatusCode::CANCELLED) << kind.name;
    kind.stopped.push_back(stopped);
    kind.cpu.push_back(used);
  }

  const TemporaryDirectory files_;
  std::unique_ptr<ImportRoot> root_;
  std::unique_ptr<TestServer> server_;
  uint64_t next_ = 0;  // no two meshes or ids are the same
};

TEST_F(CancellationTest, StopsTheWorkAndLeavesNothing) {
  Random random(EnvironmentNumber("ARGMESH_CANCELLED_SEED", 1));
  std::vector<Kind> kinds = Kinds();
  for (Kind& kind : kinds) {
    const auto begin = Clock::now();
    EXPECT_EQ(kind.start().finish(), grpc::StatusCode::OK) << kind.name;
    kind.typical_milliseconds = MillisecondsSince(begin);
    ASSERT_TRUE(BecomesIdle());
  }
  const uint64_t calls = EnvironmentNumber(kCalls, 39);
  int64_t before = 0;
  for (uint64_t i = 0; i < calls; ++i) {
    // Caches and the allocator have what they keep by then.
    if (i == calls / 3) before = ResidentBytes(getpid());
    ASSERT_NO_FATAL_FAILURE(CancelOne(kinds[i % kinds.size()], random));
  }

  std::vector<double> stopped;
  std::vector<double> cpu;
  for (const Kind& kind : kinds) {
    std::printf(
        "%-22s takes %6.0f ms; cancelled %4zu times, idle after %.1f "
        "ms at the median, %.1f at most; CPU %.1f, %.1f\n",
        kind.name, kind.typical_milliseconds, kind.stopped.size(),
        Quantile(kind.stopped, 0.5), Quantile(kind.stopped, 1),
        Quantile(kind.cpu, 0.5), Quantile(kind.cpu, 1));
    stopped.insert(stopped.end(), kind.stopped.begin(), kind.stopped.end());
    cpu.insert(cpu.end(), kind.cpu.begin(), kind.cpu.end());
  }
  const int64_t growth = ResidentBytes(getpid()) - before;
  std::printf(
      "measured: %llu calls, %zu cancelled in time: idle after %.1f ms at the "
      "median, p99 %.1f, at most %.1f; CPU meanwhile %.1f, p99 %.1f, at most "
      "%.1f; memory %+lld MiB after the first third\n",
      static_cast<unsigned long long>(calls), stopped.size(),
      Quantile(stopped, 0.5), Quantile(stopped, 0.99), Quantile(stopped, 1),
      Quantile(cpu, 0.5), Quantile(cpu, 0.99), Quantile(cpu, 1),
      static_cast<long long>(growth >> 20));

  EXPECT_GT(stopped.size(), calls / 4);
  EXPECT_LT(growth, kMostGrowth);
  EXPECT_TRUE(std::filesystem::is_empty(server_->folder() / "incoming"))
      << "an upload was left behind";
  grpc::ClientContext context;
  v1::SearchShapesResponse response;
  EXPECT_TRUE(server_->search()
                  .SearchShapes(&context, SearchRequest(false), &response)
                  .ok());
  if (std::getenv(kCalls) == nullptr) return;
  const int threads = server_->engine().pool().Load(WorkClass::kSearch).threads;
  EXPECT_LE(Quantile(cpu, 0.99), kPromisedMilliseconds * threads);
}

}  // namespace
}  // namespace argmesh
