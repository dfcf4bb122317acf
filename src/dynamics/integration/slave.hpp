// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "core/numerics/lagrange.hpp"
#include "lacuna/core/base/run_context.hpp"
#include "lacuna/data/records/dataset.hpp"
#include "lacuna/dynamics/integration/integrator.hpp"
#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {

/// What slaves of one model have in common.
struct SlaveTask {
  const OdeModel& model;
  const Matrix& coupling;
  const Integrator& integrator;
  LagrangeWindow window;  ///< by which the record drives
  const std::optional<Vector>& start;
  const Vector& seen;  ///< m: 1 for the states that the record shows, else 0
  const RunContext& context;
  int parts = 1;  ///< of a sampling interval, equal; in each the integrator advances once
};

/// One slave along one trajectory.
struct SlaveRun {
  Vector errors;  ///< |x_s,n - x_m,n| over the seen states, at the samples reached
  Matrix states;  ///< x_s,n at the samples reached
  IntegrationStatus status = IntegrationStatus::Completed;
  double end_time = 0.0;
  Vector end_state;
};

/// Where slaves begin: as given; else at the first sample, and in unmeasured states where the
/// model says.
Vector start_of(const SlaveTask& task, const Trajectory& trajectory);

/// Integrates dx_s/dt = f(t, x_s) - K (x_s - x_m(t)) along a trajectory.
SlaveRun run_slave(const SlaveTask& task, const Trajectory& trajectory, const Vector& start);

}  // namespace lacuna
