#include "server/rpc/shape_service.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "absl/strings/str_format.h"
#include "argmesh/v1/shape_service.pb.h"
#include "core/base/status_macros.h"
#include "server/engine/error_reason.h"
#include "server/rpc/convert_shape.h"
#include "server/rpc/convert_update.h"
#include "server/rpc/convert_upload.h"
#include "server/rpc/download_reactor.h"
#include "server/rpc/graph_answer.h"
#include "server/rpc/resource_name.h"
#include "server/rpc/status.h"
#include "server/rpc/upload_reactor.h"

namespace argmesh {
namespace {

absl::Status CreateShape(const UnaryCall& call,
                         const v1::CreateShapeRequest& request,
                         v1::Shape* response) {
  ARGMESH_ASSIGN_OR_RETURN(NewShape shape, FromProto(request));
  shape.request.principal = call.caller.principal;
  ARGMESH_ASSIGN_OR_RETURN(const AddedShape added,
                           call.environment.engine.AddShape(
                               shape, request.mesh().data(), call.stop));
  *response = ToProto(added.record);
  return absl::OkStatus();
}

absl::Status GetShape(const UnaryCall& call, const v1::GetShapeRequest& request,
                      v1::Shape* response) {
  ARGMESH_ASSIGN_OR_RETURN(const ShapeRef shape,
                           ParseShapeName("name", request.name()));
  ARGMESH_ASSIGN_OR_RETURN(const ShapeRecord record,
                           call.environment.engine.GetShape(shape));
  *response = ToProto(record);
  return absl::OkStatus();
}

absl::Status ListShapes(const UnaryCall& call,
                        const v1::ListShapesRequest& request,
                        v1::ListShapesResponse* response) {
  ARGMESH_ASSIGN_OR_RETURN(const std::string collection,
                           ParseCollectionName("parent", request.parent()));
  ARGMESH_ASSIGN_OR_RETURN(
      const ShapePage page,
      call.environment.engine.ListShapes(collection,
                                         {.page_size = request.page_size(),
                                          .page_token = request.page_token(),
                                          .max_bytes = kMaxAnswerBytes},
                                         request.filter()));
  for (const ShapeRecord& record : page.shapes) {
    *response->add_shapes() = ToProto(record);
  }
  response->set_next_page_token(page.next_page_token);
  return absl::OkStatus();
}

absl::Status UpdateShape(const UnaryCall& call,
                         const v1::UpdateShapeRequest& request,
                         v1::Shape* response) {
  ARGMESH_ASSIGN_OR_RETURN(ShapePatch patch, FromProto(request));
  ARGMESH_ASSIGN_OR_RETURN(
      const ShapeRecord record,
      call.environment.engine.UpdateShape(
          std::move(patch), {call.caller.principal, request.request_id()}));
  *response = ToProto(record);
  return absl::OkStatus();
}

absl::Status DeleteShape(const UnaryCall& call,
                         const v1::DeleteShapeRequest& request,
                         v1::DeleteShapeResponse* response) {
  ShapeRemoval removal;
  ARGMESH_ASSIGN_OR_RETURN(removal.shape,
                           ParseShapeName("name", request.name()));
  removal.etag = request.etag();
  removal.request = {call.caller.principal, request.request_id()};
  ARGMESH_ASSIGN_OR_RETURN(const int64_t generation,
                           call.environment.engine.DeleteShape(removal));
  response->set_generation(generation);
  return absl::OkStatus();
}

// The shapes that a batch names: 1 .. kMaxPageSize, all of `parent`.
template <typename Request>
absl::StatusOr<std::vector<ShapeRef>> NamedShapes(const Request& request) {
  ARGMESH_ASSIGN_OR_RETURN(const std::string collection,
                           ParseCollectionName("parent", request.parent()));
  if (request.names().empty()) return FieldRequired("names");
  if (request.names_size() > kMaxPageSize) {
    return FieldInvalid("names",
                        absl::StrFormat("%d names, the limit is %d",
                                        request.names_size(), kMaxPageSize));
  }
  std::vector<ShapeRef> shapes;
  for (const std::string& name : request.names()) {
    ARGMESH_ASSIGN_OR_RETURN(ShapeRef shape, ParseShapeName("names", name));
    if (shape.collection != collection) {
      return FieldInvalid("names", name + " is not of " + request.parent());
    }
    shapes.push_back(std::move(shape));
  }
  return shapes;
}

absl::Status BatchGetShapes(const UnaryCall& call,
                            const v1::BatchGetShapesRequest& request,
                            v1::BatchGetShapesResponse* response) {
  ARGMESH_ASSIGN_OR_RETURN(const std::vector<ShapeRef> shapes,
                           NamedShapes(request));
  int64_t bytes = 0;
  for (const ShapeRef& shape : shapes) {
    ARGMESH_RETURN_IF_ERROR(call.stop.Check());
    ARGMESH_ASSIGN_OR_RETURN(const ShapeRecord record,
                             call.environment.engine.GetShape(shape));
    v1::Shape& added = *response->add_shapes();
    added = ToProto(record);
    bytes += static_cast<int64_t>(added.ByteSizeLong());
    if (bytes > kMaxAnswerBytes) {
      return MakeError(ErrorReason::kResponseTooLarge,
                       "the shapes do not fit in one answer: ask for fewer");
    }
  }
  return absl::OkStatus();
}

absl::Status BatchDeleteShapes(const UnaryCall& call,
                               const v1::BatchDeleteShapesRequest& request,
                               v1::BatchDeleteShapesResponse* response) {
  ARGMESH_ASSIGN_OR_RETURN(const std::vector<ShapeRef> shapes,
                           NamedShapes(request));
  ShapesDelete removal;
  removal.collection = shapes.front().collection;
  std::vector<std::string>& ids = removal.ids;
  ids.reserve(shapes.size());
  for (const ShapeRef& shape : shapes) ids.push_back(shape.id);
  std::sort(ids.begin(), ids.end());
  const auto twice = std::adjacent_find(ids.begin(), ids.end());
  if (twice != ids.end()) {
    return FieldInvalid("names", *twice + " is named twice");
  }
  ARGMESH_RETURN_IF_ERROR(call.stop.Check());
  ARGMESH_ASSIGN_OR_RETURN(
      const int64_t generation,
      call.environment.engine.DeleteShapes(
          std::move(removal), {call.caller.principal, request.request_id()}));
  response->set_generation(generation);
  return absl::OkStatus();
}

absl::Status GetShapeGraph(const UnaryCall& call,
                           const v1::GetShapeGraphRequest& request,
                           v1::GetShapeGraphResponse* response) {
  ARGMESH_ASSIGN_OR_RETURN(*response,
                           AnswerGraph(call.environment.engine, request));
  return absl::OkStatus();
}

}  // namespace

ShapeServiceImpl::ShapeServiceImpl(ServiceEnvironment& environment)
    : RpcService(environment) {
  Unary({"ShapeService.CreateShape", WorkClass::kCompute, &environment.uploads},
        CreateShape);
  Stream<UploadReactor>("ShapeService.UploadShape");
  Unary({"ShapeService.GetShape"}, GetShape);
  Unary({"ShapeService.ListShapes", WorkClass::kBulk}, ListShapes);
  Unary({"ShapeService.UpdateShape"}, UpdateShape);
  Unary({"ShapeService.DeleteShape"}, DeleteShape);
  Unary({"ShapeService.BatchGetShapes", WorkClass::kBulk}, BatchGetShapes);
  Unary({"ShapeService.BatchDeleteShapes", WorkClass::kBulk},
        BatchDeleteShapes);
  Stream<DownloadReactor>("ShapeService.DownloadMesh");
  Unary({"ShapeService.GetShapeGraph", WorkClass::kBulk}, GetShapeGraph);
}

}  // namespace argmesh
