// What a power loss may leave of a folder.
//
// Beside the files themselves it keeps what of them is durable: bytes that were
// synced since they were written, and names whose folder was synced since they
// changed. Everything else may be on the disk or not: each write as a whole,
// or in any of its sectors of 512 bytes, or up to a byte in the middle of one;
// the size of a file apart from its bytes, where nothing was written any bytes;
// each name of a folder apart from the others. Of the changes to one sector or
// one name, a later one is never there without the earlier ones.
// That is what SQLite assumes of a disk with powersafe overwrite, its default:
// https://www.sqlite.org/atomiccommit.html, https://www.sqlite.org/psow.html.
#ifndef ARGMESH_TESTS_RELIABILITY_SIMULATED_DISK_H_
#define ARGMESH_TESTS_RELIABILITY_SIMULATED_DISK_H_

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/base/random.h"
#include "tests/reliability/file_calls.h"

namespace argmesh {

// Paths relative to the folder.
struct DiskImage {
  std::vector<std::string> folders;  // each after the one it is in
  std::map<std::string, std::string> files;

  // `folder` must be there and empty.
  void WriteTo(const std::filesystem::path& folder) const;
};

class SimulatedDisk {
 public:
  enum class Loss {
    kEverything,  // that is not durable
    kWholeWrites,
    kSectors,
    kNothing,
  };

  // `root` is there, durable and empty.
  explicit SimulatedDisk(std::filesystem::path root);

  // Calls that succeeded, in the order they were made.
  void Apply(const FileCall& call);

  DiskImage ImageAfterPowerLoss(Loss loss, Random& random) const;

 private:
  struct Change {
    bool truncates = false;
    int64_t offset = 0;
    std::string bytes;

    size_t end(size_t extent) const;  // `extent`: of the file, at most
  };
  // How many of a file's changes are on the disk.
  struct Seen {
    size_t extent = 0;  // the largest size the file ever had
    size_t by_size = 0;
    std::vector<size_t> by_sector;
  };
  struct Node;
  using NodePtr = std::shared_ptr<Node>;
  struct Node {
    bool is_folder = false;
    std::string bytes;            // durable
    std::vector<Change> changes;  // since then
    std::map<std::string, NodePtr> names;
    std::map<std::string, NodePtr> durable_names;
    // Since then; null: removed.
    std::vector<std::pair<std::string, NodePtr>> name_changes;

    void Name(const std::string& name, const NodePtr& node);
  };

  NodePtr Find(const std::filesystem::path& path) const;
  static void Sync(Node& node);
  static Seen DecideSeen(const Node& file, Loss loss, Random& random);
  static std::string BytesLeft(const Node& file, Loss loss, Random& random);
  static std::map<std::string, NodePtr> NamesLeft(const Node& folder, Loss loss,
                                                  Random& random);

  std::filesystem::path root_path_;
  NodePtr root_;
};

}  // namespace argmesh

#endif  // ARGMESH_TESTS_RELIABILITY_SIMULATED_DISK_H_
