#include "server/rpc/graph_answer.h"

#include <algorithm>
#include <string>
#include <vector>

#include "absl/strings/str_format.h"
#include "core/base/status_macros.h"
#include "server/engine/error_reason.h"
#include "server/rpc/convert_graph.h"
#include "server/rpc/resource_name.h"
#include "server/rpc/service_environment.h"
#include "server/rpc/status.h"

namespace argmesh {
namespace {

absl::StatusOr<bool> WantsLabels(const v1::GetShapeGraphRequest& request) {
  if (request.first_face() < 0) return FieldInvalid("first_face", "negative");
  switch (request.face_label_view()) {
    case v1::FACE_LABEL_VIEW_UNSPECIFIED:
    case v1::FACE_LABEL_VIEW_NONE:
      return false;
    case v1::FACE_LABEL_VIEW_LEVEL:
    case v1::FACE_LABEL_VIEW_ALL:
      return true;
    default:
      return FieldInvalid(
          "face_label_view",
          absl::StrFormat("%d is no view",
                          static_cast<int>(request.face_label_view())));
  }
}

absl::StatusOr<std::vector<int>> WantedLevels(
    const v1::GetShapeGraphRequest& request, const ShapeGraphAnswer& answer) {
  const int count = NumLabelLevels(answer.graph, answer.labels);
  if (request.face_label_view() == v1::FACE_LABEL_VIEW_LEVEL) {
    const int level = request.face_label_level();
    if (level >= 0 && level < count) return std::vector<int>{level};
    return MakeError(
        ErrorReason::kNodeNotFound,
        absl::StrFormat("face_label_level: %d; the graph has %d levels", level,
                        count),
        {{"field", "face_label_level"},
         {"levels", absl::StrFormat("%d", count)}});
  }
  std::vector<int> levels(static_cast<size_t>(count));
  for (int level = 0; level < count; ++level) {
    levels[static_cast<size_t>(level)] = level;
  }
  return levels;
}

absl::Status AddLabels(const v1::GetShapeGraphRequest& request,
                       const ShapeGraphAnswer& answer,
                       v1::GetShapeGraphResponse* out) {
  ARGMESH_ASSIGN_OR_RETURN(const std::vector<int> levels,
                           WantedLevels(request, answer));
  const int64_t budget =
      kMaxAnswerBytes - static_cast<int64_t>(out->ByteSizeLong());
  const auto num_levels = std::max<int64_t>(1, std::ssize(levels));
  // Never 0, so that a client that pages always gets on.
  const FaceRange range{
      request.first_face(),
      std::max<int64_t>(1024, budget / kMaxLabelBytes / num_levels)};
  for (const int level : levels) {
    *out->add_face_labels() =
        ToProto(answer.graph, answer.labels, level, range);
  }
  const int64_t next = range.first_face + range.count;
  if (next < static_cast<int64_t>(answer.labels.component.size())) {
    out->set_next_first_face(next);
  }
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<v1::GetShapeGraphResponse> AnswerGraph(
    const Engine& engine, const v1::GetShapeGraphRequest& request) {
  ARGMESH_ASSIGN_OR_RETURN(const ShapeRef shape,
                           ParseShapeName("name", request.name()));
  ARGMESH_ASSIGN_OR_RETURN(const bool with_labels, WantsLabels(request));
  ARGMESH_ASSIGN_OR_RETURN(const ShapeGraphAnswer answer,
                           engine.GetGraph(shape, with_labels));
  v1::GetShapeGraphResponse out;
  out.set_name(ShapeName(shape.collection, shape.id));
  if (request.first_face() == 0) *out.mutable_graph() = ToProto(answer.graph);
  const auto bytes = static_cast<int64_t>(out.ByteSizeLong());
  if (bytes > kMaxAnswerBytes) {
    return MakeError(
        ErrorReason::kResponseTooLarge,
        absl::StrFormat("the graph takes %d bytes, the limit is %d", bytes,
                        kMaxAnswerBytes),
        {{"size", absl::StrFormat("%d", bytes)},
         {"limit", absl::StrFormat("%d", kMaxAnswerBytes)}});
  }
  if (with_labels) {
    ARGMESH_RETURN_IF_ERROR(AddLabels(request, answer, &out));
  }
  return out;
}

}  // namespace argmesh
