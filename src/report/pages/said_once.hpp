// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace lacuna {

/// Two names at most: "a.csv", "a.csv, b.csv", "a.csv and 4 more".
std::string briefly(const std::vector<std::string>& names, const std::string& separator = ", ");

/// Sentences that differ only in the place in front of them, once for all places: of "a.csv: the
/// column s is text" and "b.csv: the column s is text" the one "a.csv, b.csv: the column s is
/// text". Each stands where it stood first; one that is there twice stands once.
std::vector<std::string> said_once(const std::vector<std::string>& sentences);

}  // namespace lacuna
