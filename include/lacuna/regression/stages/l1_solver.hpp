// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/core/base/stage.hpp"
#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// min_z |c - R z|^2 + sum_j penalty_j |z_j| in triangular form; z are coefficients of columns
/// scaled to unit norm.
struct L1Problem {
  Matrix triangle;  ///< R, k x k upper triangular
  Vector target;    ///< c, k
  Vector penalty;   ///< k, >= 0
  Vector start;     ///< k, first guess
};

/// What an inner solver found.
struct L1Solution {
  Vector coefficients;
  int iterations = 0;
  bool converged = true;
};

/// Plug point: the inner solver of l1-regularised regression.
class L1Solver : public StageInterface {
 public:
  static constexpr std::string_view kKind = "l1-solver";

  /// Minimises the problem. @throws ArgumentError when shapes do not fit.
  L1Solution solve(const L1Problem& problem, const RunContext& context = {}) const;

 private:
  virtual L1Solution do_solve(const L1Problem& problem, const RunContext& context) const = 0;
};

}  // namespace lacuna
