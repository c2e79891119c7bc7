// What every command of `argmesh` works with: the global options, the two
// output streams, the server.
#ifndef ARGMESH_CLIENT_CLI_SESSION_H_
#define ARGMESH_CLIENT_CLI_SESSION_H_

#include <memory>
#include <ostream>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "client/cli/json.h"
#include "client/client.h"
#include "client/client_options.h"

namespace argmesh {

// The exit codes of `argmesh`.
enum ExitCode : int {
  kExitOk = 0,
  kExitFailed = 1,       // something, perhaps one item of many, failed
  kExitUsage = 2,        // the command line is wrong
  kExitUnreachable = 3,  // no server answers
  kExitInterrupted = 130,
};

struct GlobalOptions {
  std::string server = "127.0.0.1:7411";
  double timeout_seconds = 120;
  bool json = false;
  ClientTls tls;
  std::string key_file;  // its first line is the key; empty: ARGMESH_KEY
};

struct Session {
  GlobalOptions options;
  std::ostream& out;
  std::ostream& err;
  bool err_is_terminal = false;

  absl::StatusOr<std::unique_ptr<Client>> Connect() const;

  // One JSON document on `out`.
  void Print(const Json& json) const;
  // "argmesh: <text>" on `err`.
  void Note(std::string_view text) const;
  // Tells a command's error to people, and to programs with --json; the exit
  // code it calls for.
  int Fail(const absl::Status& status) const;
};

// An error of the command line itself: exit code 2.
absl::Status UsageError(std::string_view message);

int ExitCodeOf(const absl::Status& status);

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_CLI_SESSION_H_
