// What a Client is made of; only the client library includes this.
#ifndef ARGMESH_CLIENT_CLIENT_PARTS_H_
#define ARGMESH_CLIENT_CLIENT_PARTS_H_

#include <grpcpp/channel.h>
#include <grpcpp/client_context.h>

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/time/clock.h"
#include "absl/time/time.h"
#include "argmesh/v1/admin_service.grpc.pb.h"
#include "argmesh/v1/collection_service.grpc.pb.h"
#include "argmesh/v1/ingest_service.grpc.pb.h"
#include "argmesh/v1/search_service.grpc.pb.h"
#include "argmesh/v1/shape_service.grpc.pb.h"
#include "client/backoff.h"
#include "client/client.h"
#include "client/error_status.h"
#include "google/longrunning/operations.grpc.pb.h"

namespace argmesh {

// A page of a list, the server's largest.
inline constexpr int kPageSize = 1000;

// Whether a call may be made again after a failure that leaves open what
// became of it.
enum class Repeat { kNever, kSafe };

struct Client::Parts {
  std::string target;
  ClientOptions options;
  std::shared_ptr<grpc::Channel> channel;
  std::unique_ptr<v1::CollectionService::Stub> collections;
  std::unique_ptr<v1::ShapeService::Stub> shapes;
  std::unique_ptr<v1::IngestService::Stub> ingest;
  std::unique_ptr<v1::SearchService::Stub> search;
  std::unique_ptr<v1::AdminService::Stub> admin;
  std::unique_ptr<google::longrunning::Operations::Stub> operations;
  std::atomic<uint64_t> next_seed{0};  // of the waits of each call

  // With the address in place of gRPC's own words when no server answers, or
  // not in time.
  absl::Status Explain(const grpc::Status& status) const;
  absl::Status Explain(const absl::Status& status) const;

  // Lets time pass between two attempts, less when `stop` is requested. Not a
  // mere sleep: a connection that is being made needs a thread that attends
  // to it, and between calls this is the only one.
  void Wait(absl::Duration wait, const std::stop_token& stop = {}) const;

  // Gives the context of one attempt its deadline and the key.
  void Prepare(absl::Time deadline, grpc::ClientContext& context) const;

  // Makes one call, again where that may help, until the deadline.
  template <typename Response>
  absl::StatusOr<Response> Call(
      Repeat repeat,
      const std::function<grpc::Status(grpc::ClientContext*, Response*)>& call);
};

template <typename Response>
absl::StatusOr<Response> Client::Parts::Call(
    Repeat repeat,
    const std::function<grpc::Status(grpc::ClientContext*, Response*)>& call) {
  const absl::Time deadline = absl::Now() + options.call_timeout;
  Backoff backoff(options.retry, next_seed.fetch_add(1));
  while (true) {
    grpc::ClientContext context;
    Prepare(deadline, context);
    Response response;
    absl::Status status = Explain(call(&context, &response));
    if (status.ok()) return response;
    // Nobody cancels it here: gRPC says so of a call that comes in while the
    // server goes down.
    if (absl::IsCancelled(status) && ErrorReason(status).empty()) {
      status = absl::UnavailableError("the server at " + target + " goes down");
    }
    if (repeat == Repeat::kNever) return status;
    const auto wait = backoff.Next(status);
    if (!wait || absl::Now() + *wait >= deadline) return status;
    Wait(*wait);
  }
}

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_CLIENT_PARTS_H_
