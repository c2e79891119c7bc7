// The calls of Client about shapes.
#include <algorithm>
#include <utility>

#include "absl/strings/str_format.h"
#include "client/client.h"
#include "client/client_parts.h"
#include "client/mesh_chunks.h"
#include "client/request_id.h"
#include "core/base/sha256.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

absl::Status CheckDownload(const v1::DownloadMeshHeader& header,
                           std::string_view bytes) {
  if (static_cast<int64_t>(bytes.size()) != header.size_bytes()) {
    return MakeStatus(absl::StatusCode::kDataLoss, "MESH_SIZE_MISMATCH",
                      absl::StrFormat("%d bytes came, %d were announced",
                                      bytes.size(), header.size_bytes()));
  }
  if (const std::string digest = ToHex(ComputeSha256(bytes));
      digest != header.sha256()) {
    return MakeStatus(absl::StatusCode::kDataLoss, "MESH_DIGEST_MISMATCH",
                      absl::StrFormat("the bytes have the SHA-256 %s, "
                                      "announced was %s",
                                      digest, header.sha256()));
  }
  return absl::OkStatus();
}

// Adds the labels of one answer behind those of the answers before it.
absl::Status AppendLabels(const v1::GetShapeGraphResponse& part,
                          std::vector<v1::FaceLabels>& labels) {
  if (labels.empty()) {
    labels.assign(part.face_labels().begin(), part.face_labels().end());
    return absl::OkStatus();
  }
  for (const v1::FaceLabels& more : part.face_labels()) {
    const auto level = std::find_if(
        labels.begin(), labels.end(), [&](const v1::FaceLabels& l) {
          return l.level_index() == more.level_index();
        });
    if (level == labels.end() || level->labels_size() != more.first_face()) {
      return absl::DataLossError(
          absl::StrFormat("face labels of level \"%s\" do not go on at face %d",
                          more.level(), more.first_face()));
    }
    level->mutable_labels()->MergeFrom(more.labels());
  }
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<v1::Shape> Client::CreateShape(v1::CreateShapeRequest request) {
  FillRequestId(request);
  return parts_->Call<v1::Shape>(
      Repeat::kSafe, [&](grpc::ClientContext* context, auto* response) {
        return parts_->shapes->CreateShape(context, request, response);
      });
}

absl::StatusOr<v1::Shape> Client::UploadShape(v1::UploadShapeHeader header,
                                              std::string_view bytes) {
  header.set_size_bytes(static_cast<int64_t>(bytes.size()));
  header.set_sha256(ToHex(ComputeSha256(bytes)));
  FillRequestId(header);
  v1::UploadShapeRequest first;
  *first.mutable_header() = std::move(header);
  return parts_->Call<v1::Shape>(
      Repeat::kSafe, [&](grpc::ClientContext* context, auto* response) {
        const auto writer = parts_->shapes->UploadShape(context, response);
        // A refused write means that the server has answered already: Finish
        // tells what.
        bool open = writer->Write(first);
        open = open && ForEachChunk(bytes, [&](std::string_view chunk) {
                 v1::UploadShapeRequest request;
                 request.set_chunk(std::string(chunk));
                 return writer->Write(request);
               });
        if (open) writer->WritesDone();
        return writer->Finish();
      });
}

absl::StatusOr<v1::Shape> Client::GetShape(std::string_view name) {
  v1::GetShapeRequest request;
  request.set_name(std::string(name));
  return parts_->Call<v1::Shape>(
      Repeat::kSafe, [&](grpc::ClientContext* context, auto* response) {
        return parts_->shapes->GetShape(context, request, response);
      });
}

absl::StatusOr<v1::ListShapesResponse> Client::ListShapes(
    const v1::ListShapesRequest& request) {
  return parts_->Call<v1::ListShapesResponse>(
      Repeat::kSafe, [&](grpc::ClientContext* context, auto* response) {
        return parts_->shapes->ListShapes(context, request, response);
      });
}

absl::Status Client::ForEachShape(
    std::string_view collection_name,
    const std::function<bool(const v1::Shape&)>& visit,
    const std::string& filter) {
  v1::ListShapesRequest request;
  request.set_parent(std::string(collection_name));
  request.set_filter(filter);
  request.set_page_size(kPageSize);
  do {
    ARGMESH_ASSIGN_OR_RETURN(const v1::ListShapesResponse page,
                             ListShapes(request));
    for (const v1::Shape& shape : page.shapes()) {
      if (!visit(shape)) return absl::OkStatus();
    }
    request.set_page_token(page.next_page_token());
  } while (!request.page_token().empty());
  return absl::OkStatus();
}

absl::StatusOr<v1::DeleteShapeResponse> Client::DeleteShape(
    v1::DeleteShapeRequest request) {
  FillRequestId(request);
  return parts_->Call<v1::DeleteShapeResponse>(
      Repeat::kSafe, [&](grpc::ClientContext* context, auto* response) {
        return parts_->shapes->DeleteShape(context, request, response);
      });
}

absl::StatusOr<DownloadedMesh> Client::DownloadMesh(std::string_view name) {
  v1::DownloadMeshRequest request;
  request.set_name(std::string(name));
  struct Download {
    v1::DownloadMeshHeader header;
    std::string bytes;
  };
  ARGMESH_ASSIGN_OR_RETURN(
      Download download,
      parts_->Call<Download>(
          Repeat::kSafe, [&](grpc::ClientContext* context, Download* result) {
            const auto reader = parts_->shapes->DownloadMesh(context, request);
            v1::DownloadMeshResponse response;
            while (reader->Read(&response)) {
              if (response.has_header()) result->header = response.header();
              result->bytes += response.chunk();
            }
            return reader->Finish();
          }));
  ARGMESH_RETURN_IF_ERROR(CheckDownload(download.header, download.bytes));
  return DownloadedMesh{download.header.format(), std::move(download.bytes)};
}

absl::StatusOr<ShapeGraphWithLabels> Client::GetShapeGraph(
    std::string_view name, v1::FaceLabelView view, int level) {
  v1::GetShapeGraphRequest request;
  request.set_name(std::string(name));
  request.set_face_label_view(view);
  request.set_face_label_level(level);
  ShapeGraphWithLabels result;
  do {
    ARGMESH_ASSIGN_OR_RETURN(
        v1::GetShapeGraphResponse part,
        parts_->Call<v1::GetShapeGraphResponse>(
            Repeat::kSafe, [&](grpc::ClientContext* context, auto* response) {
              return parts_->shapes->GetShapeGraph(context, request, response);
            }));
    if (request.first_face() == 0) result.graph.Swap(part.mutable_graph());
    ARGMESH_RETURN_IF_ERROR(AppendLabels(part, result.face_labels));
    if (part.next_first_face() != 0 &&
        part.next_first_face() <= request.first_face()) {
      return absl::DataLossError("face labels do not go on");
    }
    request.set_first_face(part.next_first_face());
  } while (request.first_face() != 0);
  return result;
}

}  // namespace argmesh
