// SPDX-License-Identifier: MIT
#include "interrupt.hpp"

#include <pthread.h>
#include <unistd.h>

#include <string_view>
#include <system_error>

#include "core/files/atomic_file.hpp"

namespace lacuna::cli {
namespace {

/// Ends a system call that blocks with EINTR; what it does otherwise is nothing, as by default.
constexpr int kNudge = SIGURG;

/// Ends the process unless a file is being written.
void end_process() {
  const auto held = try_to_hold_files();
  if (!held) return;
  constexpr std::string_view kMessage = "lacuna: interrupted\n";
  [[maybe_unused]] const auto written = write(STDERR_FILENO, kMessage.data(), kMessage.size());
  _exit(kInterrupted);
}

}  // namespace

InterruptGuard::InterruptGuard(Patience patience)
    : patience_(patience), interrupt_(), before_(), nudged_before_() {
  sigemptyset(&interrupt_);
  sigaddset(&interrupt_, SIGINT);
  pthread_sigmask(SIG_BLOCK, &interrupt_, &before_);
  struct sigaction nudged {};
  nudged.sa_handler = [](int) {};
  sigaction(kNudge, &nudged, &nudged_before_);  // without SA_RESTART
  try {
    waiter_ = std::thread([this, caller = pthread_self()] { wait(caller); });
  } catch (const std::system_error&) {
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }
}

/// A nudge that comes just before the call that blocks is lost: so there is one after another.
void InterruptGuard::wait(pthread_t caller) {
  int signal = 0;
  sigwait(&interrupt_, &signal);
  const auto interrupted = std::chrono::steady_clock::now();
  stop_.request_stop();
  while (!ended_) {
    if (is_due(interrupted)) end_process();
    pthread_kill(caller, kNudge);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

bool InterruptGuard::is_due(std::chrono::steady_clock::time_point interrupted) const {
  return patience_ && std::chrono::steady_clock::now() - interrupted >= *patience_;
}

InterruptGuard::~InterruptGuard() {
  ended_ = true;
  if (waiter_.joinable()) {
    pthread_kill(waiter_.native_handle(), SIGINT);  // ends the wait if nothing came
    waiter_.join();
  }
  sigaction(kNudge, &nudged_before_, nullptr);
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

}  // namespace lacuna::cli
