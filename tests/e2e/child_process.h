// A program run beside the test: started by posix_spawn, its two output
// streams kept in files.
#ifndef ARGMESH_TESTS_E2E_CHILD_PROCESS_H_
#define ARGMESH_TESTS_E2E_CHILD_PROCESS_H_

#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace argmesh {

class ChildProcess {
 public:
  // `words` are the program's path and its arguments; the streams go to
  // NAME.out and NAME.err below `folder`.
  ChildProcess(const std::vector<std::string>& words,
               const std::filesystem::path& folder, const std::string& name);
  ~ChildProcess();  // kills it when it still runs
  ChildProcess(ChildProcess&& other) noexcept;
  ChildProcess& operator=(ChildProcess&&) = delete;

  // What it has written so far.
  std::string Out() const;
  std::string Err() const;

  pid_t pid() const { return pid_; }
  void Signal(int signal) const;
  bool Running();
  // Waits for the end: the exit code, or 128 + the signal that ended it.
  int Wait();

 private:
  pid_t pid_ = -1;
  std::optional<int> exit_code_;
  std::filesystem::path out_;
  std::filesystem::path err_;
};

// The bytes of a file; none where there is no file.
std::string ReadAll(const std::filesystem::path& path);

}  // namespace argmesh

#endif  // ARGMESH_TESTS_E2E_CHILD_PROCESS_H_
