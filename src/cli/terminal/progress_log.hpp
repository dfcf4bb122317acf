// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <ostream>
#include <string>
#include <thread>

#include "lacuna/core/base/run_context.hpp"

namespace lacuna::cli {

/// Time between two lines in a log. At half of it the log of an hour has 720 lines; at double a
/// scheduler's user who looks for life waits for 20 s.
inline constexpr std::chrono::seconds kLogInterval{10};

/// "lacuna: 20 s: fitting: 45 %"; without a percentage before anything is counted.
std::string log_line(const std::string& activity, double fraction, std::chrono::seconds passed);

/// Writes a line every so often, by a thread of its own, to a stream that is no terminal: what
/// takes long is seen to live even where nothing reports.
class ProgressLog {
 public:
  explicit ProgressLog(std::ostream& stream,
                       std::chrono::steady_clock::duration interval = kLogInterval);
  ProgressLog(const ProgressLog&) = delete;
  ProgressLog& operator=(const ProgressLog&) = delete;
  ~ProgressLog();  ///< ends the thread

  /// What the next line is about.
  void note(const Progress& progress);

 private:
  void write_lines();

  std::ostream& stream_;
  const std::chrono::steady_clock::duration interval_;
  const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::mutex mutex_;
  std::condition_variable ended_;
  bool ends_ = false;
  std::string activity_ = "at work";
  double fraction_ = 0.0;
  std::thread thread_;
};

}  // namespace lacuna::cli
