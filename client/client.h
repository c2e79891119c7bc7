// A connection to an argmesh server: one method per call that it serves.
//
//   ASSIGN client = Client::Connect("127.0.0.1:7411");
//   v1::SearchShapesRequest request;
//   request.set_parent(CollectionName("parts"));
//   request.set_shape(ShapeName("parts", "valve-7"));
//   auto response = client->SearchShapes(request);
//
// Every call has the deadline of the options. Calls that change nothing, and
// those that the server knows by a request_id (filled in where it is empty),
// are tried again when the server cannot be reached or asks for it. A Client
// is safe to use from many threads.
//
// Fails    with the server's code and reason, see error_status.h;
//          kUnavailable       no server answers; IsUnreachable is true
//          kDeadlineExceeded  the time of the options is over
//          kDataLoss          a download that is not what was announced
#ifndef ARGMESH_CLIENT_CLIENT_H_
#define ARGMESH_CLIENT_CLIENT_H_

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "argmesh/v1/admin_service.pb.h"
#include "argmesh/v1/collection_service.pb.h"
#include "argmesh/v1/ingest_service.pb.h"
#include "argmesh/v1/search_service.pb.h"
#include "argmesh/v1/shape_service.pb.h"
#include "client/client_options.h"
#include "client/operation_watch.h"
#include "google/longrunning/operations.pb.h"

namespace argmesh {

// The file of a stored shape.
struct DownloadedMesh {
  v1::MeshFormat format = v1::MESH_FORMAT_UNSPECIFIED;
  std::string bytes;
};

// The graph of a shape and, where asked for, the labels of all its faces.
struct ShapeGraphWithLabels {
  v1::ShapeGraph graph;
  std::vector<v1::FaceLabels> face_labels;  // one a level, complete
};

class Client {
 public:
  // `target` is HOST:PORT. Does not wait for the server: the first call finds
  // out whether it is there. kInvalidArgument for an empty target and files of
  // the options that cannot be read.
  static absl::StatusOr<std::unique_ptr<Client>> Connect(
      std::string_view target, const ClientOptions& options = {});
  ~Client();
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  const std::string& target() const;
  const ClientOptions& options() const;

  // --- collections ---------------------------------------------------------
  absl::StatusOr<v1::Collection> CreateCollection(
      v1::CreateCollectionRequest request);
  absl::StatusOr<v1::Collection> GetCollection(std::string_view name);
  // One page.
  absl::StatusOr<v1::ListCollectionsResponse> ListCollections(
      const v1::ListCollectionsRequest& request);
  // All pages, until `visit` returns false.
  absl::Status ForEachCollection(
      const std::function<bool(const v1::Collection&)>& visit);
  absl::StatusOr<v1::Collection> UpdateCollection(
      v1::UpdateCollectionRequest request);
  absl::Status DeleteCollection(v1::DeleteCollectionRequest request);

  // --- shapes --------------------------------------------------------------
  absl::StatusOr<v1::Shape> CreateShape(v1::CreateShapeRequest request);
  // Of any size. `header` needs no size and digest: they are filled in.
  absl::StatusOr<v1::Shape> UploadShape(v1::UploadShapeHeader header,
                                        std::string_view bytes);
  absl::StatusOr<v1::Shape> GetShape(std::string_view name);
  absl::StatusOr<v1::ListShapesResponse> ListShapes(
      const v1::ListShapesRequest& request);
  absl::Status ForEachShape(std::string_view collection_name,
                            const std::function<bool(const v1::Shape&)>& visit,
                            const std::string& filter = "");
  absl::StatusOr<v1::DeleteShapeResponse> DeleteShape(
      v1::DeleteShapeRequest request);
  // Checked against the announced size and SHA-256.
  absl::StatusOr<DownloadedMesh> DownloadMesh(std::string_view name);
  // As many calls as the labels of all faces take. `level` counts only for
  // FACE_LABEL_VIEW_LEVEL.
  absl::StatusOr<ShapeGraphWithLabels> GetShapeGraph(
      std::string_view name, v1::FaceLabelView view = v1::FACE_LABEL_VIEW_NONE,
      int level = 0);

  // --- search --------------------------------------------------------------
  // A query mesh may be of any size: one that does not fit in a message goes
  // over StreamSearchShapes, whose answer is the same.
  absl::StatusOr<v1::SearchShapesResponse> SearchShapes(
      const v1::SearchShapesRequest& request);
  absl::StatusOr<v1::CompareShapesResponse> CompareShapes(
      const v1::CompareShapesRequest& request);

  // --- long work -----------------------------------------------------------
  // Each waits until the server is done. When the server cannot be reached any
  // more it goes on there all the same.
  absl::StatusOr<v1::ReindexCollectionResponse> ReindexCollection(
      const v1::ReindexCollectionRequest& request,
      const OperationWatch& watch = {});
  absl::StatusOr<v1::ImportShapesResponse> ImportShapes(
      const v1::ImportShapesRequest& request, const OperationWatch& watch = {});

  // What the server has of these and of snapshots and checks, by id: running
  // and ended, whoever asked for it.
  absl::StatusOr<std::vector<google::longrunning::Operation>> ListOperations();
  // `operations/{id}` ends soon with kCancelled. Does not wait for that.
  absl::Status CancelOperation(const std::string& name);

  // --- the server ----------------------------------------------------------
  absl::StatusOr<v1::GetServerInfoResponse> GetServerInfo();
  // --- snapshots and checks ------------------------------------------------
  // Each waits until the server is done, longer than the options' time if need
  // be. kInternal when the answer is not what it should be.
  absl::StatusOr<v1::Snapshot> CreateSnapshot(std::string_view id);
  // Of one collection, `collections/{collection}`; empty: of everything.
  absl::StatusOr<v1::VerifyStorageResponse> VerifyStorage(
      const std::string& collection = "");
  absl::StatusOr<std::vector<v1::Snapshot>> ListSnapshots();
  absl::Status DeleteSnapshot(std::string_view name);
  // Hands out the bytes in order. They may be used once it returns OK: then
  // size and SHA-256 are those the server has. Never tried again.
  absl::StatusOr<v1::Snapshot> DownloadSnapshot(
      std::string_view name,
      const std::function<absl::Status(std::string_view)>& write);

  // "SERVING", "NOT_SERVING", "UNKNOWN" or "SERVICE_UNKNOWN" of
  // grpc.health.v1; of the whole server when `service` is empty. One attempt.
  absl::StatusOr<std::string> CheckHealth(std::string_view service);

  // For Ingestor.
  struct Parts;
  Parts& parts() { return *parts_; }

 private:
  explicit Client(std::unique_ptr<Parts> parts);

  std::unique_ptr<Parts> parts_;
};

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_CLIENT_H_
