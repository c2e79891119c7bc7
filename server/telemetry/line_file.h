// A file that whole lines are added to.
//
// Thread-safe. Opened for appending, so that several processes and a rotation
// (rename, then Reopen) lose no line. A file that would grow beyond its bound
// is renamed to FILE.1, in the place of the one before, and begun anew: both
// together take twice the bound at most.
#ifndef ARGMESH_SERVER_TELEMETRY_LINE_FILE_H_
#define ARGMESH_SERVER_TELEMETRY_LINE_FILE_H_

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "absl/status/statusor.h"

namespace argmesh {

class LineFile {
 public:
  // Creates the file, readable by its owner only. `max_bytes` is its bound; 0,
  // and for what is no file (a terminal, a pipe): none. kUnavailable naming it.
  static absl::StatusOr<std::unique_ptr<LineFile>> Open(const std::string& path,
                                                        int64_t max_bytes = 0);
  ~LineFile();
  LineFile(const LineFile&) = delete;
  LineFile& operator=(const LineFile&) = delete;

  // Adds `line` and a line break in one write(2). What cannot be written is
  // counted and dropped: telemetry never fails a call.
  void Write(std::string_view line);
  int64_t dropped() const { return dropped_; }

  // Opens the path again, after it was renamed. On failure the file that is
  // open stays.
  absl::Status Reopen();

 private:
  LineFile(std::string path, int64_t max_bytes, int descriptor);
  // With the mutex, all three.
  void Use(int descriptor);
  bool MakeRoom(int64_t bytes);
  bool Rotate();

  const std::string path_;
  const int64_t max_bytes_;
  std::mutex mutex_;
  int descriptor_ = -1;
  bool bounded_ = false;
  int64_t bytes_ = 0;  // of the file
  std::atomic<int64_t> dropped_{0};
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_TELEMETRY_LINE_FILE_H_
