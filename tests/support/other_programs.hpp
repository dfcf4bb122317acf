// SPDX-License-Identifier: MIT
// Compilers and interpreters that may be on a machine.
#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace lacuna::testing {

/// Whether a command ends well.
inline bool can_run(const std::string& call) {
  return std::system((call + " > /dev/null 2>&1").c_str()) == 0;
}

/// A Python that has a module; empty where there is none.
inline std::string python_with(const std::string& module) {
  for (const char* python : {"python3", "/usr/bin/python3"})
    if (can_run(std::string(python) + " -c 'import " + module + "'")) return python;
  return "";
}

/// The numbers that a command prints.
inline std::vector<double> printed_numbers(const std::string& command) {
  std::vector<double> numbers;
  FILE* pipe = popen(command.c_str(), "r");
  double value = 0.0;
  while (pipe != nullptr && std::fscanf(pipe, "%lf", &value) == 1) numbers.push_back(value);
  EXPECT_EQ(pclose(pipe), 0) << command;
  return numbers;
}

}  // namespace lacuna::testing
