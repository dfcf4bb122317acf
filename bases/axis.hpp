// SPDX-License-Identifier: MIT
// What bases of functions of single variables have in common.
#pragma once

#include <string>
#include <vector>

#include "lacuna/regression/stages/basis.hpp"

namespace lacuna {

/// States, and inputs behind them where they are wanted.
std::vector<std::string> axis_names(const Variables& variables, bool with_inputs);

/// 1 and the variables themselves, with which such a basis begins.
std::vector<Term> linear_terms(const std::vector<std::string>& names,
                               const Variables& variables);

/// "x" for the range -1 to 1, else "((x-3)/2)" for 1 to 5.
std::string scaled_axis(const std::string& name, double low, double high);

/// "x", "(x-3)" or "(x+3)".
std::string shifted_axis(const std::string& name, double centre);

/// `count` places with equal spacing, low and high among them.
std::vector<double> places_between(double low, double high, int count);

/// @throws ConfigError unless low < high, both finite.
void check_range_of_axis(const std::string& basis, double low, double high);

/// @throws ConfigError for more than 100 000 terms.
void check_number_of_terms(const std::string& basis, std::size_t terms);

}  // namespace lacuna
