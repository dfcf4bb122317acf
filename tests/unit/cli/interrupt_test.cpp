// SPDX-License-Identifier: MIT
#include "../src/cli/interrupt.hpp"

#include <gtest/gtest.h>
#include <pthread.h>
#include <unistd.h>

#include <condition_variable>
#include <mutex>

namespace lacuna::cli {
namespace {

bool interrupt_is_blocked() {
  sigset_t present;
  pthread_sigmask(SIG_BLOCK, nullptr, &present);
  return sigismember(&present, SIGINT) == 1;
}

TEST(InterruptGuard, TurnsAnInterruptIntoAStopRequest) {
  const InterruptGuard guard;
  std::mutex mutex;
  std::condition_variable changed;
  bool stopped = false;
  const std::stop_callback notify(guard.token(), [&] {
    const std::lock_guard lock(mutex);
    stopped = true;
    changed.notify_one();
  });
  kill(getpid(), SIGINT);
  std::unique_lock lock(mutex);
  EXPECT_TRUE(changed.wait_for(lock, std::chrono::seconds(10), [&] { return stopped; }));
}

TEST(InterruptGuard, LeavesTheSignalMaskAsItWas) {
  const bool before = interrupt_is_blocked();
  {
    const InterruptGuard guard;
    EXPECT_TRUE(interrupt_is_blocked());
    EXPECT_FALSE(guard.token().stop_requested());
  }
  EXPECT_EQ(interrupt_is_blocked(), before);
}

}  // namespace
}  // namespace lacuna::cli
