#include "tests/support/rpc_methods.h"

#include "argmesh/v1/admin_service.pb.h"
#include "argmesh/v1/collection_service.pb.h"
#include "argmesh/v1/ingest_service.pb.h"
#include "argmesh/v1/search_service.pb.h"
#include "argmesh/v1/shape_service.pb.h"
#include "google/longrunning/operations.pb.h"

namespace argmesh {

using google::protobuf::MethodDescriptor;
using google::protobuf::ServiceDescriptor;

std::vector<const MethodDescriptor*> AllMethods() {
  std::vector<const MethodDescriptor*> methods;
  for (const auto* file :
       {v1::GetServerInfoRequest::descriptor()->file(),
        v1::GetCollectionRequest::descriptor()->file(),
        v1::IngestHello::descriptor()->file(),
        v1::SearchShapesRequest::descriptor()->file(),
        v1::GetShapeRequest::descriptor()->file(),
        google::longrunning::Operation::descriptor()->file()}) {
    for (int s = 0; s < file->service_count(); ++s) {
      const ServiceDescriptor* service = file->service(s);
      for (int m = 0; m < service->method_count(); ++m) {
        methods.push_back(service->method(m));
      }
    }
  }
  return methods;
}

}  // namespace argmesh
