#include "tests/integration/provoked_errors.h"

#include "core/base/sha256.h"
#include "core/graph/shape_graph.h"

namespace argmesh {
namespace {

TestServerOptions TightOptions() {
  TestServerOptions options;
  options.engine.mesh_limits.max_bytes = 1 << 20;
  options.rpc.limits.max_inflight_ingests = 1;
  options.rpc.limits.ingest_credit_items = 1;
  options.rpc.limits.stream_idle_timeout = absl::Milliseconds(1500);
  return options;
}

}  // namespace

v1::CreateShapeRequest NewShapeOf(const std::string& id,
                                  const std::string& mesh) {
  v1::CreateShapeRequest request;
  request.set_parent("collections/c");
  request.set_shape_id(id);
  request.mutable_mesh()->set_data(mesh);
  return request;
}

v1::SearchShapesRequest SearchFor(const std::string& shape) {
  v1::SearchShapesRequest request;
  request.set_parent("collections/c");
  request.set_shape(shape);
  return request;
}

ProvokedErrors::ProvokedErrors() : server_(TightOptions()) {
  server_.Start();
  server_.MakeCollection("c");
  server_.AddShape("c", "torus", TorusOff());
}

ErrorOf ProvokedErrors::Call(TestServer& server, const std::string& method,
                             const Message& request, const std::string& key) {
  return ErrorOf(
      CallGenerically(server.channel(), "/argmesh.v1." + method, request, key));
}

ProvokedErrors::Provocations ProvokedErrors::All() {
  Provocations all;
  for (auto& some : {OfRequests(), OfFilters(), OfMeshes(), OfResources(),
                     OfSnapshots(), OfGraphs(), OfStreams(), OfKeys(),
                     OfStops(), OfFaults(), OfFaultyEngines()}) {
    all.insert(some.begin(), some.end());
  }
  return all;
}

ErrorOf ProvokedErrors::Upload(
    const std::function<void(v1::UploadShapeHeader&)>& change,
    const std::string& chunk) {
  const std::string off = TorusOff();
  v1::UploadShapeRequest request;
  v1::UploadShapeHeader& header = *request.mutable_header();
  header.set_parent("collections/c");
  header.set_shape_id("uploaded");
  header.set_size_bytes(static_cast<int64_t>(off.size()));
  header.set_sha256(ToHex(ComputeSha256(off)));
  change(header);
  grpc::ClientContext context;
  v1::Shape shape;
  const auto writer = server_.shapes().UploadShape(&context, &shape);
  writer->Write(request);
  request.set_chunk(chunk);
  writer->Write(request);
  writer->WritesDone();
  return ErrorOf(writer->Finish());
}

ProvokedErrors::Provocations ProvokedErrors::OfRequests() {
  const auto create = [](const std::string& id) {
    v1::CreateCollectionRequest request;
    request.set_collection_id(id);
    request.set_request_id("6f9619ff-8b86-d011-b42d-00c04fc964ff");
    return request;
  };
  return {{"FIELD_INVALID",
           Calling("SearchService/SearchShapes", SearchFor(kTorusName),
                   [](auto& request) { request.set_limit(-1); })},
          {"FIELD_REQUIRED",
           Calling("SearchService/SearchShapes", SearchFor(kTorusName),
                   [](auto& request) { request.clear_query(); })},
          {"NAME_INVALID",
           Calling("SearchService/SearchShapes", SearchFor("torus"))},
          {"PAGE_TOKEN_INVALID",
           Calling("CollectionService/ListCollections",
                   v1::ListCollectionsRequest(),
                   [](auto& request) { request.set_page_token("x"); })},
          {"REQUEST_ID_REUSED", [this, create] {
             Call(server_, "CollectionService/CreateCollection",
                  create("first"));
             return Call(server_, "CollectionService/CreateCollection",
                         create("second"));
           }}};
}

ProvokedErrors::Provocations ProvokedErrors::OfFilters() {
  return {{"FILTER_INVALID",
           Calling("SearchService/SearchShapes", SearchFor(kTorusName),
                   [](auto& request) { request.set_filter("("); })},
          {"FILTER_KEY_UNDECLARED",
           Calling("SearchService/SearchShapes", SearchFor(kTorusName),
                   [](auto& request) { request.set_filter("mass < 2"); })}};
}

ProvokedErrors::Provocations ProvokedErrors::OfMeshes() {
  const auto creating = [this](const std::string& mesh) {
    return Calling("ShapeService/CreateShape", NewShapeOf("bad", mesh));
  };
  return {{"MESH_MALFORMED", creating("OFF\n3 1 0\n0 0 0\n1 0 0\n")},
          {"MESH_FORMAT_UNKNOWN", creating("this is no mesh")},
          {"MESH_EMPTY", creating("OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n")},
          {"MESH_DEGENERATE",
           creating("OFF\n3 1 0\n0 0 0\n1 0 0\n2 0 0\n3 0 1 2\n")},
          {"MESH_TOO_LARGE", creating(TorusOff() + std::string(1 << 20, '\n'))},
          {"MESH_SIZE_MISMATCH",
           [this] { return Upload([](auto&) {}, "too little"); }},
          {"MESH_DIGEST_MISMATCH",
           [this] {
             return Upload(
                 [](auto& header) {
                   header.set_sha256(ToHex(ComputeSha256("another")));
                 },
                 TorusOff());
           }},
          {"MESH_NOT_STORED", [this] {
             server_.MakeCollection("graphs", /*store_meshes=*/false);
             const v1::Shape shape =
                 server_.AddShape("graphs", "s", TorusOff());
             return Call(server_, "ShapeService/DownloadMesh",
                         Named<v1::DownloadMeshRequest>(shape.name()));
           }}};
}

ProvokedErrors::Provocations ProvokedErrors::OfResources() {
  const auto collection = [](const std::string& id) {
    v1::CreateCollectionRequest request;
    request.set_collection_id(id);
    return request;
  };
  return {{"COLLECTION_NOT_FOUND",
           Calling("CollectionService/GetCollection",
                   Named<v1::GetCollectionRequest>("collections/none"))},
          {"COLLECTION_EXISTS",
           Calling("CollectionService/CreateCollection", collection("c"))},
          {"COLLECTION_NOT_EMPTY",
           Calling("CollectionService/DeleteCollection",
                   Named<v1::DeleteCollectionRequest>("collections/c"))},
          {"SHAPE_NOT_FOUND",
           Calling("ShapeService/GetShape",
                   Named<v1::GetShapeRequest>("collections/c/shapes/none"))},
          {"SHAPE_EXISTS", Calling("ShapeService/CreateShape",
                                   NewShapeOf("torus", SphereOff()))},
          {"ETAG_MISMATCH",
           Calling("ShapeService/DeleteShape",
                   Named<v1::DeleteShapeRequest>(kTorusName),
                   [](auto& request) { request.set_etag("\"another\""); })},
          {"RESPONSE_TOO_LARGE", [this] {
             const std::map<std::string, std::string> notes = {
                 {"a", std::string(1000, 'x')},
                 {"b", std::string(1000, 'x')},
                 {"c", std::string(1000, 'x')},
                 {"d", std::string(1000, 'x')}};
             const v1::Shape shape =
                 server_.AddShape("c", "annotated", TorusOff(), notes);
             v1::BatchGetShapesRequest request;
             request.set_parent("collections/c");
             for (int i = 0; i < 1000; ++i) request.add_names(shape.name());
             return Call(server_, "ShapeService/BatchGetShapes", request);
           }}};
}

ProvokedErrors::Provocations ProvokedErrors::OfSnapshots() {
  return {
      {"SNAPSHOT_NOT_FOUND",
       Calling("AdminService/GetSnapshot",
               Named<v1::GetSnapshotRequest>("snapshots/none"))},
      {"SNAPSHOT_EXISTS",
       [this] {
         v1::CreateSnapshotRequest request;
         request.set_snapshot_id("one");
         google::longrunning::Operation operation;
         for (int i = 0; i < 2; ++i) {
           grpc::ClientContext start;
           server_.admin().CreateSnapshot(&start, request, &operation);
           grpc::ClientContext wait;
           google::longrunning::WaitOperationRequest until_done;
           until_done.set_name(operation.name());
           until_done.mutable_timeout()->set_seconds(60);
           server_.operations().WaitOperation(&wait, until_done, &operation);
         }
         return ErrorOf(operation.error());
       }},
      {"OPERATION_NOT_FOUND", [this] {
         return ErrorOf(CallGenerically(
             server_.channel(), "/google.longrunning.Operations/GetOperation",
             Named<google::longrunning::GetOperationRequest>(
                 "operations/6f9619ff-8b86-d011-b42d-00c04fc964ff"),
             ""));
       }}};
}

ProvokedErrors::Provocations ProvokedErrors::OfGraphs() {
  const auto with_graph = [](uint32_t version) {
    v1::SearchShapesRequest request = SearchFor(kTorusName);
    request.mutable_graph()->set_version(version);
    return request;
  };
  return {{"NODE_NOT_FOUND",
           Calling("SearchService/SearchShapes", SearchFor(kTorusName),
                   [](auto& request) { request.add_region_node_ids(99); })},
          {"GRAPH_VERSION_MISMATCH",
           Calling("SearchService/SearchShapes", with_graph(77))},
          {"GRAPH_INVALID", Calling("SearchService/SearchShapes",
                                    with_graph(kShapeGraphVersion))},
          {"GENERATION_NOT_REACHED",
           Calling("SearchService/SearchShapes", SearchFor(kTorusName),
                   [](auto& request) {
                     request.set_min_generation(int64_t{1} << 40);
                   })}};
}

}  // namespace argmesh
