// SPDX-License-Identifier: MIT
#pragma once

#include <csignal>
#include <stop_token>
#include <thread>

namespace lacuna::cli {

/// Turns an interrupt (SIGINT, Ctrl-C) into a stop request for as long as it lives. The signal
/// is blocked and waited for by a thread of its own, so nothing runs inside a signal handler.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  std::stop_token token() const { return stop_.get_token(); }

 private:
  std::stop_source stop_;
  sigset_t interrupt_;
  sigset_t before_;
  std::thread waiter_;
};

}  // namespace lacuna::cli
