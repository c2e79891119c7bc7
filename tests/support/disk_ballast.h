// A disk that is made full.
#ifndef ARGMESH_TESTS_SUPPORT_DISK_BALLAST_H_
#define ARGMESH_TESTS_SUPPORT_DISK_BALLAST_H_

#include <fcntl.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>

namespace argmesh {

// Others write to the disk too: far more than they do meanwhile.
inline constexpr int64_t kDiskMargin = 1LL << 30;

// Of the disk that temporary directories are on.
inline int64_t FreeDiskBytes() {
  struct statvfs status {};
  if (statvfs(std::filesystem::temp_directory_path().c_str(), &status) != 0) {
    return 0;
  }
  return static_cast<int64_t>(status.f_bavail) *
         static_cast<int64_t>(status.f_frsize);
}

// Space of the disk that is taken while one lives.
class DiskBallast {
 public:
  explicit DiskBallast(const std::filesystem::path& path)
      : path_(path), file_(open(path.c_str(), O_WRONLY | O_CREAT, 0600)) {}
  ~DiskBallast() {
    close(file_);
    unlink(path_.c_str());
  }
  DiskBallast(const DiskBallast&) = delete;
  DiskBallast& operator=(const DiskBallast&) = delete;

  bool Take(int64_t bytes) const { return fallocate(file_, 0, 0, bytes) == 0; }

 private:
  const std::filesystem::path path_;
  const int file_;
};

}  // namespace argmesh

#endif  // ARGMESH_TESTS_SUPPORT_DISK_BALLAST_H_
