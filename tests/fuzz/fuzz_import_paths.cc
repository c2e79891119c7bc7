// Paths that an import may name: nothing outside the root is ever read. The
// root lies beside a file that must stay unknown, and links lead out of it.
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>

#include "server/engine/error_reason.h"
#include "server/storage/import_root.h"
#include "tests/fuzz/require.h"
#include "tests/support/temporary_directory.h"

namespace argmesh {
namespace {

constexpr int64_t kMaxBytes = 1000;
constexpr char kInside[] = "inside";

class Folders {
 public:
  Folders() {
    namespace fs = std::filesystem;
    const fs::path root = folder_.path() / "root";
    fs::create_directories(root / "a" / "b");
    std::ofstream(folder_.path() / "f") << "outside";
    for (const fs::path& inside : {root, root / "a", root / "a" / "b"}) {
      std::ofstream(inside / "f") << kInside;
    }
    fs::create_symlink("../f", root / "l");
    fs::create_directory_symlink("..", root / "a" / "u");
    auto opened = ImportRoot::Open(root);
    Require(opened.ok(), "the root");
    root_ = *std::move(opened);
  }
  const ImportRoot& root() const { return *root_; }

 private:
  const TemporaryDirectory folder_;
  std::unique_ptr<ImportRoot> root_;
};

void FuzzPaths(const std::string& folder, const std::string& file) {
  static const Folders folders;
  const auto read = folders.root().Read(folder, file, kMaxBytes);
  Require(read.ok() ? *read == kInside
                    : ReasonOf(read.status()) == ErrorReason::kFileUnreadable,
          "only what is inside is read");
  const auto listed = folders.root().ListFiles(folder, {});
  if (!listed.ok()) {
    Require(ReasonOf(listed.status()) == ErrorReason::kFileUnreadable,
            "a folder that is none");
    return;
  }
  for (const std::string& path : *listed) {
    Require(path.find("..") == std::string::npos && !path.starts_with('/'),
            "only what is inside is listed");
  }
}

}  // namespace
}  // namespace argmesh

// The folder, a line break, the file.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const size_t end = text.find('\n');
  argmesh::FuzzPaths(std::string(text.substr(0, end)),
                     end == std::string_view::npos
                         ? std::string()
                         : std::string(text.substr(end + 1)));
  return 0;
}
