#include "tests/reliability/small_service.h"

#include <chrono>

#include "core/mesh/mesh_write.h"
#include "tests/support/test_meshes.h"

namespace argmesh {
namespace {

constexpr auto kDeadline = std::chrono::seconds(20);
constexpr int kVertexBudget = 600;
constexpr double kMajorRadius = 2;
constexpr int kMajorSegments = 20;
constexpr int kMinorSegments = 12;
// So that the answer to a request of a few bytes may be large.
constexpr int kNotes = 15;
constexpr size_t kNoteBytes = 1000;

// Makes a call of `stub`: empty when it was answered, else why not.
template <typename Stub, typename Request, typename Response>
std::string Ask(Stub& stub,
                grpc::Status (Stub::*call)(grpc::ClientContext*, const Request&,
                                           Response*),
                const Request& request) {
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + kDeadline);
  Response response;
  return FailureOf((stub.*call)(&context, request, &response));
}

}  // namespace

std::string ShapeNamed(const std::string& id) {
  return std::string(kParts) + "/shapes/" + id;
}

std::shared_ptr<grpc::Channel> OwnChannel(const std::string& address) {
  grpc::ChannelArguments arguments;
  arguments.SetInt(GRPC_ARG_USE_LOCAL_SUBCHANNEL_POOL, 1);
  return grpc::CreateCustomChannel(address, grpc::InsecureChannelCredentials(),
                                   arguments);
}

std::string FailureOf(const grpc::Status& status) {
  if (status.ok()) return "";
  return "code " + std::to_string(status.error_code()) + ": " +
         status.error_message();
}

ShapeCaller::ShapeCaller(const std::string& address) {
  const auto channel = OwnChannel(address);
  collections_ = v1::CollectionService::NewStub(channel);
  shapes_ = v1::ShapeService::NewStub(channel);
  search_ = v1::SearchService::NewStub(channel);
}

std::string ShapeCaller::CreateCollection() {
  v1::CreateCollectionRequest request;
  request.set_collection_id("parts");
  request.mutable_collection()->mutable_settings()->set_vertex_budget(
      kVertexBudget);
  return Ask(*collections_, &v1::CollectionService::Stub::CreateCollection,
             request);
}

v1::CreateShapeRequest TorusRequest(const std::string& id,
                                    double minor_radius) {
  v1::CreateShapeRequest request;
  request.set_parent(kParts);
  request.set_shape_id(id);
  for (int i = 0; i < kNotes; ++i) {
    (*request.mutable_shape()->mutable_metadata())["note" + std::to_string(i)] =
        std::string(kNoteBytes, 'n');
  }
  request.mutable_mesh()->set_format(v1::MESH_FORMAT_OFF);
  request.mutable_mesh()->set_data(*SerializeMesh(
      MakeTorus(kMajorRadius, minor_radius, kMajorSegments, kMinorSegments),
      MeshFormat::kOff));
  return request;
}

std::string ShapeCaller::AddTorus(const std::string& id, double minor_radius) {
  return Ask(*shapes_, &v1::ShapeService::Stub::CreateShape,
             TorusRequest(id, minor_radius));
}

std::string ShapeCaller::Get(const std::string& id) {
  v1::GetShapeRequest request;
  request.set_name(ShapeNamed(id));
  return Ask(*shapes_, &v1::ShapeService::Stub::GetShape, request);
}

std::string ShapeCaller::Delete(const std::string& id) {
  v1::DeleteShapeRequest request;
  request.set_name(ShapeNamed(id));
  return Ask(*shapes_, &v1::ShapeService::Stub::DeleteShape, request);
}

std::string ShapeCaller::List() {
  v1::ListShapesRequest request;
  request.set_parent(kParts);
  return Ask(*shapes_, &v1::ShapeService::Stub::ListShapes, request);
}

std::string ShapeCaller::Search(const std::string& id) {
  v1::SearchShapesRequest request;
  request.set_parent(kParts);
  request.set_shape(ShapeNamed(id));
  return Ask(*search_, &v1::SearchService::Stub::SearchShapes, request);
}

std::string SmallService::Start(int shapes,
                                const std::vector<std::string>& options) {
  if (!installation_.StartServer(options)) return "the server does not start";
  ShapeCaller caller(address());
  std::string failure = caller.CreateCollection();
  for (int i = 0; failure.empty() && i < shapes; ++i) {
    failure = caller.AddTorus("torus-" + std::to_string(i),
                              0.3 + 0.7 * static_cast<double>(i) / shapes);
  }
  return failure;
}

}  // namespace argmesh
