// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <csignal>
#include <stop_token>
#include <thread>

namespace lacuna::cli {

/// Turns an interrupt (SIGINT, Ctrl-C) into a stop request for as long as it lives. The signal
/// is blocked and waited for by a thread of its own, so nothing runs inside a signal handler.
/// After an interrupt that thread also breaks into system calls of the caller that block (a
/// pipe that nobody writes to). Where no thread can be started an interrupt ends the program.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  std::stop_token token() const { return stop_.get_token(); }

 private:
  void wait(pthread_t caller);

  std::stop_source stop_;
  sigset_t interrupt_;
  sigset_t before_;
  struct sigaction nudged_before_;
  std::atomic<bool> ended_{false};
  std::thread waiter_;
};

}  // namespace lacuna::cli
