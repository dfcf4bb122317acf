// SPDX-License-Identifier: MIT
#include "interrupt.hpp"

#include <pthread.h>

#include <chrono>
#include <system_error>

namespace lacuna::cli {
namespace {

/// Ends a system call that blocks with EINTR; what it does otherwise is nothing, as by default.
constexpr int kNudge = SIGURG;

}  // namespace

InterruptGuard::InterruptGuard() : interrupt_(), before_(), nudged_before_() {
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
  stop_.request_stop();
  while (!ended_) {
    pthread_kill(caller, kNudge);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
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
