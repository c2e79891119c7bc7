#include "client/cli/label_table.h"

#include <algorithm>
#include <set>
#include <utility>

#include "absl/strings/str_format.h"
#include "core/base/status_macros.h"

namespace argmesh {
namespace {

namespace fs = std::filesystem;

constexpr int64_t kMaxTableBytes = int64_t{1} << 30;

std::vector<std::string> SplitTabs(std::string_view line) {
  std::vector<std::string> columns;
  size_t begin = 0;
  while (true) {
    const size_t tab = line.find('\t', begin);
    columns.emplace_back(line.substr(begin, tab - begin));
    if (tab == std::string_view::npos) return columns;
    begin = tab + 1;
  }
}

std::string NormalKey(const fs::path& path) {
  return path.lexically_normal().generic_string();
}

}  // namespace

absl::StatusOr<std::vector<TableLine>> ParseTabLines(std::string_view what,
                                                     std::string_view text,
                                                     size_t min_columns,
                                                     size_t max_columns) {
  std::vector<TableLine> lines;
  int number = 0;
  for (size_t begin = 0; begin < text.size();) {
    const size_t end = std::min(text.find('\n', begin), text.size());
    std::string_view line = text.substr(begin, end - begin);
    begin = end + 1;
    ++number;
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.empty() || line.starts_with('#')) continue;
    std::vector<std::string> columns = SplitTabs(line);
    if (lines.empty() && columns.size() >= 2 && columns[0] == "path" &&
        columns[1] == "class") {
      continue;  // the names of the columns
    }
    if (columns.size() < min_columns || columns.size() > max_columns ||
        columns.front().empty()) {
      return absl::InvalidArgumentError(absl::StrFormat(
          "%s line %d: %d tab-separated columns, %d to %d are expected, the "
          "first not empty",
          std::string(what), number, columns.size(), min_columns, max_columns));
    }
    lines.push_back({number, std::move(columns)});
  }
  return lines;
}

absl::StatusOr<LabelTable> LabelTable::Read(const fs::path& path) {
  ARGMESH_ASSIGN_OR_RETURN(const std::string text,
                           ReadFile(path, kMaxTableBytes));
  ARGMESH_ASSIGN_OR_RETURN(const std::vector<TableLine> lines,
                           ParseTabLines(path.string(), text, 2, 2));
  LabelTable table;
  table.folder_ = fs::absolute(path).lexically_normal().parent_path();
  for (const TableLine& line : lines) {
    const auto [entry, added] =
        table.classes_.emplace(NormalKey(line.columns[0]), line.columns[1]);
    if (!added && entry->second != line.columns[1]) {
      return absl::InvalidArgumentError(absl::StrFormat(
          "%s line %d: %s has a second class \"%s\" beside \"%s\"",
          path.string(), line.line, line.columns[0], line.columns[1],
          entry->second));
    }
  }
  return table;
}

std::optional<std::string> LabelTable::KeyOf(const MeshFile& file) const {
  const fs::path full = fs::absolute(file.path).lexically_normal();
  for (const std::string& key : {NormalKey(full.lexically_relative(folder_)),
                                 NormalKey(full), NormalKey(file.relative)}) {
    if (classes_.contains(key)) return key;
  }
  return std::nullopt;
}

std::optional<std::string> LabelTable::ClassOf(const MeshFile& file) const {
  const auto key = KeyOf(file);
  if (!key) return std::nullopt;
  return classes_.at(*key);
}

std::vector<std::string> LabelTable::Unused(
    const std::vector<MeshFile>& files) const {
  std::set<std::string> used;
  for (const MeshFile& file : files) {
    if (const auto key = KeyOf(file)) used.insert(*key);
  }
  std::vector<std::string> unused;
  for (const auto& [path, label] : classes_) {
    if (!used.contains(path)) unused.push_back(path);
  }
  return unused;
}

}  // namespace argmesh
