// SPDX-License-Identifier: MIT
#include "progress_log.hpp"

#include <new>
#include <system_error>

#include "progress_line.hpp"

namespace lacuna::cli {

std::string log_line(const std::string& activity, double fraction,
                     std::chrono::seconds passed) {
  return "lacuna: " + std::to_string(passed.count()) + " s: " + how_far(activity, fraction) +
         "\n";
}

ProgressLog::ProgressLog(std::ostream& stream, std::chrono::steady_clock::duration interval)
    : stream_(stream), interval_(interval) {
  try {
    thread_ = std::thread([this] { write_lines(); });
  } catch (const std::system_error&) {  // no thread is left: the run goes on in silence
  }
}

ProgressLog::~ProgressLog() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  ended_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void ProgressLog::note(const Progress& progress) {
  const std::lock_guard lock(mutex_);
  activity_ = progress.activity;
  fraction_ = progress.fraction;
}

void ProgressLog::write_lines() try {
  std::unique_lock lock(mutex_);
  while (!ended_.wait_for(lock, interval_, [this] { return ends_; })) {
    const auto passed = std::chrono::steady_clock::now() - begin_;
    stream_ << log_line(activity_, fraction_,
                        std::chrono::duration_cast<std::chrono::seconds>(passed))
            << std::flush;
  }
} catch (const std::bad_alloc&) {  // a line is not worth the run
}

}  // namespace lacuna::cli
