// Requests of every rpc that answers one message with one, handed to the very
// bodies that serve it, on an engine with two shapes.
//
// Whatever the request: an answer that can be sent, or a refusal with a reason
// that is not the server's fault. The first byte says which rpc, the others are
// the request.
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <ostream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "absl/time/clock.h"
#include "core/base/random.h"
#include "core/mesh/mesh_write.h"
#include "server/engine/engine.h"
#include "server/rpc/access_rules.h"
#include "server/rpc/admin_service.h"
#include "server/rpc/collection_service.h"
#include "server/rpc/ingest_service.h"
#include "server/rpc/operations_service.h"
#include "server/rpc/request_names.h"
#include "server/rpc/search_service.h"
#include "server/rpc/shape_service.h"
#include "server/rpc/status.h"
#include "tests/fuzz/request_mutator.h"
#include "tests/fuzz/require.h"
#include "tests/support/memory_catalog.h"
#include "tests/support/memory_mesh_store.h"
#include "tests/support/test_meshes.h"

extern "C" size_t LLVMFuzzerMutate(uint8_t* data, size_t size, size_t max_size);

namespace argmesh {
namespace {

using google::protobuf::Message;

constexpr absl::Duration kPatience = absl::Milliseconds(200);

// Nothing is kept of what the log says.
std::ostream& NoLog() {
  static std::ostream none(nullptr);
  return none;
}

std::unique_ptr<Engine> MakeEngine(std::unique_ptr<Catalog> catalog,
                                   std::unique_ptr<MeshStore> meshes) {
  EngineOptions options;
  options.pool.threads = {1, 1, 1, 1};
  options.mesh_limits.max_vertices = 500;
  options.mesh_limits.max_faces = 1000;
  auto engine = Engine::Create(options, std::move(catalog), std::move(meshes));
  Require(engine.ok() && (*engine)->WaitUntilServing().ok(), "an engine");
  return *std::move(engine);
}

void AddShapes(Engine& engine) {
  NewCollection collection;
  collection.id = "c";
  collection.settings.vertex_budget = 100;
  collection.settings.uniform_cells = 4;
  collection.metadata_keys = {{"key", MetadataType::kNumber}};
  Require(engine.CreateCollection(collection).ok(), "a collection");
  for (const char* id : {"a", "b"}) {
    NewShape shape;
    shape.collection = "c";
    shape.id = id;
    shape.metadata = {{"key", "1"}};
    const auto mesh = SerializeMesh(MakeTorus(2, 0.5, 12, 8), MeshFormat::kOff);
    Require(mesh.ok() && engine.AddShape(shape, *mesh).ok(), "a shape");
  }
}

// What every service begins with; made once, as it takes far longer than a
// request.
struct Content {
  Content() {
    auto filled = std::make_unique<MemoryCatalog>();
    auto filled_meshes = std::make_unique<MemoryMeshStore>();
    const MemoryCatalog& from = *filled;
    const MemoryMeshStore& from_meshes = *filled_meshes;
    const auto engine = MakeEngine(std::move(filled), std::move(filled_meshes));
    AddShapes(*engine);
    catalog = from.Copy();
    meshes = from_meshes.Copy();
  }

  std::unique_ptr<MemoryCatalog> catalog;
  std::unique_ptr<MemoryMeshStore> meshes;
};

// Everything a request meets below gRPC.
class Service {
 public:
  explicit Service(const Content& content)
      : telemetry_(*Telemetry::Open({}, NoLog())),
        engine_(MakeEngine(content.catalog->Copy(), content.meshes->Copy())),
        environment_(*engine_, *telemetry_, "fuzz", {}, nullptr),
        admin_(environment_),
        collections_(environment_),
        ingest_(environment_),
        operations_(environment_),
        search_(environment_),
        shapes_(environment_) {
    for (const RpcService* service : std::initializer_list<const RpcService*>{
             &admin_, &collections_, &ingest_, &operations_, &search_,
             &shapes_}) {
      for (const UnaryMethod& method : service->unary_methods()) {
        methods_.push_back(&method);
      }
    }
  }

