// The queries of an evaluation and the shapes they are held against.
#ifndef ARGMESH_CLIENT_CLI_EVALUATION_QUERIES_H_
#define ARGMESH_CLIENT_CLI_EVALUATION_QUERIES_H_

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "client/client.h"

namespace argmesh {

struct GalleryShape {
  std::string id;
  std::string label;  // its class; empty for none
  std::string source_uri;
};

// The shapes of a collection, by id.
class Gallery {
 public:
  explicit Gallery(std::vector<GalleryShape> shapes);
  // Those that `filter` holds for; all when it is empty.
  static absl::StatusOr<Gallery> Fetch(Client& client,
                                       const std::string& collection,
                                       const std::string& filter);

  const std::vector<GalleryShape>& shapes() const { return shapes_; }
  std::optional<size_t> FindId(const std::string& id) const;
  // By source_uri, else by id.
  std::optional<size_t> FindSource(const std::string& source) const;
  // Shapes of a class.
  int CountOf(const std::string& label) const;

 private:
  std::vector<GalleryShape> shapes_;
  std::map<std::string, size_t> by_id_;
  std::map<std::string, size_t> by_source_;
  std::map<std::string, int> counts_;
};

struct EvaluationQuery {
  std::string name;  // a shape's id, or the path as in the table
  std::string label;
  std::filesystem::path file;    // empty: the stored shape `source`
  std::optional<size_t> source;  // index in the gallery: left out of ranking
};

// Every shape that has a class.
std::vector<EvaluationQuery> LeaveOneOutQueries(const Gallery& gallery);

// Lines `path TAB class TAB source`: the path relative to the table's folder,
// the source a shape's source_uri or id, `-` for none.
// Fails    kInvalidArgument  a malformed line, no query at all
//          kNotFound         a source that is no shape of the gallery
absl::StatusOr<std::vector<EvaluationQuery>> ReadQueryTable(
    const std::filesystem::path& path, const Gallery& gallery);

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_CLI_EVALUATION_QUERIES_H_
