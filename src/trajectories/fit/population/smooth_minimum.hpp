// SPDX-License-Identifier: MIT
// The minimum of a smooth function of few numbers of which there are values only.
#pragma once

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// Where a search for a minimum starts, and between which limits.
struct SmoothTask {
  Vector start;
  Matrix curvature;     ///< second derivatives, about; positive definite
  Vector lower, upper;  ///< infinite where there is none; equal: the number is held
  int most_iterations = 100;
  /// Step of central differences, in lengths over which the function changes by a half: the
  /// error is the square of it.
  double difference = 1e-3;
  /// Ends where a step promises a smaller decrease than this.
  double tolerance = 1e-9;
};

/// Where it ended.
struct SmoothMinimum {
  Vector place;
  double value = 0.0;
  Matrix curvature;  ///< second derivatives as the search has learned them
  bool converged = false;
  int iterations = 0;
  bool in_time = true;  ///< or a deadline ended it before
};

/// Minimises a function by the BFGS method with derivatives from central differences, numbers
/// kept in their ranges by an active set (Nocedal and Wright, Numerical Optimization (2006),
/// Ch. 6 and Sect. 8.1).
/// @param function its value; infinite where there is none.
/// Past a deadline it ends with the best place so far.
/// @param moved is called with each place that the search goes to.
SmoothMinimum minimise_smooth(FunctionRef<double(const Vector&)> function,
                              FunctionRef<void(const Vector&)> moved, const SmoothTask& task,
                              const RunContext& context);

/// Second derivatives by central differences.
/// @param steps of each number, > 0; rows and columns of others are 0.
Matrix second_derivatives(FunctionRef<double(const Vector&)> function, const Vector& place,
                          const Vector& steps, const RunContext& context);

}  // namespace lacuna
