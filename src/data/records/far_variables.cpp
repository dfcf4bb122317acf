// SPDX-License-Identifier: MIT
#include "far_variables.hpp"

#include <cmath>
#include <utility>

#include "core/base/text.hpp"

namespace lacuna {
namespace {

/// Sums over the values that there are.
template <class Summand>
double sum_over(const std::vector<Vector>& columns, Summand summand) {
  double sum = 0.0;
  for (const Vector& column : columns)
    for (const double value : column)
      if (!std::isnan(value)) sum += summand(value);
  return sum;
}

FarVariable position_of(const std::string& name, const std::vector<Vector>& columns) {
  const double count = sum_over(columns, [](double) { return 1.0; });
  const double mean = sum_over(columns, [&](double value) { return value / count; });
  const double square =
      sum_over(columns, [&](double value) { return std::pow(value - mean, 2) / count; });
  const double deviation = std::sqrt(square);
  constexpr double kRounding = 1e-14;  // a fact: what subtracting a mean leaves of a constant
  if (!(deviation > kRounding * std::abs(mean)) || !std::isfinite(deviation)) return {name};
  const double digit = std::pow(10.0, std::floor(std::log10(deviation)));
  const double centre = std::round(mean / digit) * digit;
  constexpr int kDigits = 15;  // a fact of doubles: so many are the same when they are read
  return {name, parse_number(format_number(centre, kDigits)).value_or(centre),
          std::abs(mean) / deviation};
}

}  // namespace

std::vector<FarVariable> far_variables(const Dataset& data) {
  constexpr double kFar = 20.0;  // standard deviations
  std::vector<FarVariable> far;
  const auto look_at = [&](const std::vector<Quantity>& quantities,
                           const Matrix Trajectory::*values) {
    for (std::size_t k = 0; k < quantities.size(); ++k) {
      std::vector<Vector> columns;
      for (const Trajectory& record : data.trajectories)
        if (static_cast<Index>(k) < (record.*values).cols())  // who identifies says so
          columns.emplace_back((record.*values).col(static_cast<Index>(k)));
      FarVariable one = position_of(quantities[k].name, columns);
      if (one.deviations > kFar) far.push_back(std::move(one));
    }
  };
  look_at(data.states, &Trajectory::states);
  look_at(data.inputs, &Trajectory::inputs);
  return far;
}

}  // namespace lacuna
