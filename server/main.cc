// argmeshd: wires storage, engine and gRPC, and lives until SIGTERM.
//
// Exit codes: 0 stopped as asked, 1 could not start or stop cleanly, 2 the
// command line is wrong. stderr carries one JSON object a line.
#include <pthread.h>
#include <signal.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "core/base/status_macros.h"
#include "server/engine/engine.h"
#include "server/options.h"
#include "server/telemetry/event_log.h"
#include "server/rpc/rpc_server.h"
#include "server/storage/data_directory.h"
#include "server/storage/directory_mesh_store.h"
#include "server/storage/sqlite_catalog.h"

namespace argmesh {
namespace {

constexpr int kExitFailed = 1;
constexpr int kExitUsage = 2;

RpcServerOptions RpcOptionsOf(const ServerOptions& options) {
  RpcServerOptions rpc;
  rpc.listen = options.listen;
  rpc.insecure_remote = options.insecure_remote;
  rpc.reflection = options.reflection;
  rpc.version = ARGMESH_VERSION;
  rpc.limits.max_inflight_searches = options.max_inflight_searches;
  rpc.limits.max_inflight_uploads = options.max_inflight_uploads;
  rpc.limits.max_inflight_ingests = options.max_inflight_ingests;
  rpc.limits.stream_idle_timeout = options.stream_idle_timeout;
  return rpc;
}

EngineOptions EngineOptionsOf(const ServerOptions& options) {
  EngineOptions engine;
  engine.mesh_limits.max_bytes = options.max_mesh_bytes;
  if (options.threads > 0) {
    engine.pool.threads = {options.threads, std::max(1, options.threads - 1),
                           2 * options.threads};
  }
  return engine;
}

absl::StatusOr<std::unique_ptr<Engine>> OpenEngine(
    const ServerOptions& options) {
  ARGMESH_ASSIGN_OR_RETURN(std::shared_ptr<DataDirectory> directory,
                           DataDirectory::Open(options.data));
  ARGMESH_ASSIGN_OR_RETURN(std::unique_ptr<DirectoryMeshStore> meshes,
                           DirectoryMeshStore::Open(directory));
  ARGMESH_ASSIGN_OR_RETURN(std::unique_ptr<SqliteCatalog> catalog,
                           SqliteCatalog::Open(directory));
  return Engine::Create(EngineOptionsOf(options), std::move(catalog),
                        std::move(meshes));
}

// Written whole or not at all: a script that sees the file can read it.
absl::Status WritePortFile(const std::string& path,
                           const std::string& address) {
  const std::string unfinished = path + ".part";
  {
    std::ofstream out(unfinished, std::ios::trunc);
    out << address << '\n';
    if (!out.flush()) {
      return absl::UnavailableError("cannot write " + unfinished);
    }
  }
  std::error_code error;
  std::filesystem::rename(unfinished, path, error);
  return error ? absl::UnavailableError(
                     absl::StrCat("cannot write ", path, ": ", error.message()))
               : absl::OkStatus();
}

sigset_t StopSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGTERM);
  sigaddset(&signals, SIGINT);
  return signals;
}

// False when a second signal came before `delay` was over.
bool WaitUnlessSignalled(absl::Duration delay) {
  const sigset_t signals = StopSignals();
  const timespec time = absl::ToTimespec(delay);
  return sigtimedwait(&signals, nullptr, &time) < 0;
}

// NOT_SERVING, the drain delay, then no new calls and the end of those there
// are. A second signal skips the waiting.
void Drain(const ServerOptions& options, RpcServer& server, EventLog& log) {
  server.StopAdvertising();
  absl::Duration timeout = options.drain_timeout;
  if (options.drain_delay > absl::ZeroDuration() &&
      !WaitUnlessSignalled(options.drain_delay)) {
    timeout = absl::ZeroDuration();
  }
  const absl::Time begin = absl::Now();
  const bool clean = server.Shutdown(begin + timeout);
  log.Write(clean ? LogLevel::kInfo : LogLevel::kWarning, "drained",
            {{"every_call_finished", clean},
             {"elapsed_ms", absl::ToDoubleMilliseconds(absl::Now() - begin)}});
}

absl::Status Serve(const ServerOptions& options, EventLog& log) {
  ARGMESH_ASSIGN_OR_RETURN(const std::unique_ptr<Engine> engine,
                           OpenEngine(options));
  ARGMESH_ASSIGN_OR_RETURN(
      const std::unique_ptr<RpcServer> server,
      RpcServer::Start(RpcOptionsOf(options), *engine, log));
  if (!options.port_file.empty()) {
    ARGMESH_RETURN_IF_ERROR(
        WritePortFile(options.port_file, server->address()));
  }
  log.Write(LogLevel::kInfo, "serving",
            {{"address", server->address()},
             {"version", std::string(ARGMESH_VERSION)},
             {"data", options.data}});

  const sigset_t signals = StopSignals();
  int signal = 0;
  sigwait(&signals, &signal);
  log.Write(
      LogLevel::kInfo, "stopping",
      {{"signal", std::string(signal == SIGTERM ? "SIGTERM" : "SIGINT")}});
  Drain(options, *server, log);
  ARGMESH_RETURN_IF_ERROR(engine->Close());
  log.Write(LogLevel::kInfo, "stopped");
  return absl::OkStatus();
}

int Main(const std::vector<std::string>& arguments) {
  const absl::StatusOr<ParsedOptions> parsed =
      ParseServerOptions(arguments, ProcessEnvironment(), ARGMESH_VERSION);
  if (!parsed.ok()) {
    std::cerr << "argmeshd: " << parsed.status().message() << "\n";
    return kExitUsage;
  }
  if (parsed->answer) {
    std::cout << *parsed->answer;
    return 0;
  }
  const ServerOptions& options = parsed->options;
  absl::Status valid = CheckListenAddress(RpcOptionsOf(options));
  if (valid.ok() && options.data.empty() && !options.print_config) {
    valid = absl::InvalidArgumentError("--data is required");
  }
  if (!valid.ok()) {
    std::cerr << "argmeshd: " << valid.message() << "\n";
    return kExitUsage;
  }
  if (options.print_config) std::cout << FormatServerOptions(options);
  if (options.print_config || options.check_config) return 0;

  EventLog log(std::cerr);
  const absl::Status served = Serve(options, log);
  if (served.ok()) return 0;
  log.Write(LogLevel::kError, "failed", {{"error", served.ToString()}});
  return kExitFailed;
}

}  // namespace
}  // namespace argmesh

int main(int argc, char** argv) {
  // Before any thread is started, so that every thread inherits it and only
  // sigwait sees the signals.
  const sigset_t signals = argmesh::StopSignals();
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  signal(SIGPIPE, SIG_IGN);
  return argmesh::Main(std::vector<std::string>(argv + 1, argv + argc));
}
