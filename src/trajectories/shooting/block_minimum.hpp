// SPDX-License-Identifier: MIT
// Nonlinear least squares over unknowns that blocks of rows have for themselves (the initial
// states of a window or a record) and over unknowns that all blocks have in common.
#pragma once

#include <string>
#include <vector>

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/core/base/types.hpp"

namespace lacuna {

struct BlockPoint {
  Matrix own;     ///< blocks x k
  Vector common;  ///< c
};

/// The problem linearised at a point: R of the rows [own, common | residual] of each block,
/// with k + c + 1 columns, and of the rows [common | residual] of none (or no rows).
struct BlockTriangles {
  const std::vector<Matrix>& blocks;
  const Matrix& rest;
};

/// A sum of squares, looked at point by point.
class BlockProblem {
 public:
  virtual ~BlockProblem() = default;

  /// The sum at a point, which is tried by that; infinite where there is none.
  virtual double cost(const BlockPoint& point) = 0;

  /// The point that was tried last is the present one from now on.
  virtual void keep() = 0;

  /// At the present point; stays until the next call.
  virtual BlockTriangles linearise() = 0;
};

/// How a minimisation ends, and what it keeps to.
struct BlockTask {
  double freedom = 1.0;  ///< degrees of freedom
  double tolerance =
      0.0;  ///< decrease that is not worth a step, of the cost per degree of freedom
  int most_iterations = 0;
  Vector lower, upper;  ///< k + c: ranges of own, then of common unknowns
  /// Whether common unknowns with a positive range move by factors: steps of their logarithms.
  bool by_factors = false;
};

/// Where it ended; the problem's present point is this one.
struct BlockMinimum {
  BlockPoint point;
  double cost = 0.0;
  bool converged = false;
  int iterations = 0;
};

/// Columns that are held where they are: of [own] in each block, and of [common].
struct HeldColumns {
  std::vector<std::vector<Index>> own;
  std::vector<Index> common;
};

/// A step and the decrease of the sum that the linear problem promises.
struct BlockStep {
  Matrix own;
  Vector common;
  double decrease = 0.0;
};

/// The step of Levenberg and Marquardt: minimises the linear problem plus damping^2 |D step|^2,
/// D the norms of the columns (of the common ones: with the own ones eliminated).
/// @param own k. @param held empty: no column is.
BlockStep solve_blocks(const BlockTriangles& linear, Index own, double damping,
                       const HeldColumns& held = {});

/// Minimises by the method of Levenberg and Marquardt, unknowns kept in their ranges by an
/// active set. A step is taken only where it lowers the sum.
BlockMinimum minimise_blocks(BlockProblem& problem, BlockPoint start, const BlockTask& task,
                             const RunContext& context);

/// The same by Ceres (trust region of Levenberg and Marquardt, own unknowns eliminated by its
/// sparse Schur complement where it was built with one), to hold the other against.
/// Where an unknown is at the end of its range, it ends near the minimum only.
/// @throws ConfigError where ceres_is_absent().
BlockMinimum minimise_blocks_by_ceres(BlockProblem& problem, BlockPoint start,
                                      const BlockTask& task, const RunContext& context);

/// "" or "built without Ceres".
std::string ceres_is_absent();

/// Solution of an upper triangular system in which directions with a pivot below rounding get
/// 0.
Vector solve_determined(const Eigen::Ref<const Matrix>& triangle,
                        const Eigen::Ref<const Vector>& target);

}  // namespace lacuna
