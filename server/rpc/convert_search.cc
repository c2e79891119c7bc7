#include "server/rpc/convert_search.h"

#include <limits>
#include <string>
#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/base/status_macros.h"
#include "server/engine/error_reason.h"
#include "server/rpc/convert_graph.h"
#include "server/rpc/convert_match.h"
#include "server/rpc/convert_mesh.h"
#include "server/rpc/convert_shape.h"
#include "server/rpc/convert_upload.h"
#include "server/rpc/resource_name.h"
#include "server/rpc/service_environment.h"
#include "server/rpc/status.h"

namespace argmesh {
namespace {

constexpr int kDefaultSearchLimit = 10;

absl::StatusOr<QueryShape> MeshQuery(const std::string& field,
                                     const v1::MeshContent& mesh) {
  MeshBytes query;
  ARGMESH_ASSIGN_OR_RETURN(query.format,
                           FromProto(field + ".format", mesh.format()));
  if (mesh.data().empty()) return FieldRequired(field + ".data");
  query.bytes = mesh.data();
  return QueryShape(std::move(query));
}

absl::StatusOr<QueryShape> StoredQuery(const std::string& field,
                                       const std::string& name) {
  ARGMESH_ASSIGN_OR_RETURN(ShapeRef shape, ParseShapeName(field, name));
  return QueryShape(std::move(shape));
}

absl::StatusOr<QueryShape> GraphQuery(const std::string& field,
                                      const v1::ShapeGraph& graph) {
  ARGMESH_ASSIGN_OR_RETURN(ShapeGraph parsed, FromProto(field, graph));
  return QueryShape(std::move(parsed));
}

absl::StatusOr<QueryShape> QueryOf(const v1::SearchShapesRequest& request) {
  switch (request.query_case()) {
    case v1::SearchShapesRequest::kShape:
      return StoredQuery("shape", request.shape());
    case v1::SearchShapesRequest::kMesh:
      return MeshQuery("mesh", request.mesh());
    case v1::SearchShapesRequest::kGraph:
      return GraphQuery("graph", request.graph());
    case v1::SearchShapesRequest::QUERY_NOT_SET:
      break;
  }
  return FieldRequired("query");
}

absl::StatusOr<QueryShape> QueryOf(const std::string& field,
                                   const v1::ShapeReference& reference) {
  switch (reference.reference_case()) {
    case v1::ShapeReference::kShape:
      return StoredQuery(field + ".shape", reference.shape());
    case v1::ShapeReference::kMesh:
      return MeshQuery(field + ".mesh", reference.mesh());
    case v1::ShapeReference::kGraph:
      return GraphQuery(field + ".graph", reference.graph());
    case v1::ShapeReference::REFERENCE_NOT_SET:
      break;
  }
  return FieldRequired(field);
}

absl::StatusOr<double> Share(std::string_view field, double value) {
  if (value >= 0 && value <= 1) return value;  // NaN is neither
  return FieldInvalid(field, absl::StrFormat("%g is not within 0 .. 1", value));
}

absl::Status CheckServed(const v1::SearchShapesRequest& request) {
  if (!request.region_node_ids().empty() && !request.has_shape()) {
    return FieldInvalid("region_node_ids", "needs a stored shape as the query");
  }
  if (request.candidates() < 0) {
    return FieldInvalid("candidates", "negative");
  }
  if (request.min_generation() < 0) {
    return FieldInvalid("min_generation", "negative");
  }
  return absl::OkStatus();
}

absl::StatusOr<int> LimitOf(const v1::SearchShapesRequest& request) {
  if (request.limit() == 0) return kDefaultSearchLimit;
  if (request.limit() > 0 && request.limit() <= kMaxSearchLimit) {
    return request.limit();
  }
  return FieldInvalid(
      "limit", absl::StrFormat("%d is not within 1 .. %d", request.limit(),
                               kMaxSearchLimit));
}

void AddLabels(const QueryGraph& query, int64_t budget,
               google::protobuf::RepeatedPtrField<v1::FaceLabels>* out) {
  const auto faces = static_cast<int64_t>(query.labels.component.size());
  const auto cells = static_cast<int64_t>(query.labels.uniform.size());
  if (faces == 0 || (faces + cells) * kMaxLabelBytes > budget) return;
  const int finest = static_cast<int>(query.graph.levels.size()) - 1;
  const FaceRange all{0, std::numeric_limits<int64_t>::max()};
  const int levels = NumLabelLevels(query.graph, query.labels);
  for (int level = finest; level < levels; ++level) {
    *out->Add() = ToProto(query.graph, query.labels, level, all);
  }
}

v1::ComparedGraph ToProto(const QueryGraph& query, int64_t budget) {
  v1::ComparedGraph out;
  *out.mutable_graph() = ToProto(query.graph);
  if (query.report.faces > 0) *out.mutable_report() = ToProto(query.report);
  AddLabels(query, budget, out.mutable_face_labels());
  return out;
}

// What was found in the query.
template <typename Response>
void FillQuery(const SearchAnswer& answer, const SearchAnswerForm& form,
               Response* out) {
  out->set_query_generic(answer.query_generic);
  if (!answer.query_graph) return;
  const QueryGraph& query = *answer.query_graph;
  if (query.report.faces > 0) {
    *out->mutable_query_report() = ToProto(query.report);
  }
  if (!form.query_graph) return;
  *out->mutable_query_graph() = ToProto(query.graph);
  AddLabels(query, form.max_bytes / 2, out->mutable_query_face_labels());
}

// All but the query itself.
absl::StatusOr<SearchQuery> SettingsOf(const v1::SearchShapesRequest& request) {
  SearchQuery query;
  ARGMESH_ASSIGN_OR_RETURN(query.collection,
                           ParseCollectionName("parent", request.parent()));
  ARGMESH_RETURN_IF_ERROR(CheckServed(request));
  ARGMESH_ASSIGN_OR_RETURN(query.mode, FromProto("mode", request.mode()));
  ARGMESH_ASSIGN_OR_RETURN(const MatchSettings settings,
                           FromProto("parameters", request.parameters(),
                                     query.mode, request.has_graph()));
  query.attributes = settings.attributes;
  query.levels = settings.levels;
  query.ranking = settings.ranking;
  query.rerank = settings.rerank;
  query.candidates = request.candidates();
  query.exact = request.exact();
  query.region_nodes.assign(request.region_node_ids().begin(),
                            request.region_node_ids().end());
  ARGMESH_ASSIGN_OR_RETURN(query.limit, LimitOf(request));
  ARGMESH_ASSIGN_OR_RETURN(query.min_score,
                           Share("min_score", request.min_score()));
  ARGMESH_ASSIGN_OR_RETURN(
      query.min_query_coverage,
      Share("min_query_coverage", request.min_query_coverage()));
  query.filter = request.filter();
  query.exclude_query = request.exclude_query();
  query.correspondence = !request.omit_component_pairs();
  query.query_graph = request.return_query_graph() || request.has_mesh();
  query.min_generation = request.min_generation();
  return query;
}

}  // namespace

absl::StatusOr<SearchQuery> FromProto(const v1::SearchShapesRequest& request) {
  ARGMESH_ASSIGN_OR_RETURN(SearchQuery query, SettingsOf(request));
  ARGMESH_ASSIGN_OR_RETURN(query.query, QueryOf(request));
  return query;
}

absl::StatusOr<AnnouncedSearch> FromProto(
    const v1::StreamSearchShapesHeader& header) {
  if (header.search().query_case() != v1::SearchShapesRequest::QUERY_NOT_SET) {
    return FieldInvalid("header.search", "has a query beside the chunks");
  }
  AnnouncedSearch announced;
  ARGMESH_ASSIGN_OR_RETURN(announced.query, SettingsOf(header.search()));
  announced.query.query_graph = true;
  MeshBytes mesh;
  ARGMESH_ASSIGN_OR_RETURN(mesh.format,
                           FromProto("header.format", header.format()));
  announced.query.query = std::move(mesh);
  ARGMESH_ASSIGN_OR_RETURN(
      announced.upload,
      ParseAnnouncement("header.", header.size_bytes(), header.sha256()));
  return announced;
}

absl::StatusOr<CompareQuery> FromProto(
    const v1::CompareShapesRequest& request) {
  CompareQuery query;
  ARGMESH_ASSIGN_OR_RETURN(query.collection,
                           ParseCollectionName("parent", request.parent()));
  ARGMESH_ASSIGN_OR_RETURN(query.mode, FromProto("mode", request.mode()));
  ARGMESH_ASSIGN_OR_RETURN(
      const MatchSettings settings,
      FromProto("parameters", request.parameters(), query.mode,
                request.query().has_graph() || request.target().has_graph()));
  if (settings.rerank) {
    return FieldInvalid("parameters.rerank", "two shapes have no order");
  }
  query.attributes = settings.attributes;
  query.levels = settings.levels;
  query.ranking = settings.ranking;
  ARGMESH_ASSIGN_OR_RETURN(query.a, QueryOf("query", request.query()));
  ARGMESH_ASSIGN_OR_RETURN(query.b, QueryOf("target", request.target()));
  query.graphs = request.return_graphs();
  return query;
}

v1::Match ToProto(const SearchMatch& found, const SearchAnswerForm& form) {
  v1::Match match = ToProto(found);
  *match.mutable_shape() = ToProto(found.shape);
  if (form.explain) *match.mutable_explanation() = Explain(found, form.mode);
  return match;
}

v1::StreamedQuery QueryToProto(const SearchAnswer& answer,
                               const SearchAnswerForm& form) {
  v1::StreamedQuery out;
  FillQuery(answer, form, &out);
  return out;
}

v1::SearchShapesResponse ToProto(const SearchAnswer& answer,
                                 const SearchAnswerForm& form) {
  v1::SearchShapesResponse out;
  *out.mutable_stats() = ToProto(answer.stats);
  FillQuery(answer, form, &out);
  auto left = form.max_bytes - static_cast<int64_t>(out.ByteSizeLong());
  for (const SearchMatch& found : answer.matches) {
    v1::Match match = ToProto(found, form);
    // Tag and length of a message in a field take at most 6 bytes.
    left -= static_cast<int64_t>(match.ByteSizeLong()) + 6;
    if (left < 0) {
      out.set_truncated(true);
      break;
    }
    *out.add_matches() = std::move(match);
  }
  return out;
}

v1::CompareShapesResponse ToProto(const ComparedShapes& compared,
                                  const SearchAnswerForm& form) {
  v1::CompareShapesResponse out;
  *out.mutable_match() = ToProto(compared.match);
  if (form.explain) {
    *out.mutable_match()->mutable_explanation() =
        Explain(compared.match, form.mode);
  }
  if (compared.a)
    *out.mutable_query() = ToProto(*compared.a, form.max_bytes / 2);
  if (compared.b) {
    *out.mutable_target() = ToProto(*compared.b, form.max_bytes / 2);
  }
  return out;
}

}  // namespace argmesh
