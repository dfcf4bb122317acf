// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <functional>
#include <ostream>
#include <string>
#include <utility>

#include "lacuna/core/base/run_context.hpp"

namespace lacuna::cli {

/// A first answer for somebody who watches a run: it is shown where the run goes on, not where
/// the final answer follows at once.
class FirstScreen {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// @param begin of the run.
  FirstScreen(std::ostream& stream, Time begin) : stream_(stream), begin_(begin) {}

  void take(std::string text) { text_ = std::move(text); }

  /// Writes what was taken, once, over the line of progress.
  void show(Time now);

 private:
  std::ostream& stream_;
  Time begin_;
  std::string text_;
};

/// A progress function that shows a first screen as well, which has to outlive it.
std::function<void(const Progress&)> beside(FirstScreen& screen,
                                            std::function<void(const Progress&)> shown);

}  // namespace lacuna::cli
