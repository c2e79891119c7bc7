#include "tests/reliability/simulated_disk.h"

#include <algorithm>
#include <fstream>
#include <functional>

namespace argmesh {
namespace {

namespace fs = std::filesystem;

constexpr size_t kSectorBytes = 512;
constexpr uint64_t kSectorsPerTear = 8;

// Whether a change that is not durable is on the disk all the same.
bool IsKept(SimulatedDisk::Loss loss, Random& random) {
  if (loss == SimulatedDisk::Loss::kEverything) return false;
  if (loss == SimulatedDisk::Loss::kNothing) return true;
  return random.Below(2) == 0;
}

}  // namespace

void DiskImage::WriteTo(const fs::path& folder) const {
  for (const std::string& name : folders) fs::create_directory(folder / name);
  for (const auto& [name, bytes] : files) {
    std::ofstream(folder / name, std::ios::binary) << bytes;
  }
}

SimulatedDisk::SimulatedDisk(fs::path root)
    : root_path_(std::move(root)), root_(std::make_shared<Node>()) {
  root_->is_folder = true;
}

void SimulatedDisk::Node::Name(const std::string& name, const NodePtr& node) {
  if (node == nullptr) {
    names.erase(name);
  } else {
    names[name] = node;
  }
  name_changes.emplace_back(name, node);
}

SimulatedDisk::NodePtr SimulatedDisk::Find(const fs::path& path) const {
  NodePtr node = root_;
  for (const fs::path& name : path.lexically_relative(root_path_)) {
    if (name == ".") continue;
    const auto it = node->names.find(name.string());
    if (it == node->names.end()) return nullptr;  // was removed while open
    node = it->second;
  }
  return node;
}

void SimulatedDisk::Apply(const FileCall& call) {
  const fs::path path = call.path;
  switch (call.kind) {
    case FileCall::Kind::kCreate:
    case FileCall::Kind::kMakeFolder: {
      const auto node = std::make_shared<Node>();
      node->is_folder = call.kind == FileCall::Kind::kMakeFolder;
      Find(path.parent_path())->Name(path.filename().string(), node);
      return;
    }
    case FileCall::Kind::kRename: {
      const NodePtr node = Find(path);
      const fs::path to = call.new_path;
      Find(to.parent_path())->Name(to.filename().string(), node);
      Find(path.parent_path())->Name(path.filename().string(), nullptr);
      return;
    }
    case FileCall::Kind::kRemove:
      Find(path.parent_path())->Name(path.filename().string(), nullptr);
      return;
    case FileCall::Kind::kSync:
      if (const NodePtr node = Find(path)) Sync(*node);
      return;
    case FileCall::Kind::kWrite:
    case FileCall::Kind::kTruncate:
      if (const NodePtr node = Find(path)) {
        node->changes.push_back({call.kind == FileCall::Kind::kTruncate,
                                 call.offset, std::string(call.bytes)});
      }
      return;
  }
}

void SimulatedDisk::Sync(Node& node) {
  node.durable_names = node.names;
  node.name_changes.clear();
  for (const Change& change : node.changes) {
    const auto offset = static_cast<size_t>(change.offset);
    if (change.truncates) {
      node.bytes.resize(offset);
      continue;
    }
    if (node.bytes.size() < offset + change.bytes.size()) {
      node.bytes.resize(offset + change.bytes.size());
    }
    std::copy(change.bytes.begin(), change.bytes.end(),
              node.bytes.begin() + change.offset);
  }
  node.changes.clear();
}

size_t SimulatedDisk::Change::end(size_t extent) const {
  return truncates ? extent : static_cast<size_t>(offset) + bytes.size();
}

SimulatedDisk::Seen SimulatedDisk::DecideSeen(const Node& file, Loss loss,
                                              Random& random) {
  Seen seen;
  seen.extent = file.bytes.size();
  for (const Change& change : file.changes) {
    seen.extent = std::max(seen.extent, change.end(0));
  }
  seen.by_sector.resize(seen.extent / kSectorBytes + 1, 0);
  for (size_t i = 0; i < file.changes.size(); ++i) {
    const Change& change = file.changes[i];
    const bool whole = IsKept(loss, random);
    if (IsKept(loss, random)) seen.by_size = i + 1;
    for (size_t at = static_cast<size_t>(change.offset) / kSectorBytes;
         at * kSectorBytes < change.end(seen.extent); ++at) {
      const bool kept = loss == Loss::kSectors ? IsKept(loss, random) : whole;
      if (kept) seen.by_sector[at] = i + 1;
    }
  }
  return seen;
}

std::string SimulatedDisk::BytesLeft(const Node& file, Loss loss,
                                     Random& random) {
  const Seen seen = DecideSeen(file, loss, random);
  std::string bytes = file.bytes;
  bytes.resize(seen.extent, random.Below(2) == 0 ? '\0' : '\xA5');
  size_t size = file.bytes.size();
  for (size_t i = 0; i < file.changes.size(); ++i) {
    const Change& change = file.changes[i];
    const auto begin = static_cast<size_t>(change.offset);
    const size_t end = change.end(seen.extent);
    if (i < seen.by_size) size = change.truncates ? begin : std::max(size, end);
    for (size_t at = begin; at < end;) {
      const size_t sector = at / kSectorBytes;
      const size_t next = std::min(end, (sector + 1) * kSectorBytes);
      size_t kept = i < seen.by_sector[sector] ? next - at : 0;
      if (loss == Loss::kSectors && i == seen.by_sector[sector] &&
          random.Below(kSectorsPerTear) == 0) {
        kept = random.Below(next - at + 1);
      }
      const std::string written = change.truncates
                                      ? std::string(kept, '\0')
                                      : change.bytes.substr(at - begin, kept);
      bytes.replace(at, kept, written);
      at = next;
    }
  }
  bytes.resize(size);
  return bytes;
}

std::map<std::string, SimulatedDisk::NodePtr> SimulatedDisk::NamesLeft(
    const Node& folder, Loss loss, Random& random) {
  std::map<std::string, size_t> seen;
  for (size_t i = 0; i < folder.name_changes.size(); ++i) {
    if (IsKept(loss, random)) seen[folder.name_changes[i].first] = i + 1;
  }
  std::map<std::string, NodePtr> names = folder.durable_names;
  for (size_t i = 0; i < folder.name_changes.size(); ++i) {
    const auto& [name, node] = folder.name_changes[i];
    if (i >= seen[name]) continue;
    if (node == nullptr) {
      names.erase(name);
    } else {
      names[name] = node;
    }
  }
  return names;
}

DiskImage SimulatedDisk::ImageAfterPowerLoss(Loss loss, Random& random) const {
  DiskImage image;
  const std::function<void(const Node&, const std::string&)> add =
      [&](const Node& folder, const std::string& prefix) {
        for (const auto& [name, node] : NamesLeft(folder, loss, random)) {
          const std::string path = prefix + name;
          if (node->is_folder) {
            image.folders.push_back(path);
            add(*node, path + "/");
          } else {
            image.files[path] = BytesLeft(*node, loss, random);
          }
        }
      };
  add(*root_, "");
  return image;
}

}  // namespace argmesh
