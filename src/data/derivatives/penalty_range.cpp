// SPDX-License-Identifier: MIT
#include "data/derivatives/penalty_range.hpp"

#include <cmath>

#include "core/base/check.hpp"
#include "data/derivatives/excerpt.hpp"

namespace lacuna {

PenaltyRange penalty_range(double step, int order) {
  check_argument(step > 0.0 && order > 0, "penalty_range", "step or order is not positive");
  const double unit = std::pow(step, 2 * order - 1);
  return {1e-6 * unit, 1e11 * unit};
}

Index penalty_margin(double lambda, double step, int order) {
  check_argument(step > 0.0 && order > 0 && lambda > 0.0, "penalty_margin",
                 "lambda, step or order is not positive");
  const double samples = std::pow(lambda / std::pow(step, 2 * order - 1), 0.5 / order);
  return static_cast<Index>(std::ceil(2.0 * std::min(samples, 1e6)));
}

ChosenPenalty chosen_penalty(const Dataset& part, const PenalisedProblem& problem,
                             const Matrix& values, PenaltyChoice choice,
                             const std::optional<Vector>& noise) {
  const int order = static_cast<int>(problem.null_space);
  const double step = mean_step(part.trajectories.front());
  const PenaltyRange range = penalty_range(step, order);
  const Vector sigma = choice == PenaltyChoice::Noise ? noise_of(part, noise) : Vector();
  const double lambda =
      choose_lambda(problem, values, choice, sigma, range.least, range.largest);
  return {lambda, penalty_margin(lambda, step, order)};
}

}  // namespace lacuna
