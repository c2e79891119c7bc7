#include "tests/reliability/small_service.h"

#include <chrono>

#include "core/base/sha256.h"
#include "core/mesh/mesh_write.h"
#include "tests/support/test_meshes.h"

namespace argmesh {
namespace {

constexpr auto kCallDeadline = std::chrono::seconds(20);
constexpr int kVertexBudget = 600;
constexpr double kMajorRadius = 2;
constexpr int kMajorSegments = 20;
constexpr int kMinorSegments = 12;
// So that the answer to a request of a few bytes may be large.
constexpr int kNotes = 15;
constexpr size_t kNoteBytes = 1000;

void SetDeadline(grpc::ClientContext& context) {
  context.set_deadline(std::chrono::system_clock::now() + kCallDeadline);
}

// Makes a call of `stub`: empty when it was answered, else why not.
template <typename Stub, typename Request, typename Response>
std::string Ask(Stub& stub,
                grpc::Status (Stub::*call)(grpc::ClientContext*, const Request&,
                                           Response*),
                const Request& request) {
  grpc::ClientContext context;
  SetDeadline(context);
  Response response;
  return FailureOf((stub.*call)(&context, request, &response));
}

std::string TorusOff(double minor_radius) {
  return *SerializeMesh(
      MakeTorus(kMajorRadius, minor_radius, kMajorSegments, kMinorSegments),
      MeshFormat::kOff);
}

// What announces a mesh: the header of an upload or stream search, an item.
template <typename Header>
void Announce(const std::string& mesh, Header& header) {
  header.set_format(v1::MESH_FORMAT_OFF);
  header.set_size_bytes(static_cast<int64_t>(mesh.size()));
  header.set_sha256(ToHex(ComputeSha256(mesh)));
}

std::string CodeText(grpc::StatusCode code) {
  return "code " + std::to_string(code) + ": ";
}

// `failure` of a call that had to fail with `code`.
std::string Expect(const std::string& failure, grpc::StatusCode code) {
  if (failure.starts_with(CodeText(code))) return "";
  return failure.empty() ? "answered instead of " + CodeText(code) : failure;
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
  return CodeText(status.error_code()) + status.error_message();
}

bool IsOverloaded(const std::string& failure) {
  return failure.starts_with(CodeText(grpc::StatusCode::RESOURCE_EXHAUSTED));
}

ShapeCaller::ShapeCaller(const std::string& address) {
  const auto channel = OwnChannel(address);
  collections_ = v1::CollectionService::NewStub(channel);
  shapes_ = v1::ShapeService::NewStub(channel);
  search_ = v1::SearchService::NewStub(channel);
  ingest_ = v1::IngestService::NewStub(channel);
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
  request.mutable_mesh()->set_data(TorusOff(minor_radius));
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

std::string ShapeCaller::SearchByMesh(v1::SearchMode mode,
                                      double minor_radius) {
  v1::SearchShapesRequest request;
  request.set_parent(kParts);
  request.set_mode(mode);
  request.mutable_mesh()->set_data(TorusOff(minor_radius));
  return Ask(*search_, &v1::SearchService::Stub::SearchShapes, request);
}

std::string ShapeCaller::StreamSearch(double minor_radius) {
  const std::string mesh = TorusOff(minor_radius);
  grpc::ClientContext context;
  SetDeadline(context);
  const auto stream = search_->StreamSearchShapes(&context);
  v1::StreamSearchShapesRequest request;
  request.mutable_header()->mutable_search()->set_parent(kParts);
  Announce(mesh, *request.mutable_header());
  stream->Write(request);
  request.set_chunk(mesh);
  stream->Write(request);
  stream->WritesDone();
  v1::StreamSearchShapesResponse response;
  while (stream->Read(&response)) {
  }
  return FailureOf(stream->Finish());
}

std::string ShapeCaller::Upload(const std::string& id, double minor_radius) {
  const std::string mesh = TorusOff(minor_radius);
  grpc::ClientContext context;
  SetDeadline(context);
  v1::Shape shape;
  const auto writer = shapes_->UploadShape(&context, &shape);
  v1::UploadShapeRequest request;
  request.mutable_header()->set_parent(kParts);
  request.mutable_header()->set_shape_id(id);
  Announce(mesh, *request.mutable_header());
  writer->Write(request);
  request.set_chunk(mesh);
  writer->Write(request);
  writer->WritesDone();
  return FailureOf(writer->Finish());
}

std::string ShapeCaller::Ingest(const std::string& id, double minor_radius) {
  const std::string mesh = TorusOff(minor_radius);
  grpc::ClientContext context;
  SetDeadline(context);
  const auto stream = ingest_->IngestShapes(&context);
  v1::IngestShapesRequest request;
  request.mutable_hello()->set_collection(kParts);
  stream->Write(request);
  request.mutable_item()->set_key(id);
  request.mutable_item()->set_shape_id(id);
  Announce(mesh, *request.mutable_item());
  stream->Write(request);
  request.set_chunk(mesh);
  stream->Write(request);
  stream->WritesDone();
  std::string failure = "no result";
  v1::IngestShapesResponse response;
  while (stream->Read(&response)) {
    if (response.has_result()) failure = response.result().error().message();
  }
  const grpc::Status status = stream->Finish();
  return status.ok() ? failure : FailureOf(status);
}

std::string ShapeCaller::GetMissing() {
  return Expect(Get("nobody"), grpc::StatusCode::NOT_FOUND);
}

std::string ShapeCaller::AddBroken() {
  v1::CreateShapeRequest request = TorusRequest("broken", 1);
  request.mutable_mesh()->set_data("OFF\n1 1 0\n");
  return Expect(Ask(*shapes_, &v1::ShapeService::Stub::CreateShape, request),
                grpc::StatusCode::INVALID_ARGUMENT);
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
