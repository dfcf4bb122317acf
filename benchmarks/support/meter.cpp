// SPDX-License-Identifier: MIT
#include "support/meter.hpp"

#include <malloc.h>

#include <fstream>
#include <string>

namespace lacuna::benchmarks {
namespace {

/// A number of /proc/self/status, in MB.
double status_megabytes(const std::string& name) {
  std::ifstream status("/proc/self/status");
  for (std::string word; status >> word;) {
    double kilobytes = 0.0;
    if (word == name && status >> kilobytes) return kilobytes / 1024.0;
  }
  return 0.0;
}

}  // namespace

Meter::Meter() : cpu_(std::clock()) {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";  // the largest resident set starts anew
  before_ = status_megabytes("VmRSS:");
  begin_ = std::chrono::steady_clock::now();
}

Reading Meter::read() const {
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin_;
  return {wall.count(), static_cast<double>(std::clock() - cpu_) / CLOCKS_PER_SEC,
          status_megabytes("VmHWM:") - before_};
}

}  // namespace lacuna::benchmarks
