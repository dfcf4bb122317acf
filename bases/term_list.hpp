// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/model/equations/term.hpp"

namespace lacuna {

/// Reads a list of terms that stands in an option.
/// @param place name of the option for messages, e.g. "monomials.include".
/// @throws ModelError naming the option, the entry and the column.
std::vector<Term> parse_term_list(const std::string& place,
                                  const std::vector<std::string>& texts,
                                  const Variables& variables);

}  // namespace lacuna
