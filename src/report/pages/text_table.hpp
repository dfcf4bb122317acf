// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace lacuna {

/// Rows under one another, columns as wide as they need, two blanks in front and between.
std::string text_table(const std::vector<std::vector<std::string>>& rows);

}  // namespace lacuna
