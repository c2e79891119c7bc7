// The searches of Client.
#include <utility>

#include "client/client.h"
#include "client/client_parts.h"
#include "client/mesh_chunks.h"
#include "core/base/sha256.h"

namespace argmesh {
namespace {

using SearchStream =
    grpc::ClientReaderWriterInterface<v1::StreamSearchShapesRequest,
                                      v1::StreamSearchShapesResponse>;

// The search of `request` without its mesh, and what announces that.
v1::StreamSearchShapesRequest HeaderOf(const v1::SearchShapesRequest& request) {
  v1::StreamSearchShapesRequest first;
  v1::StreamSearchShapesHeader& header = *first.mutable_header();
  *header.mutable_search() = request;
  header.mutable_search()->clear_mesh();
  header.set_format(request.mesh().format());
  header.set_size_bytes(static_cast<int64_t>(request.mesh().data().size()));
  header.set_sha256(ToHex(ComputeSha256(request.mesh().data())));
  return first;
}

void TakeQuery(v1::StreamedQuery& query, v1::SearchShapesResponse* response) {
  if (query.has_query_graph()) {
    response->mutable_query_graph()->Swap(query.mutable_query_graph());
  }
  if (query.has_query_report()) {
    response->mutable_query_report()->Swap(query.mutable_query_report());
  }
  response->mutable_query_face_labels()->Swap(
      query.mutable_query_face_labels());
  response->set_query_generic(query.query_generic());
}

grpc::Status RunSearch(SearchStream& stream,
                       const v1::StreamSearchShapesRequest& first,
                       std::string_view mesh,
                       v1::SearchShapesResponse* response) {
  // A refused write means that the server has answered already: Finish tells
  // what.
  bool open = stream.Write(first);
  open = open && ForEachChunk(mesh, [&](std::string_view chunk) {
           v1::StreamSearchShapesRequest request;
           request.set_chunk(std::string(chunk));
           return stream.Write(request);
         });
  if (open) stream.WritesDone();
  v1::StreamSearchShapesResponse message;
  while (stream.Read(&message)) {
    if (message.has_match()) {
      response->add_matches()->Swap(message.mutable_match());
    } else if (message.has_stats()) {
      response->mutable_stats()->Swap(message.mutable_stats());
    } else {
      TakeQuery(*message.mutable_query(), response);
    }
  }
  return stream.Finish();
}

}  // namespace

absl::StatusOr<v1::SearchShapesResponse> Client::SearchShapes(
    const v1::SearchShapesRequest& request) {
  const std::string& mesh = request.mesh().data();
  if (static_cast<int64_t>(mesh.size()) <= kMaxInlineMeshBytes) {
    return parts_->Call<v1::SearchShapesResponse>(
        Repeat::kSafe, [&](grpc::ClientContext* context, auto* response) {
          return parts_->search->SearchShapes(context, request, response);
        });
  }
  const v1::StreamSearchShapesRequest first = HeaderOf(request);
  return parts_->Call<v1::SearchShapesResponse>(
      Repeat::kSafe, [&](grpc::ClientContext* context, auto* response) {
        const auto stream = parts_->search->StreamSearchShapes(context);
        return RunSearch(*stream, first, mesh, response);
      });
}

absl::StatusOr<v1::CompareShapesResponse> Client::CompareShapes(
    const v1::CompareShapesRequest& request) {
  return parts_->Call<v1::CompareShapesResponse>(
      Repeat::kSafe, [&](grpc::ClientContext* context, auto* response) {
        return parts_->search->CompareShapes(context, request, response);
      });
}

}  // namespace argmesh
