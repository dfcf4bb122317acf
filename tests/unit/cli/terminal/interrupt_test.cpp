// SPDX-License-Identifier: MIT
#include "cli/terminal/interrupt.hpp"

#include <gtest/gtest.h>
#include <pthread.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include "core/files/atomic_file.hpp"
#include "support/temporary_folder.hpp"

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

/// Interrupts this process, then works on without a look at the token.
[[noreturn]] void work_on_after_an_interrupt(const char* file) {
  const InterruptGuard guard(std::chrono::milliseconds(1));
  kill(getpid(), SIGINT);
  for (long round = 0;; ++round) {
    if (file != nullptr) write_file_atomically(file, std::to_string(round));
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

TEST(InterruptGuard, EndsAProcessThatDoesNotStop) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  EXPECT_EXIT(work_on_after_an_interrupt(nullptr), ::testing::ExitedWithCode(kInterrupted),
              "lacuna: interrupted");
}

TEST(InterruptGuard, LeavesWholeFilesOnly) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const testing::TemporaryFolder folder;
  for (int run = 0; run < 3; ++run)
    EXPECT_EXIT(work_on_after_an_interrupt(folder.file("f").c_str()),
                ::testing::ExitedWithCode(kInterrupted), "lacuna: interrupted");
  EXPECT_LE(folder.count(), 1);  // no temporary file
}

TEST(InterruptGuard, WaitsForAFileThatIsBeingWritten) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const auto write_for_long = [] {
    const auto held = try_to_hold_files();
    const InterruptGuard guard(std::chrono::milliseconds(1));
    kill(getpid(), SIGINT);
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    _exit(held && guard.token().stop_requested() ? 7 : 1);
  };
  EXPECT_EXIT(write_for_long(), ::testing::ExitedWithCode(7), "");
}

}  // namespace
}  // namespace lacuna::cli
