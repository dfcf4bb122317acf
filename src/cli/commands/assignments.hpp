// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace lacuna::cli {

/// One part NAME=VALUE of an option.
struct Assignment {
  std::string text, name, value;
};

/// How an option that assigns is written.
struct AssignmentForm {
  std::string_view option;   ///< "--map"
  std::string_view form;     ///< "NAME=COLUMN"
  std::string_view example;  ///< "--map th=Winkel,u=3"
};

/// The parts of an option that was given so often, each a list: "a=1,b=2".
/// @throws ConfigError for a part that has no name or no '=', and for a name that stands twice,
///   with both parts.
std::vector<Assignment> read_assignments(const AssignmentForm& form,
                                         const std::vector<std::string>& texts);

}  // namespace lacuna::cli
