// argmeshd: serves until SIGTERM; SIGHUP reads the options again. With
// --restore it puts a snapshot in the place of the data instead.
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
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "core/base/status_macros.h"
#include "core/base/stop_token.h"
#include "server/options.h"
#include "server/process_heap.h"
#include "server/serving.h"

namespace argmesh {
namespace {

constexpr int kExitFailed = 1;
constexpr int kExitUsage = 2;
constexpr absl::Duration kBetweenLooks = absl::Milliseconds(10);
constexpr absl::Duration kBetweenTrims = absl::Seconds(10);

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

// Waits for one of the signals, at most so long; 0 when there was none.
int WaitFor(const sigset_t& signals, absl::Duration at_most) {
  const timespec time = absl::ToTimespec(at_most);
  return std::max(0, sigtimedwait(&signals, nullptr, &time));
}

int WaitForStop(absl::Duration at_most) {
  return WaitFor(StopSignals(), at_most);
}

// Takes the signals while the server is not there yet.
class StopWhileOpening {
 public:
  StopWhileOpening()
      : watcher_([this](const std::stop_token& end) {
          while (signal_ == 0 && !end.stop_requested()) {
            signal_ = WaitForStop(kBetweenLooks);
          }
          if (signal_ != 0) stop_.request_stop();
        }) {}

  StopToken token() const {
    return StopToken(stop_.get_token(), absl::InfiniteFuture());
  }
  // The signal that came; 0: none. Takes none from now on.
  int End() {
    watcher_.request_stop();
    if (watcher_.joinable()) watcher_.join();
    return signal_;
  }

 private:
  std::stop_source stop_;
  int signal_ = 0;  // the watcher's until it has ended
  std::jthread watcher_;
};

// NOT_SERVING, the drain delay, then no new calls and the end of those there
// are. A second signal skips the waiting.
void Drain(const ServerOptions& options, RpcServer& server, EventLog& log) {
  server.StopAdvertising();
  absl::Duration timeout = options.drain_timeout;
  if (options.drain_delay > absl::ZeroDuration() &&
      WaitForStop(options.drain_delay) != 0) {
    timeout = absl::ZeroDuration();
  }
  const absl::Time begin = absl::Now();
  const bool clean = server.Shutdown(begin + timeout);
  log.Write(clean ? LogLevel::kInfo : LogLevel::kWarning, "drained",
            {{"every_call_finished", clean},
             {"elapsed_ms", absl::ToDoubleMilliseconds(absl::Now() - begin)}});
}

absl::StatusOr<ParsedOptions> Parse(const std::vector<std::string>& arguments) {
  return ParseServerOptions(arguments, ProcessEnvironment(), ARGMESH_VERSION);
}

// SIGHUP: file and environment are read again, under the flags of the start.
void Reload(const std::vector<std::string>& arguments, Serving& serving) {
  const absl::StatusOr<ParsedOptions> parsed = Parse(arguments);
  if (parsed.ok()) {
    serving.Reload(parsed->options);
  } else {
    serving.log().Write(LogLevel::kError, "not reloaded",
                        {{"error", parsed.status().ToString()}});
  }
}

absl::Status Serve(const std::vector<std::string>& arguments,
                   const ServerOptions& options, std::ostream& log) {
  LimitHeaps();
  StopWhileOpening opening;
  absl::StatusOr<std::unique_ptr<Serving>> started =
      Serving::Start(options, log, opening.token());
  int signal = opening.End();
  if (signal != 0 && absl::IsCancelled(started.status())) {
    EventLog(log).Write(LogLevel::kInfo, "stopped before it served");
    return absl::OkStatus();
  }
  ARGMESH_RETURN_IF_ERROR(started.status());
  const std::unique_ptr<Serving> serving = *std::move(started);
  if (!options.port_file.empty()) {
    ARGMESH_RETURN_IF_ERROR(
        WritePortFile(options.port_file, serving->rpc().address()));
  }
  serving->log().Write(LogLevel::kInfo, "serving",
                       {{"address", serving->rpc().address()},
                        {"version", std::string(ARGMESH_VERSION)},
                        {"data", options.data}});

  sigset_t signals = StopSignals();
  sigaddset(&signals, SIGHUP);
  while (signal == 0 || signal == SIGHUP) {
    if (signal == SIGHUP) Reload(arguments, *serving);
    signal = WaitFor(signals, kBetweenTrims);
    if (signal == 0) TrimHeaps();
  }
  serving->log().Write(
      LogLevel::kInfo, "stopping",
      {{"signal", std::string(signal == SIGTERM ? "SIGTERM" : "SIGINT")}});
  Drain(options, serving->rpc(), serving->log());
  ARGMESH_RETURN_IF_ERROR(serving->Close());
  serving->log().Write(LogLevel::kInfo, "stopped");
  return absl::OkStatus();
}

int Main(const std::vector<std::string>& arguments) {
  const absl::StatusOr<ParsedOptions> parsed = Parse(arguments);
  if (!parsed.ok()) {
    std::cerr << "argmeshd: " << parsed.status().message() << "\n";
    return kExitUsage;
  }
  if (parsed->answer) {
    std::cout << *parsed->answer;
    return 0;
  }
  const ServerOptions& options = parsed->options;
  absl::Status valid = CheckServerOptions(options);
  if (valid.ok() && options.data.empty() && !options.print_config) {
    valid = absl::InvalidArgumentError("--data is required");
  }
  if (!valid.ok()) {
    std::cerr << "argmeshd: " << valid.message() << "\n";
    return kExitUsage;
  }
  if (options.print_config) std::cout << FormatServerOptions(options);
  if (options.print_config || options.check_config) return 0;

  if (!options.restore.empty()) {
    const absl::Status restored = Restore(options, std::cout);
    if (restored.ok()) return 0;
    std::cerr << "argmeshd: not restored: " << restored.message() << "\n";
    return kExitFailed;
  }

  const absl::Status served = Serve(arguments, options, std::cerr);
  if (served.ok()) return 0;
  EventLog(std::cerr).Write(LogLevel::kError, "failed",
                            {{"error", served.ToString()}});
  return kExitFailed;
}

}  // namespace
}  // namespace argmesh

int main(int argc, char** argv) {
  // Before any thread is started, so that every thread inherits it and only
  // those that wait for the signals see them.
  sigset_t signals = argmesh::StopSignals();
  sigaddset(&signals, SIGHUP);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  signal(SIGPIPE, SIG_IGN);
  return argmesh::Main(std::vector<std::string>(argv + 1, argv + argc));
}
