// SPDX-License-Identifier: MIT
#include <algorithm>
#include <exception>
#include <limits>
#include <nlopt.hpp>
#include <vector>

#include "design_search.hpp"

namespace lacuna {
namespace {

/// The best point of a search: NLopt may end at another one.
struct LeastDesign {
  FunctionRef<double(const Vector&)> function;
  Vector point;
  double least = std::numeric_limits<double>::infinity();
  std::exception_ptr failure = nullptr;  ///< of the function: NLopt passes on none but its own
};

double evaluated_design(const std::vector<double>& at, std::vector<double>&, void* data) {
  auto& best = *static_cast<LeastDesign*>(data);
  const Vector point = Eigen::Map<const Vector>(at.data(), static_cast<Index>(at.size()));
  double value = 0.0;
  try {
    value = best.function(point);
  } catch (...) {
    best.failure = std::current_exception();
    throw nlopt::forced_stop();
  }
  if (value < best.least) {
    best.least = value;
    best.point = point;
  }
  return value;
}

}  // namespace

Vector least_design(FunctionRef<double(const Vector&)> function, const Vector& start,
                    int evaluations) {
  constexpr double kFirstStep = 0.15;
  constexpr double kLeastStep = 1e-7;  // below it no input changes by what a converter makes
  LeastDesign best{.function = function, .point = start};
  nlopt::opt search(nlopt::LN_SBPLX, static_cast<unsigned>(start.size()));
  search.set_min_objective(evaluated_design, &best);
  search.set_lower_bounds(0.0);
  search.set_upper_bounds(1.0);
  std::vector<double> steps;
  for (const double value : start)
    steps.push_back(value + kFirstStep <= 1.0 ? kFirstStep : -kFirstStep);
  search.set_initial_step(steps);
  search.set_xtol_abs(kLeastStep);
  search.set_maxeval(std::max(evaluations, 1));
  std::vector<double> at(start.begin(), start.end());
  double least = 0.0;
  try {
    search.optimize(at, least);
  } catch (const nlopt::roundoff_limited&) {
    // An outcome like any other: `best` has the point.
  } catch (const nlopt::forced_stop&) {
    std::rethrow_exception(best.failure);
  }
  return best.point;
}

}  // namespace lacuna
