// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "lacuna/data/records/dataset.hpp"
#include "lacuna/model/expressions/program.hpp"

namespace lacuna {

/// A trajectory with the path about which equations are linearised. Nodes are the ends and the
/// middles of `substeps` equal parts of each sampling interval.
struct PathRecord {
  Trajectory samples;
  Matrix weights;  ///< n x m: 1 / sigma, 0 where a value is not to be believed
  Index substeps = 1;
  std::vector<Index> held;  ///< inputs that hold their samples, by number
  Vector time;              ///< of the nodes, (n - 1) 2 substeps + 1
  Matrix slots;             ///< nodes x slots; the first m columns are the path

  Index stride() const noexcept { return 2 * substeps; }  ///< nodes per sampling interval
};

/// Records with the smoothed samples as path.
/// @param noise per record n x m: sigma of each sample; 0: not smoothed.
std::vector<PathRecord> make_paths(const Dataset& data, const std::vector<Matrix>& noise,
                                   const Program& program, int threads = 1);

/// Changes the number of parts of an interval; the path goes through its points at samples.
void set_substeps(PathRecord& record, Index substeps, const Program& program);

/// Signals as polynomials in moving windows see them, the window of each state being the one
/// with the least estimated risk, sum_i (r_i / sigma_i)^2 + 2 trace (Mallows' C_p). States that
/// were not measured follow from those whose rates they are.
/// @param noise n x m: sigma of each sample.
Matrix smoothed_states(const Trajectory& record, const Dataset& data, const Matrix& noise,
                       int threads = 1);

}  // namespace lacuna
