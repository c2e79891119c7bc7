// The built programs at work: a server process with a folder of its own, and
// the command line against it.
#ifndef ARGMESH_TESTS_E2E_INSTALLATION_H_
#define ARGMESH_TESTS_E2E_INSTALLATION_H_

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tests/e2e/child_process.h"
#include "tests/support/temporary_directory.h"

namespace argmesh {

struct CommandOutcome {
  int exit_code = 0;
  std::string out;
  std::string err;

  // `out` as JSON; a discarded value when it is none.
  nlohmann::ordered_json Json() const;
};

class Installation {
 public:
  const std::filesystem::path& folder() const { return folder_.path(); }
  const std::string& address() const { return address_; }

  // Starts the server and waits until it serves; at the address of before when
  // it ran before, with `more` options. False with its log on stderr when it
  // does not come up.
  bool StartServer(const std::vector<std::string>& more = {});
  // Starts it and returns.
  void LaunchServer(const std::vector<std::string>& more = {});
  // Waits until the server has logged `text` so many times; false when it does
  // not.
  bool WaitForLog(const std::string& text, int times = 1);
  void SignalServer(int signal);
  bool ServerRuns();
  pid_t server_pid() const { return server_->pid(); }
  // What the running or last server has logged.
  std::string ServerLog() const;
  // Waits for the server's end.
  int WaitForServer();

  // Runs `argmesh` with these words to its end.
  CommandOutcome Run(const std::vector<std::string>& words);
  // Runs `argmeshd` with these words to its end, beside the server.
  CommandOutcome RunServerProgram(const std::vector<std::string>& words);
  // Starts it and returns.
  ChildProcess Start(const std::vector<std::string>& words);

  void WriteFile(const std::string& relative, const std::string& bytes) const;
  std::string ReadFile(const std::string& relative) const;

 private:
  TemporaryDirectory folder_;
  std::string address_;
  std::optional<ChildProcess> server_;
  int commands_ = 0;
};

}  // namespace argmesh

#endif  // ARGMESH_TESTS_E2E_INSTALLATION_H_
