// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>

namespace lacuna::cli {

/// An argument as a shell takes it: in quotes where it has more than letters of file names.
std::string shell_word(const std::string& argument);

/// A command as a shell takes it.
std::string shell_line(std::span<const std::string> words);

}  // namespace lacuna::cli
