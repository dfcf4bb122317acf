// SPDX-License-Identifier: MIT
#include "core/base/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace lacuna {
namespace {

/// What the workers share.
class Queue {
 public:
  Queue(std::size_t count, FunctionRef<void(std::size_t)> work)
      : count_(count), failed_at_(count), work_(work) {}

  /// Takes calls until there are no more.
  void serve() {
    for (std::size_t i = next_++; i < count_ && !failed_; i = next_++) {
      try {
        work_(i);
      } catch (...) {
        keep_failure(i, std::current_exception());
      }
    }
  }

  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  void keep_failure(std::size_t i, std::exception_ptr failure) {
    const std::lock_guard lock(guard_);
    failed_ = true;
    if (i >= failed_at_) return;
    failed_at_ = i;
    failure_ = std::move(failure);
  }

  std::size_t count_, failed_at_;
  FunctionRef<void(std::size_t)> work_;
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> failed_{false};
  std::mutex guard_;
  std::exception_ptr failure_;
};

}  // namespace

void parallel_for(std::size_t count, int threads, FunctionRef<void(std::size_t)> work) {
  Queue queue(count, work);
  const std::size_t helpers =
      std::min(count, static_cast<std::size_t>(std::max(threads, 1))) - (count > 0 ? 1 : 0);
  {
    std::vector<std::jthread> pool;
    pool.reserve(helpers);
    try {
      for (std::size_t i = 0; i < helpers; ++i) pool.emplace_back([&] { queue.serve(); });
    } catch (const std::system_error&) {
      // The machine gives no more threads: those that are there do the work.
    }
    queue.serve();
  }
  queue.rethrow();
}

}  // namespace lacuna
