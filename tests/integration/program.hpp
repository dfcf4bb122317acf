// SPDX-License-Identifier: MIT
// Runs the built program as a user does.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <string>
#include <vector>

#include "support/run_command.hpp"
#include "support/temporary_folder.hpp"

namespace lacuna::testing {

/// What system() returns as a shell has it: 128 and more for a signal.
inline int exit_status(int status) {
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// Runs `lacuna` with arguments as a shell reads them; `before` stands in front ("timeout 5").
inline CommandResult run_program(const std::string& arguments, const std::string& before = "") {
  const TemporaryFolder folder;
  const std::string command = before + " '" + LACUNA_COMMAND + "' " + arguments + " > '" +
                              folder.file("out") + "' 2> '" + folder.file("err") + "'";
  const int status = std::system(command.c_str());
  return {exit_status(status), folder.read("out"), folder.read("err")};
}

/// The same of a command that has to end with status 0.
inline CommandResult run_program_well(const std::string& arguments) {
  CommandResult result = run_program(arguments);
  EXPECT_EQ(result.status, 0) << arguments << ": " << result.err;
  return result;
}

/// Expects an error of one line that has all the given parts.
inline void expect_program_error(const std::string& arguments, int status,
                                 const std::vector<std::string>& parts) {
  const CommandResult result = run_program(arguments);
  EXPECT_EQ(result.status, status) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(result.err.rfind("lacuna: error: ", 0), 0u) << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
  for (const std::string& part : parts) EXPECT_THAT(result.err, ::testing::HasSubstr(part));
}

}  // namespace lacuna::testing
