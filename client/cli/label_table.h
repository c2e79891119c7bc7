// Which class each mesh file is of: lines `path TAB class`, paths relative to
// the folder of the file that holds them. Empty lines, lines that begin with
// '#' and a first line `path TAB class` are left out.
#ifndef ARGMESH_CLIENT_CLI_LABEL_TABLE_H_
#define ARGMESH_CLIENT_CLI_LABEL_TABLE_H_

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "client/cli/mesh_files.h"

namespace argmesh {

// One line of a table of tab-separated columns.
struct TableLine {
  int line = 0;  // counted from 1
  std::vector<std::string> columns;
};

// The lines of `text` with between `min_columns` and `max_columns` columns;
// kInvalidArgument naming `what` and the line otherwise. Ends of line may be
// LF or CR LF.
absl::StatusOr<std::vector<TableLine>> ParseTabLines(std::string_view what,
                                                     std::string_view text,
                                                     size_t min_columns,
                                                     size_t max_columns);

class LabelTable {
 public:
  // kInvalidArgument when a line is malformed or a path has two classes.
  static absl::StatusOr<LabelTable> Read(const std::filesystem::path& path);

  // By the file's place below the table's folder; where it is elsewhere, by
  // its path relative to the folder that was given.
  std::optional<std::string> ClassOf(const MeshFile& file) const;

  size_t size() const { return classes_.size(); }
  // Listed paths that are none of the files.
  std::vector<std::string> Unused(const std::vector<MeshFile>& files) const;

 private:
  std::optional<std::string> KeyOf(const MeshFile& file) const;

  std::filesystem::path folder_;  // absolute, normal
  std::map<std::string, std::string> classes_;
};

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_CLI_LABEL_TABLE_H_
