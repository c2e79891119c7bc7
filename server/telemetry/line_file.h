// A file that whole lines are added to.
//
// Thread-safe. Opened for appending, so that several processes and a rotation
// (rename, then Reopen) lose no line.
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
  // Creates the file, readable by its owner only. kUnavailable naming it.
  static absl::StatusOr<std::unique_ptr<LineFile>> Open(
      const std::string& path);
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
  LineFile(std::string path, int descriptor);

  const std::string path_;
  std::mutex mutex_;
  int descriptor_;
  std::atomic<int64_t> dropped_{0};
};

}  // namespace argmesh

#endif  // ARGMESH_SERVER_TELEMETRY_LINE_FILE_H_
