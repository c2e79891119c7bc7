#include "client/cli/evaluation_queries.h"

#include <utility>

#include "absl/strings/str_format.h"
#include "client/cli/json.h"
#include "client/cli/label_table.h"
#include "client/cli/mesh_files.h"
#include "client/resource_name.h"
#include "core/base/status_macros.h"

namespace argmesh {

Gallery::Gallery(std::vector<GalleryShape> shapes)
    : shapes_(std::move(shapes)) {
  for (size_t i = 0; i < shapes_.size(); ++i) {
    by_id_.emplace(shapes_[i].id, i);
    if (!shapes_[i].source_uri.empty()) {
      by_source_.emplace(shapes_[i].source_uri, i);
    }
    if (!shapes_[i].label.empty()) ++counts_[shapes_[i].label];
  }
}

absl::StatusOr<Gallery> Gallery::Fetch(Client& client,
                                       const std::string& collection,
                                       const std::string& filter) {
  std::vector<GalleryShape> shapes;
  ARGMESH_RETURN_IF_ERROR(client.ForEachShape(
      CollectionName(collection),
      [&shapes](const v1::Shape& shape) {
        if (shape.state() == v1::SHAPE_STATE_ACTIVE) {
          shapes.push_back(
              {ResourceId(shape.name()), ClassOf(shape), shape.source_uri()});
        }
        return true;
      },
      filter));
  return Gallery(std::move(shapes));
}

std::optional<size_t> Gallery::FindId(const std::string& id) const {
  const auto found = by_id_.find(id);
  if (found == by_id_.end()) return std::nullopt;
  return found->second;
}

std::optional<size_t> Gallery::FindSource(const std::string& source) const {
  const auto found = by_source_.find(source);
  if (found != by_source_.end()) return found->second;
  return FindId(source);
}

int Gallery::CountOf(const std::string& label) const {
  const auto found = counts_.find(label);
  return found == counts_.end() ? 0 : found->second;
}

std::vector<EvaluationQuery> LeaveOneOutQueries(const Gallery& gallery) {
  std::vector<EvaluationQuery> queries;
  for (size_t i = 0; i < gallery.shapes().size(); ++i) {
    const GalleryShape& shape = gallery.shapes()[i];
    if (!shape.label.empty()) queries.push_back({shape.id, shape.label, {}, i});
  }
  return queries;
}

absl::StatusOr<std::vector<EvaluationQuery>> ReadQueryTable(
    const std::filesystem::path& path, const Gallery& gallery) {
  ARGMESH_ASSIGN_OR_RETURN(const std::string text,
                           ReadFile(path, int64_t{1} << 30));
  ARGMESH_ASSIGN_OR_RETURN(const std::vector<TableLine> lines,
                           ParseTabLines(path.string(), text, 2, 3));
  std::vector<EvaluationQuery> queries;
  for (const TableLine& line : lines) {
    EvaluationQuery query{line.columns[0], line.columns[1],
                          path.parent_path() / line.columns[0], std::nullopt};
    const std::string source = line.columns.size() > 2 ? line.columns[2] : "-";
    if (source != "-" && !source.empty()) {
      query.source = gallery.FindSource(source);
      if (!query.source) {
        return absl::NotFoundError(absl::StrFormat(
            "%s line %d: the source %s is no shape of the collection",
            path.string(), line.line, source));
      }
    }
    queries.push_back(std::move(query));
  }
  if (queries.empty()) {
    return absl::InvalidArgumentError(path.string() + ": no query");
  }
  return queries;
}

}  // namespace argmesh
