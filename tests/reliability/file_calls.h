// The calls with which this process changes files, seen as they are made.
//
// A program that has file_calls.cc among its own sources calls the open,
// write, fsync, rename ... defined there instead of the C library's. So do
// SQLite and the C++ library inside it: one seam below everything that
// stores, and none in what is tested. Memory mappings are not seen (of
// SQLite's files only -shm, which holds nothing that has to last), nor is
// std::filesystem::remove_all.
#ifndef ARGMESH_TESTS_RELIABILITY_FILE_CALLS_H_
#define ARGMESH_TESTS_RELIABILITY_FILE_CALLS_H_

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace argmesh {

struct FileCall {
  enum class Kind {
    kCreate,  // of a file that was not there
    kWrite,
    kTruncate,
    kSync,  // fsync or fdatasync, of a file or a folder
    kRename,
    kRemove,  // of a file
    kMakeFolder,
  };
  Kind kind = Kind::kWrite;
  std::string path;        // absolute
  std::string new_path;    // kRename
  int64_t offset = 0;      // kWrite: of the bytes; kTruncate: the new size
  std::string_view bytes;  // kWrite
};

const char* FileCallName(FileCall::Kind kind);  // such as "write"

// Called by one thread at a time. Must not change files itself.
class FileCallObserver {
 public:
  virtual ~FileCallObserver() = default;
  // 0: the call is made. Else it fails with this errno.
  virtual int Before(const FileCall& call) = 0;
  // The call succeeded.
  virtual void After(const FileCall& call) = 0;
};

// While it lives every call on a path below `root`, and on `root`, is shown to
// `observer`; syncs are not made beyond that, for they take long and this
// machine keeps its power. One at a time; `root` without symbolic links.
class FileCallObservation {
 public:
  FileCallObservation(const std::filesystem::path& root,
                      FileCallObserver* observer);
  ~FileCallObservation();
  FileCallObservation(const FileCallObservation&) = delete;
  FileCallObservation& operator=(const FileCallObservation&) = delete;
};

}  // namespace argmesh

#endif  // ARGMESH_TESTS_RELIABILITY_FILE_CALLS_H_
