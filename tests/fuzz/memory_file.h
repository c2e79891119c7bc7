// A file in memory, for code that reads files by their path.
#ifndef ARGMESH_TESTS_FUZZ_MEMORY_FILE_H_
#define ARGMESH_TESTS_FUZZ_MEMORY_FILE_H_

#include <sys/mman.h>
#include <unistd.h>

#include <string>
#include <string_view>

#include "tests/fuzz/require.h"

namespace argmesh {

class MemoryFile {
 public:
  MemoryFile()
      : file_(memfd_create("fuzz", MFD_CLOEXEC)),
        path_("/proc/self/fd/" + std::to_string(file_)) {
    Require(file_ >= 0, "a file in memory");
  }
  ~MemoryFile() { close(file_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  const std::string& path() const { return path_; }

  void Store(std::string_view bytes) const {
    Require(ftruncate(file_, 0) == 0 &&
                pwrite(file_, bytes.data(), bytes.size(), 0) ==
                    static_cast<ssize_t>(bytes.size()),
            "the bytes are stored");
  }

 private:
  const int file_;
  const std::string path_;
};

}  // namespace argmesh

#endif  // ARGMESH_TESTS_FUZZ_MEMORY_FILE_H_
