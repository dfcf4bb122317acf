// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/data/records/dataset.hpp"
#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna::benchmarks {

/// A flow with the grid on which it is sampled; inputs are cos(1.2 t).
struct Flow {
  std::string name;
  OdeModel model;
  Vector start;
  double step = 0.0;
  Index samples = 0;
};

/// Twelve flows with polynomial right-hand sides up to degree 3.
std::vector<Flow> flows();

/// Flows whose right-hand sides are no polynomials: pendulums of three amplitudes, a spring
/// that softens, prey and a predator that gets its fill.
std::vector<Flow> flows_beyond_polynomials();

/// How a record came about.
struct Making {
  enum class Solver {
    Quartic,  ///< adaptive Dormand-Prince 5(4), sampled by its interpolant
    Cubic,    ///< the same, sampled by Hermite's cubic
    Fixed,    ///< classical Runge-Kutta with fixed steps
    Exact,    ///< order 8 with a tolerance of 1e-12
  };
  std::string name;
  Solver solver = Solver::Exact;
  double tolerance = 0.0;  ///< relative, of the adaptive ones
  int substeps = 1;        ///< of the fixed ones, per sample
  int digits = 17;         ///< significant, as printed
  bool counts = true;      ///< false: shown beside the others
};

/// All ways, coarse tolerances first.
std::vector<Making> makings();

/// The record of a flow, its numbers as read back from print.
Dataset solver_record(const Flow& flow, const Making& making);

}  // namespace lacuna::benchmarks
