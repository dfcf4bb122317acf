// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>

#include "lacuna/model/equations/system_model.hpp"

namespace lacuna {

/// How many digits numbers have that people read.
struct Digits {
  bool full = false;                     ///< all: what is read back is the same double
  std::optional<int> significant = {};   ///< so many, 1 to 17; nothing: two of the interval
};

/// Reads "auto", "full" or a number of digits from 1 to 17. @throws ConfigError for others.
Digits parse_digits(std::string_view text);

/// Significant digits that show two digits of an error e: floor(lg|v|) - floor(lg e) + 2, from 2
/// to 17; 4 where there is no error. What is rounded so moves by at most e/20.
int digits_of(double value, double error);

/// Half of the 95 % interval of a coefficient, where it is known and not 0.
std::optional<double> half_interval(const WeightedTerm& summand);

/// A formula with its numbers rounded to so many significant digits, and sums with them as
/// people write these: "-y" for 0-y, "x+2" for x-(-2). Delays of numbers are rounded, too.
Expression with_rounded_numbers(const Expression& formula, int digits);

/// The model with coefficients and values of parameters rounded: by their 95 % intervals, or to
/// the digits asked for. What is fixed stays, and so does what has no interval unless a number
/// of digits is asked for. Numbers inside terms keep eight digits, far more than records
/// determine (their intervals are not part of a model).
SystemModel rounded(const SystemModel& model, const Digits& digits = {});

}  // namespace lacuna
