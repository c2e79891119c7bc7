// The command line of argmeshd.
//
// Every option may also be given in a file (--config FILE; TOML or INI) and in
// the environment: --max-mesh-bytes is ARGMESH_MAX_MESH_BYTES; an empty
// variable counts as none. Flags win over the environment, the environment wins
// over the file. A key of the file that
// is no option is an error that names it.
#ifndef ARGMESH_SERVER_OPTIONS_H_
#define ARGMESH_SERVER_OPTIONS_H_

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "absl/time/time.h"

namespace argmesh {

struct ServerOptions {
  std::string data;                       // folder; required to serve
  std::string listen = "127.0.0.1:7411";  // HOST:PORT, port 0: a free one
  std::string import_root;                // a folder; empty: no imports
  int threads = 0;                        // 0 .. 1024; 0: from the CPUs
  int64_t max_mesh_bytes = 512LL << 20;   // 1 .. 2^40
  int64_t mesh_memory = 2LL << 30;        // bytes, 2^20 .. 2^50
  int max_inflight_searches = 64;         // 1 .. 100,000
  int max_inflight_uploads = 32;          // 1 .. 100,000
  int max_inflight_ingests = 8;           // 1 .. 100,000
  absl::Duration stream_idle_timeout = absl::Seconds(60);
  absl::Duration drain_delay = absl::ZeroDuration();
  absl::Duration drain_timeout = absl::Seconds(20);
  bool reflection = true;
  bool insecure_remote = false;

  // Encryption and callers; all are files.
  std::string tls_cert;
  std::string tls_key;
  std::string tls_client_ca;
  std::string keys;

  // What is told of the work.
  std::string log_level = "info";      // debug, info, warning, error
  std::string audit_log;               // a file; empty: none
  std::string trace_log;               // a file; empty: none
  int64_t max_log_bytes = 64LL << 20;  // of each of them, 0 .. 2^40; 0: any
  std::string metrics_listen;          // HOST:PORT; empty: none

  std::string port_file;  // receives HOST:PORT when serving; empty: none

  // What to do instead of serving.
  bool check_config = false;
  bool print_config = false;
  std::string restore;  // a snapshot
};

// Looks a variable of the environment up.
using Environment =
    std::function<std::optional<std::string>(const std::string& name)>;
Environment ProcessEnvironment();

struct ParsedOptions {
  ServerOptions options;
  // Set when the command line is answered by this text alone (--help,
  // --version).
  std::optional<std::string> answer;
};

// `arguments` without the program's name. kInvalidArgument naming the option,
// key or variable.
absl::StatusOr<ParsedOptions> ParseServerOptions(
    const std::vector<std::string>& arguments, const Environment& environment,
    std::string_view version);

// As a file for --config.
std::string FormatServerOptions(const ServerOptions& options);

}  // namespace argmesh

#endif  // ARGMESH_SERVER_OPTIONS_H_
