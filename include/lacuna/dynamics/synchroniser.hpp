// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lacuna/data/dataset.hpp"
#include "lacuna/dynamics/integrator.hpp"
#include "lacuna/model/ode_model.hpp"

namespace lacuna {

/// How the slave is driven: dx_s/dt = f(t, x_s) - K (x_s - x_m(t)), Karimov et al. 2023, Sect. 2.2.
struct SyncOptions {
  /// K, m x m, in 1 / time unit. Without it all states are coupled with default_coupling().
  std::optional<Matrix> coupling = {};

  /// State the slave starts from; without it the record's first sample.
  std::optional<Vector> start = {};
};

/// How far a model stays from a record that drives it.
struct SyncResult {
  Matrix coupling;          ///< K that was used
  std::vector<Vector> errors;  ///< per trajectory: |x_s,n - x_m,n| at the samples
  double median = 0.0;      ///< of the errors, all samples
  double mean = 0.0;
  double relative = 0.0;    ///< mean / max_n |x_m,n|
  bool settled = false;     ///< the error of the second half is not above that of the first
                            ///< quarter after the transient, and nothing diverged
  IntegrationStatus status = IntegrationStatus::Completed;
  std::string message;      ///< on divergence: where and with what state; else empty
};

/// A coupling strength from the record's own time scale: k = sqrt(sum var(dx/dt) / sum var(x)),
/// each state in units of its standard deviation, times the identity.
Matrix default_coupling(const Dataset& record);

/// Synchronises the model with every trajectory of the record. The slave makes one step per
/// sample; between the samples the record (and the inputs) are the Lagrange polynomial through p
/// points for a method of order p, e.g. t_{n-2} .. t_{n+1} for RK4.
/// @throws DataError when states or inputs of the model are not in the record or when a trajectory
///   has fewer samples than the polynomial needs; ArgumentError for a K of the wrong shape.
SyncResult synchronise(const OdeModel& model, const Dataset& record, const Integrator& integrator,
                       const SyncOptions& options = {}, const RunContext& context = {});

}  // namespace lacuna
