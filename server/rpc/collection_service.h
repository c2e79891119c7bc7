// argmesh.v1.CollectionService.
#ifndef ARGMESH_SERVER_RPC_COLLECTION_SERVICE_H_
#define ARGMESH_SERVER_RPC_COLLECTION_SERVICE_H_

#include "argmesh/v1/collection_service.grpc.pb.h"
#include "server/rpc/service_environment.h"

namespace argmesh {

class CollectionServiceImpl final
    : public v1::CollectionService::CallbackService {
 public:
  // `environment` must outlive the service.
  explicit CollectionServiceImpl(ServiceEnvironment& environment)
      : environment_(environment) {}

  grpc::ServerUnaryReactor* CreateCollection(
      grpc::CallbackServerContext* context,
      const v1::CreateCollectionRequest* request,
      v1::Collection* response) override;
  grpc::ServerUnaryReactor* GetCollection(
      grpc::CallbackServerContext* context,
      const v1::GetCollectionRequest* request,
      v1::Collection* response) override;
  grpc::ServerUnaryReactor* ListCollections(
      grpc::CallbackServerContext* context,
      const v1::ListCollectionsRequest* request,
      v1::ListCollectionsResponse* response) override;
  grpc::ServerUnaryReactor* UpdateCollection(
      grpc::CallbackServerContext* context,
      const v1::UpdateCollectionRequest* request,
      v1::Collection* response) override;
  grpc::ServerUnaryReactor* DeleteCollection(
      grpc::CallbackServerContext* context,
      const v1::DeleteCollectionRequest* request,
      v1::DeleteCollectionResponse* response) override;
  grpc::ServerUnaryReactor* ReindexCollection(
      grpc::CallbackServerContext* context,
      const v1::ReindexCollectionRequest* request,
      google::longrunning::Operation* response) override;

 private:
  ServiceEnvironment& environment_;
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_RPC_COLLECTION_SERVICE_H_
