// A server process with a small collection of shapes, and what a client asks
// it. Every call has a deadline of 20 s; a failed one comes back as its code
// and message.
#ifndef ARGMESH_TESTS_RELIABILITY_SMALL_SERVICE_H_
#define ARGMESH_TESTS_RELIABILITY_SMALL_SERVICE_H_

#include <grpcpp/grpcpp.h>

#include <memory>
#include <string>
#include <vector>

#include "argmesh/v1/collection_service.grpc.pb.h"
#include "argmesh/v1/ingest_service.grpc.pb.h"
#include "argmesh/v1/search_service.grpc.pb.h"
#include "argmesh/v1/shape_service.grpc.pb.h"
#include "tests/e2e/installation.h"

namespace argmesh {

inline constexpr char kParts[] = "collections/parts";

// Not the connection of another caller of this process.
std::shared_ptr<grpc::Channel> OwnChannel(const std::string& address);
// Code and message; empty when `status` is OK.
std::string FailureOf(const grpc::Status& status);
// The server had no time for the call.
bool IsOverloaded(const std::string& failure);

// For a torus whose answers are large, because of its metadata.
v1::CreateShapeRequest TorusRequest(const std::string& id, double minor_radius);

// A connection of its own.
class ShapeCaller {
 public:
  explicit ShapeCaller(const std::string& address);

  // Each: empty when it was answered.
  std::string CreateCollection();
  std::string AddTorus(const std::string& id, double minor_radius);
  std::string Delete(const std::string& id);
  std::string Get(const std::string& id);
  std::string List();
  std::string Search(const std::string& id);
  // By a torus that is not stored.
  std::string SearchByMesh(v1::SearchMode mode, double minor_radius);
  std::string StreamSearch(double minor_radius);
  // AddTorus in pieces, and as an ingest of one item.
  std::string Upload(const std::string& id, double minor_radius);
  std::string Ingest(const std::string& id, double minor_radius);
  // Empty when they failed as they should.
  std::string GetMissing();
  std::string AddBroken();

 private:
  std::unique_ptr<v1::CollectionService::Stub> collections_;
  std::unique_ptr<v1::ShapeService::Stub> shapes_;
  std::unique_ptr<v1::SearchService::Stub> search_;
  std::unique_ptr<v1::IngestService::Stub> ingest_;
};

class SmallService {
 public:
  // Starts the server and adds shapes "torus-0" .. ; a message when it cannot.
  std::string Start(int shapes, const std::vector<std::string>& options = {});

  Installation& installation() { return installation_; }
  const std::string& address() const { return installation_.address(); }
  pid_t pid() const { return installation_.server_pid(); }
  ShapeCaller Caller() const { return ShapeCaller(address()); }

 private:
  Installation installation_;
};

std::string ShapeNamed(const std::string& id);

}  // namespace argmesh

#endif  // ARGMESH_TESTS_RELIABILITY_SMALL_SERVICE_H_
