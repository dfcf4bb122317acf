// SPDX-License-Identifier: MIT
#pragma once

#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "lacuna/cli/commands/cli.hpp"

namespace lacuna::testing {

/// What a run of the command line gave.
struct CommandResult {
  int status = 0;
  std::string out;
  std::string err;
};

/// Runs the command line inside this process: run_command({"list", "basis"}).
/// @param answers to its questions, a line each.
inline CommandResult run_command(std::vector<std::string> arguments,
                                 const Registry& registry = default_registry(),
                                 const std::string& answers = "") {
  arguments.insert(arguments.begin(), "lacuna");
  std::vector<const char*> pointers;
  for (const std::string& argument : arguments) pointers.push_back(argument.c_str());
  std::ostringstream out, err;
  std::istringstream in(answers);
  const int status = run_cli(static_cast<int>(pointers.size()), pointers.data(), registry,
                             {out, err, &in});
  return {status, out.str(), err.str()};
}

/// A shown text without its indented lines: each is joined to the one before it, so that sentences
/// can be found however they are folded.
inline std::string unfolded(const std::string& text) {
  return std::regex_replace(text, std::regex("\n +"), " ");
}

}  // namespace lacuna::testing
