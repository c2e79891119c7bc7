// Ctrl-C as a stop request: the first one (SIGINT or SIGTERM) asks a command
// to finish what is under way, the second ends the process at once.
//
// Make it before any thread is started: the signals are blocked in the calling
// thread and those it starts, and taken by a thread of its own. One at a time.
#ifndef ARGMESH_CLIENT_CLI_INTERRUPT_H_
#define ARGMESH_CLIENT_CLI_INTERRUPT_H_

#include <csignal>
#include <functional>
#include <stop_token>
#include <thread>

namespace argmesh {

class Interrupt {
 public:
  // `on_first` is called by the signal thread at the first signal.
  explicit Interrupt(std::function<void()> on_first);
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  std::stop_token token() const { return source_.get_token(); }

 private:
  void WaitForSignals();

  std::function<void()> on_first_;
  sigset_t signals_;
  sigset_t before_;
  std::stop_source source_;
  std::thread thread_;
};

}  // namespace argmesh

#endif  // ARGMESH_CLIENT_CLI_INTERRUPT_H_
