#include "server/rpc/ingest_service.h"

#include "server/rpc/ingest_reactor.h"
#include "server/rpc/unary_reactor.h"

namespace argmesh {

grpc::ServerBidiReactor<v1::IngestShapesRequest, v1::IngestShapesResponse>*
IngestServiceImpl::IngestShapes(grpc::CallbackServerContext* context) {
  return StartReactor<IngestReactor>(environment_, context);
}

grpc::ServerUnaryReactor* IngestServiceImpl::ImportShapes(
    grpc::CallbackServerContext* context,
    const v1::ImportShapesRequest* request, google::longrunning::Operation*) {
  return UnaryReactor::NotServed(environment_, context, request,
                                 "IngestService.ImportShapes");
}

}  // namespace argmesh
