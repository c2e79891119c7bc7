// The provocations that take more than one request.
#include <filesystem>
#include <future>
#include <stdexcept>
#include <stop_token>

#include "absl/time/clock.h"
#include "core/base/sha256.h"
#include "server/rpc/status.h"
#include "server/storage/import_root.h"
#include "server/storage/sqlite_connection.h"
#include "tests/integration/operation_wait.h"
#include "tests/integration/provoked_errors.h"
#include "tests/support/memory_catalog.h"
#include "tests/support/memory_mesh_store.h"

namespace argmesh {
namespace {

// Loads for ever and throws where a collection is asked for.
class FaultyCatalog : public MemoryCatalog {
 public:
  explicit FaultyCatalog(std::shared_future<void> loaded)
      : loaded_(std::move(loaded)) {}

  absl::StatusOr<std::vector<CollectionRecord>> ListCollections(
      std::string_view after_id, int limit) const override {
    loaded_.wait();
    return MemoryCatalog::ListCollections(after_id, limit);
  }
  absl::StatusOr<CollectionRecord> GetCollection(
      std::string_view) const override {
    throw std::runtime_error("a defect");
  }

 private:
  const std::shared_future<void> loaded_;
};

SearchQuery QueryForTorus() {
  SearchQuery query;
  query.collection = "c";
  query.query = ShapeRef{"c", "torus"};
  return query;
}

// One ingest stream, which is as many as there may be.
struct Ingest {
  explicit Ingest(TestServer& server)
      : stream(server.ingest().IngestShapes(&context)) {
    v1::IngestShapesRequest hello;
    hello.mutable_hello()->set_collection("collections/c");
    stream->Write(hello);
  }
  bool Read() {
    v1::IngestShapesResponse ignored;
    return stream->Read(&ignored);
  }
  void Send(const std::string& id, const std::string& mesh) {
    v1::IngestShapesRequest request;
    v1::IngestItem& item = *request.mutable_item();
    item.set_key(id);
    item.set_shape_id(id);
    item.set_size_bytes(static_cast<int64_t>(mesh.size()));
    item.set_sha256(ToHex(ComputeSha256(mesh)));
    stream->Write(request);
    request.set_chunk(mesh);
    stream->Write(request);
  }
  ErrorOf ReadToTheEnd() {
    while (Read()) {
    }
    return ErrorOf(stream->Finish());
  }
  grpc::ClientContext context;
  std::unique_ptr<grpc::ClientReaderWriter<v1::IngestShapesRequest,
                                           v1::IngestShapesResponse>>
      stream;
};

}  // namespace

ProvokedErrors::Provocations ProvokedErrors::OfStreams() {
  return {{"STREAM_ORDER_INVALID",
           [this] {
             grpc::ClientContext context;
             v1::Shape shape;
             const auto writer = server_.shapes().UploadShape(&context, &shape);
             v1::UploadShapeRequest request;
             request.set_chunk("before any header");
             writer->Write(request);
             writer->WritesDone();
             return ErrorOf(writer->Finish());
           }},
          {"OVERLOADED",
           [this] {
             Ingest first(server_);
             EXPECT_TRUE(first.Read());  // its credit: it has been let in
             const ErrorOf error = Ingest(server_).ReadToTheEnd();
             first.stream->WritesDone();
             first.ReadToTheEnd();
             return error;
           }},
          {"CREDIT_EXCEEDED",
           [this] {
             Ingest ingest(server_);
             ingest.Send("one", DumbbellOff());  // its graph takes a while
             ingest.Send("two", DumbbellOff());
             return ingest.ReadToTheEnd();
           }},
          {"STREAM_IDLE", [this] { return Ingest(server_).ReadToTheEnd(); }}};
}

ErrorOf ProvokedErrors::CallWithKeys(const std::string& key) {
  KeyRing ring;
  for (const char* id : {"reader", "late", "limited"}) {
    ApiKey& made = ring[id];
    made.id = id;
    made.secret_sha256 = HashKeySecret(std::string(43, 's'));
  }
  ring["late"].expire_time = absl::Now() - absl::Hours(1);
  ring["limited"].limits = {
      .requests_per_second = 0.001, .burst = 1, .concurrent_calls = 0};
  server_.rpc().SetKeys(std::make_shared<const KeyRing>(ring));
  v1::CreateCollectionRequest request;
  request.set_collection_id("keyed");
  const ErrorOf error =
      Call(server_, "CollectionService/CreateCollection", request, key);
  server_.rpc().SetKeys(nullptr);
  return error;
}

ProvokedErrors::Provocations ProvokedErrors::OfKeys() {
  const auto with = [this](const std::string& key) {
    return [this, key] { return CallWithKeys(key); };
  };
  const std::string limited = KeyText("limited", std::string(43, 's'));
  return {{"KEY_LIMIT_EXCEEDED",
           [this, limited] {
             CallWithKeys(limited);
             return CallWithKeys(limited);
           }},
          {"KEY_MISSING", with("")},
          {"KEY_INVALID", with(KeyText("reader", std::string(43, 'x')))},
          {"KEY_EXPIRED", with(KeyText("late", std::string(43, 's')))},
          {"PERMISSION_DENIED", with(KeyText("reader", std::string(43, 's')))}};
}

ProvokedErrors::Provocations ProvokedErrors::OfStops() {
  const auto search = [this](const StopToken& stop) {
    return ErrorOf(
        ToProtoStatus(server_.engine().Search(QueryForTorus(), stop).status(),
                      "the request"));
  };
  return {
      {"DEADLINE_EXCEEDED",
       [search] {
         return search(StopToken({}, absl::Now() - absl::Seconds(1)));
       }},
      {"CANCELLED", [search] {
         std::stop_source source;
         source.request_stop();
         return search(StopToken(source.get_token(), absl::InfiniteFuture()));
       }}};
}

ErrorOf ProvokedErrors::DamageAGraph() {
  TestServer server;
  server.Start();
  server.MakeCollection("c");
  server.AddShape("c", "torus", TorusOff());
  server.Stop(absl::Seconds(10));
  {
    auto database = SqliteConnection::Open(server.folder() / "catalog.db",
                                           SqliteConnection::Mode::kReadWrite);
    EXPECT_TRUE(database.ok()) << database.status();
    const absl::Status damaged =
        (*database)->Execute("UPDATE graph SET arg = zeroblob(length(arg))");
    EXPECT_TRUE(damaged.ok()) << damaged;
  }
  server.Start();
  return Call(server, "ShapeService/GetShapeGraph",
              Named<v1::GetShapeGraphRequest>(kTorusName));
}

ErrorOf ProvokedErrors::ImportFromOutside() {
  const TemporaryDirectory files;
  const auto root = ImportRoot::Open(files.path());
  EXPECT_TRUE(root.ok()) << root.status();
  TestServerOptions options;
  options.rpc.import_source = root->get();
  TestServer server(options);
  server.Start();
  server.MakeCollection("c");
  v1::ImportShapesRequest request;
  request.set_parent("collections/c");
  request.set_folder("..");
  grpc::ClientContext context;
  google::longrunning::Operation operation;
  EXPECT_TRUE(server.ingest().ImportShapes(&context, request, &operation).ok());
  return ErrorOf(WaitForOperation(server, operation.name()).error());
}

ProvokedErrors::Provocations ProvokedErrors::OfFaults() {
  return {{"STORE_FULL",
           [] {
             TestServerOptions options;
             options.directory.min_free_bytes = int64_t{1} << 60;
             TestServer server(options);
             server.Start();
             v1::CreateCollectionRequest request;
             request.set_collection_id("c");
             return Call(server, "CollectionService/CreateCollection", request);
           }},
          {"STORE_UNAVAILABLE",
           [] {
             TestServer server;
             server.Start();
             server.MakeCollection("c");
             std::filesystem::remove_all(server.folder() / "incoming");
             return Call(server, "ShapeService/CreateShape",
                         NewShapeOf("torus", TorusOff()));
           }},
          {"STORED_DATA_DAMAGED", [] { return DamageAGraph(); }},
          {"FILE_UNREADABLE", [] { return ImportFromOutside(); }},
          {"DRAINING", [] {
             TestServer server;
             server.Start();
             EXPECT_TRUE(server.engine().Close().ok());
             return Call(server, "CollectionService/GetCollection",
                         Named<v1::GetCollectionRequest>("collections/c"));
           }}};
}

// To a server on FaultyCatalog that has no snapshots.
ErrorOf ProvokedErrors::CallFaulty(const std::string& method,
                                   const google::protobuf::Message& request) {
  std::promise<void> loaded;
  auto engine = Engine::Create(
      {}, std::make_unique<FaultyCatalog>(loaded.get_future().share()),
      std::make_unique<MemoryMeshStore>());
  EXPECT_TRUE(engine.ok()) << engine.status();
  RpcServerOptions options;
  options.listen = "127.0.0.1:0";
  auto rpc = RpcServer::Start(options, **engine, server_.telemetry());
  EXPECT_TRUE(rpc.ok()) << rpc.status();
  const ErrorOf error(
      CallGenerically(grpc::CreateChannel((*rpc)->address(),
                                          grpc::InsecureChannelCredentials()),
                      "/argmesh.v1." + method, request, ""));
  loaded.set_value();
  EXPECT_TRUE((*rpc)->Shutdown(absl::Now() + absl::Seconds(10)));
  EXPECT_TRUE((*engine)->Close().ok());
  return error;
}

ProvokedErrors::Provocations ProvokedErrors::OfFaultyEngines() {
  return {
      {"INDEX_LOADING",
       [this] {
         return CallFaulty("SearchService/SearchShapes", SearchFor(kTorusName));
       }},
      {"INTERNAL",
       [this] {
         return CallFaulty("CollectionService/GetCollection",
                           Named<v1::GetCollectionRequest>("collections/c"));
       }},
      {"IMPORT_NOT_ENABLED",
       [this] {
         v1::ImportShapesRequest request;
         request.set_parent("collections/c");
         return CallFaulty("IngestService/ImportShapes", request);
       }},
      {"METHOD_NOT_SERVED", [this] {
         return CallFaulty("AdminService/GetSnapshot",
                           Named<v1::GetSnapshotRequest>("snapshots/s"));
       }}};
}

}  // namespace argmesh
