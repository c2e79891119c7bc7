#include "client/cli/interrupt.h"

#include <pthread.h>
#include <unistd.h>

#include <utility>

#include "client/cli/session.h"

namespace argmesh {
namespace {

// Sent by the destructor to the thread alone.
constexpr int kEndSignal = SIGUSR1;

}  // namespace

Interrupt::Interrupt(std::function<void()> on_first)
    : on_first_(std::move(on_first)) {
  sigemptyset(&signals_);
  sigaddset(&signals_, SIGINT);
  sigaddset(&signals_, SIGTERM);
  sigaddset(&signals_, kEndSignal);
  pthread_sigmask(SIG_BLOCK, &signals_, &before_);
  thread_ = std::thread([this] { WaitForSignals(); });
}

Interrupt::~Interrupt() {
  pthread_kill(thread_.native_handle(), kEndSignal);
  thread_.join();
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

void Interrupt::WaitForSignals() {
  while (true) {
    int signal = 0;
    if (sigwait(&signals_, &signal) != 0 || signal == kEndSignal) return;
    if (source_.stop_requested()) _exit(kExitInterrupted);
    source_.request_stop();
    on_first_();
  }
}

}  // namespace argmesh
