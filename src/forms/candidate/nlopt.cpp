// SPDX-License-Identifier: MIT
#include <algorithm>
#include <exception>
#include <limits>
#include <nlopt.hpp>
#include <vector>

#include "shape_search.hpp"

namespace lacuna {
namespace {

/// What a search has found so far: NLopt may end (limits, rounding) at a point that is not its
/// best.
struct Best {
  FunctionRef<double(const Vector&)> function;
  Vector point;
  double least = std::numeric_limits<double>::infinity();
  int evaluations = 0;
  std::exception_ptr failure = nullptr;  ///< of the function: NLopt passes on none but its own
};

double evaluated(const std::vector<double>& at, std::vector<double>&, void* data) {
  Best& best = *static_cast<Best*>(data);
  const Vector point = Eigen::Map<const Vector>(at.data(), static_cast<Index>(at.size()));
  double value = 0.0;
  try {
    value = best.function(point);
  } catch (...) {
    best.failure = std::current_exception();
    throw nlopt::forced_stop();
  }
  ++best.evaluations;
  if (value < best.least) {
    best.least = value;
    best.point = point;
  }
  return value;
}

nlopt::opt method(Best& best, const SimplexSettings& settings) {
  // A decision: of three parameters Sbplx is far from the least value after the evaluations that
  // a search has (40 for each), of one and two nearer than Nelder and Mead's method
  // (benchmarks/kernels/search_benchmark.cpp).
  constexpr unsigned kSizeOfSbplx = 2;
  // A fact of the method: steps below this change no shape that is printed.
  constexpr double kLeastStep = 1e-7;
  const auto size = static_cast<unsigned>(best.point.size());
  const bool by_sbplx = settings.method == CubeMethod::Sbplx || size <= kSizeOfSbplx;
  nlopt::opt method(by_sbplx ? nlopt::LN_SBPLX : nlopt::LN_NELDERMEAD, size);
  method.set_min_objective(evaluated, &best);
  method.set_lower_bounds(0.0);
  method.set_upper_bounds(1.0);
  std::vector<double> steps;
  for (const double value : best.point)
    steps.push_back(value + settings.reach <= 1.0 ? settings.reach : -settings.reach);
  method.set_initial_step(steps);
  method.set_xtol_abs(kLeastStep);
  method.set_ftol_abs(settings.unnoticed);
  return method;
}

bool is_on_a_face(const Vector& point) {
  return (point.array() == 0.0 || point.array() == 1.0).any();
}

}  // namespace

Vector least_in_cube(FunctionRef<double(const Vector&)> function, const Vector& start,
                     const SimplexSettings& settings) {
  Best best{.function = function, .point = start.cwiseMax(0.0).cwiseMin(1.0)};
  for (;;) {
    const double before = best.least;
    nlopt::opt search = method(best, settings);
    search.set_maxeval(std::max(1, settings.evaluations - best.evaluations));
    std::vector<double> at(best.point.begin(), best.point.end());
    double least = 0.0;
    try {
      search.optimize(at, least);
    } catch (const nlopt::roundoff_limited&) {
      // An outcome like any other: `best` has the point.
    } catch (const nlopt::forced_stop&) {
      std::rethrow_exception(best.failure);
    }
    const bool improved = best.least < before - settings.unnoticed;
    const bool ends = settings.method == CubeMethod::Sbplx || !is_on_a_face(best.point);
    if (ends || !improved || best.evaluations >= settings.evaluations)
      return best.point;
  }
}

bool searches_by_nlopt() { return true; }

}  // namespace lacuna