  const UnaryMethod& Method(uint8_t number) const {
    return *methods_[number % methods_.size()];
  }

  // False when it may have changed what is stored.
  bool Call(const UnaryMethod& method, const Message& request) {
    const Caller caller;
    const std::unique_ptr<Message> response(method.response.New());
    const StopToken stop({}, absl::Now() + kPatience);
    (void)CheckNames(caller, method.plan.method, RequestNames(request));
    const absl::Status status =
        method.body({environment_, stop, caller}, request, response.get());
    Check(status, *response);
    return !status.ok() || !FindAccessRule(method.plan.method)->writes;
  }

 private:
  static void Check(const absl::Status& status, const Message& response) {
    if (status.ok()) {
      const std::string bytes = response.SerializeAsString();
      Require(bytes.size() <= kMaxMessageBytes, "the answer fits a message");
      Require(std::unique_ptr<Message>(response.New())->ParseFromString(bytes),
              "the answer can be read");
      return;
    }
    const auto reason = ReasonOf(status);
    Require(reason.has_value(), "a refusal has a reason");
    Require(*reason != ErrorReason::kInternal &&
                *reason != ErrorReason::kStoredDataDamaged &&
                *reason != ErrorReason::kStoreUnavailable,
            "a refusal is not the server's fault");
    Require(google::rpc::Status().ParseFromString(
                ToProtoStatus(status, "id").SerializeAsString()),
            "a refusal can be read");
  }

  std::unique_ptr<Telemetry> telemetry_;
  std::unique_ptr<Engine> engine_;
  ServiceEnvironment environment_;
  AdminServiceImpl admin_;
  CollectionServiceImpl collections_;
  IngestServiceImpl ingest_;
  OperationsServiceImpl operations_;
  SearchServiceImpl search_;
  ShapeServiceImpl shapes_;
  std::vector<const UnaryMethod*> methods_;
};

std::unique_ptr<Service> MakeService() {
  static const Content content;
  return std::make_unique<Service>(content);
}

// The same at the beginning of every run.
std::unique_ptr<Service>& TheService() {
  static auto service = MakeService();
  return service;
}

std::unique_ptr<Message> ParseRequest(const UnaryMethod& method,
                                      const uint8_t* data, size_t size) {
  std::unique_ptr<Message> request(method.request.New());
  return request->ParseFromArray(data, static_cast<int>(size))
             ? std::move(request)
             : nullptr;
}

}  // namespace
}  // namespace argmesh

// Outside of the first run, whose time is limited.
extern "C" int LLVMFuzzerInitialize(int*, char***) {
  argmesh::TheService();
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using argmesh::TheService;
  if (size == 0) return 0;
  const argmesh::UnaryMethod& method = TheService()->Method(data[0]);
  const auto request = argmesh::ParseRequest(method, data + 1, size - 1);
  if (request != nullptr && !TheService()->Call(method, *request)) {
    TheService().reset();
    TheService() = argmesh::MakeService();
  }
  return 0;
}

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size,
                                          size_t max_size, unsigned int seed) {
  constexpr double kBlindShare = 0.2;
  constexpr double kOtherMethodShare = 0.1;
  argmesh::Random random(seed);
  if (size == 0 || random.Uniform() < kBlindShare) {
    return LLVMFuzzerMutate(data, size, max_size);
  }
  if (random.Uniform() < kOtherMethodShare)
    data[0] = static_cast<uint8_t>(seed);
  const argmesh::UnaryMethod& method = argmesh::TheService()->Method(data[0]);
  auto request = argmesh::ParseRequest(method, data + 1, size - 1);
  if (request == nullptr) request.reset(method.request.New());
  do {
    argmesh::MutateRequest(*request, random);
  } while (random.Uniform() < 0.5);
  const std::string bytes = request->SerializeAsString();
  if (bytes.size() + 1 > max_size) return size;
  std::memcpy(data + 1, bytes.data(), bytes.size());
  return bytes.size() + 1;
}
