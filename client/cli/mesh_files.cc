#include "client/cli/mesh_files.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <map>
#include <set>
#include <system_error>
#include <utility>

#include "absl/strings/str_format.h"
#include "client/error_status.h"
#include "core/base/identifier.h"
#include "core/base/status_macros.h"
#include "core/mesh/mesh_format.h"

namespace argmesh {
namespace {

namespace fs = std::filesystem;

bool IsHidden(const fs::path& path) {
  return path.filename().native().starts_with('.');
}

absl::Status Unreadable(const fs::path& path, const std::error_code& error) {
  return MakeStatus(error == std::errc::no_such_file_or_directory
                        ? absl::StatusCode::kNotFound
                        : absl::StatusCode::kPermissionDenied,
                    "FILE_UNREADABLE",
                    absl::StrFormat("%s: %s", path.string(), error.message()));
}

absl::StatusOr<std::vector<MeshFile>> FilesBelow(const fs::path& folder) {
  std::vector<MeshFile> files;
  std::error_code error;
  fs::recursive_directory_iterator it(folder, error);
  for (const fs::recursive_directory_iterator end; !error && it != end;
       it.increment(error)) {
    if (IsHidden(it->path())) {
      it.disable_recursion_pending();
      continue;
    }
    const v1::MeshFormat format = FormatOfPath(it->path());
    std::error_code ignored;
    if (format == v1::MESH_FORMAT_UNSPECIFIED ||
        !it->is_regular_file(ignored)) {
      continue;
    }
    files.push_back({.path = it->path(),
                     .relative = it->path().lexically_relative(folder).string(),
                     .shape_id = {},
                     .format = format});
  }
  if (error) return Unreadable(folder, error);
  std::sort(files.begin(), files.end(),
            [](const MeshFile& a, const MeshFile& b) {
              return a.relative < b.relative;
            });
  return files;
}

absl::StatusOr<std::vector<MeshFile>> FilesOf(const std::string& argument) {
  const fs::path path(argument);
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) {
    return Unreadable(
        path, std::make_error_code(std::errc::no_such_file_or_directory));
  }
  if (fs::is_directory(status)) return FilesBelow(path);
  const v1::MeshFormat format = FormatOfPath(path);
  if (format == v1::MESH_FORMAT_UNSPECIFIED) {
    return absl::InvalidArgumentError(absl::StrFormat(
        "%s: not a mesh file by its name (.off .obj .ply .stl)", argument));
  }
  return std::vector<MeshFile>{{.path = path,
                                .relative = path.filename().string(),
                                .shape_id = {},
                                .format = format}};
}

// Puts the names of folders above before relative paths that meet.
void SeparateEqualPaths(std::vector<MeshFile>& files) {
  for (bool changed = true; changed;) {
    changed = false;
    std::map<std::string, std::vector<size_t>> by_relative;
    for (size_t i = 0; i < files.size(); ++i) {
      by_relative[files[i].relative].push_back(i);
    }
    for (const auto& [relative, indices] : by_relative) {
      if (indices.size() < 2) continue;
      for (const size_t i : indices) {
        const fs::path full = fs::absolute(files[i].path).lexically_normal();
        const fs::path own(files[i].relative);
        const auto parts = std::distance(full.begin(), full.end());
        const auto kept = std::distance(own.begin(), own.end());
        if (kept + 1 >= parts) continue;
        const auto above = std::next(full.begin(), parts - kept - 1);
        files[i].relative = (*above / own).string();
        changed = true;
      }
    }
  }
}

}  // namespace

v1::MeshFormat FormatOfPath(const fs::path& path) {
  switch (MeshFormatFromPath(path.string())) {
    case MeshFormat::kOff:
      return v1::MESH_FORMAT_OFF;
    case MeshFormat::kObj:
      return v1::MESH_FORMAT_OBJ;
    case MeshFormat::kPly:
      return v1::MESH_FORMAT_PLY;
    case MeshFormat::kStl:
      return v1::MESH_FORMAT_STL;
    case MeshFormat::kUnknown:
      break;
  }
  return v1::MESH_FORMAT_UNSPECIFIED;
}

absl::StatusOr<std::vector<MeshFile>> FindMeshFiles(
    const std::vector<std::string>& arguments) {
  std::vector<MeshFile> files;
  std::set<std::string> seen;
  for (const std::string& argument : arguments) {
    ARGMESH_ASSIGN_OR_RETURN(std::vector<MeshFile> found, FilesOf(argument));
    for (MeshFile& file : found) {
      std::error_code error;
      const fs::path real = fs::canonical(file.path, error);
      if (!seen.insert(error ? file.path.string() : real.string()).second) {
        continue;
      }
      files.push_back(std::move(file));
    }
  }
  if (files.empty()) {
    return absl::InvalidArgumentError(
        "no mesh file (.off .obj .ply .stl) in what was given");
  }
  SeparateEqualPaths(files);
  for (MeshFile& file : files) {
    file.shape_id = IdentifierFromPath(file.relative);
  }
  return files;
}

absl::StatusOr<std::string> ReadFile(const fs::path& path, int64_t max_bytes) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) {
    return Unreadable(path, std::error_code(errno, std::generic_category()));
  }
  stream.seekg(0, std::ios::end);
  const auto size = static_cast<int64_t>(stream.tellg());
  if (size > max_bytes) {
    return MakeStatus(
        absl::StatusCode::kResourceExhausted, "MESH_TOO_LARGE",
        absl::StrFormat("%d bytes, the limit is %d", size, max_bytes));
  }
  std::string bytes(static_cast<size_t>(std::max<int64_t>(size, 0)), '\0');
  stream.seekg(0);
  if (size < 0 || !stream.read(bytes.data(), size)) {
    return Unreadable(path, std::make_error_code(std::errc::io_error));
  }
  return bytes;
}

absl::Status WriteFile(const fs::path& path, std::string_view bytes) {
  std::ofstream stream(path, std::ios::binary | std::ios::trunc);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (stream) return absl::OkStatus();
  return absl::UnknownError(absl::StrFormat(
      "%s cannot be written: %s", path.string(), std::strerror(errno)));
}

}  // namespace argmesh
