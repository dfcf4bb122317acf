// SPDX-License-Identifier: MIT
#pragma once

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
inline CommandResult run_command(std::vector<std::string> arguments,
                                 const Registry& registry = default_registry()) {
  arguments.insert(arguments.begin(), "lacuna");
  std::vector<const char*> pointers;
  for (const std::string& argument : arguments) pointers.push_back(argument.c_str());
  std::ostringstream out, err;
  const int status =
      run_cli(static_cast<int>(pointers.size()), pointers.data(), registry, {out, err});
  return {status, out.str(), err.str()};
}

}  // namespace lacuna::testing
