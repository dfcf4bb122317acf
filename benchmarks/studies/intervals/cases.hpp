// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <vector>

#include "lacuna/data/records/dataset.hpp"

namespace lacuna::benchmarks {

/// How measured values are made and what the fitted model says of them.
enum class MeasuredBy {
  Normal,     ///< deviation of 10 % of each output's own
  LogNormal,  ///< deviation of 0.1 of the logarithm
  Censored,   ///< normal; below the 20 % quantile of the output only that it is there
  Truncated   ///< normal; below that quantile nothing is recorded
};

inline constexpr std::array<const char*, 4> kMeasuredBy = {"normal", "log-normal", "censored",
                                                           "truncated"};

/// A system with known numbers. In its text an output ends with `noise LAW`, which draws replace.
struct IntervalCase {
  std::string name;
  std::string text;  ///< free parameters with their true values
  std::vector<double> start;
  std::vector<double> times;
};

/// Logistic growth, Lotka-Volterra, FitzHugh-Nagumo, Hindmarsh-Rose, protein transduction.
std::vector<IntervalCase> interval_cases();

/// A record and the model that is fitted to it.
struct IntervalDraw {
  Dataset columns;
  std::string model;          ///< parameters start up to 20 % off
  std::vector<double> truth;  ///< of its free parameters
};

/// The same number makes the same draw.
IntervalDraw interval_draw(const IntervalCase& one, MeasuredBy noise, std::uint64_t number);

}  // namespace lacuna::benchmarks
