// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <chrono>
#include <csignal>
#include <optional>
#include <stop_token>
#include <thread>

namespace lacuna::cli {

constexpr int kInterrupted = 130;  ///< exit status, as shells have it: 128 + SIGINT

/// Turns an interrupt (SIGINT, Ctrl-C) into a stop request for as long as it lives. The signal
/// is blocked and waited for by a thread of its own, so nothing runs inside a signal handler.
/// After an interrupt that thread also breaks into system calls of the caller that block (a
/// pipe that nobody writes to). Where no thread can be started an interrupt ends the program.
///
/// With a patience the process is ended, with status 130, if the guard still lives so long
/// after the interrupt: some steps (a factorisation by Eigen) cannot be stopped. A file that is
/// being written is finished first.
class InterruptGuard {
 public:
  using Patience = std::optional<std::chrono::milliseconds>;

  /// @param patience without one the process is never ended
  explicit InterruptGuard(Patience patience = {});
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  std::stop_token token() const { return stop_.get_token(); }

 private:
  void wait(pthread_t caller);
  bool is_due(std::chrono::steady_clock::time_point interrupted) const;

  Patience patience_;
  std::stop_source stop_;
  sigset_t interrupt_;
  sigset_t before_;
  struct sigaction nudged_before_;
  std::atomic<bool> ended_{false};
  std::thread waiter_;
};

}  // namespace lacuna::cli
