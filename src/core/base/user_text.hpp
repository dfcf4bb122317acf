// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lacuna/core/base/error.hpp"

namespace lacuna {

/// What an error says to those who call no functions: that of an ArgumentError without its
/// place, which is the name of a function.
inline std::string user_text(const Error& error) {
  if (dynamic_cast<const ArgumentError*>(&error) == nullptr) return error.what();
  return error.problem() + (error.remedy().empty() ? "" : "; " + error.remedy());
}

}  // namespace lacuna
