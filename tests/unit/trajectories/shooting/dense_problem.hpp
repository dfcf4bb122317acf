// SPDX-License-Identifier: MIT
// The problem of the trajectory fit with everything explicit: initial states of all windows are
// unknowns like the parameters, derivatives are differences of simulations.
#pragma once

#include <Eigen/QR>

#include "trajectories/shooting/shooting_problem.hpp"
#include "unit/trajectories/shooting/records.hpp"

namespace lacuna::testing {

/// Rows r(u0 + u) = r - J u, u = (starts window by window, parameters): samples of the first
/// measured state, of the second, ..., then the priors. Whitened.
struct DenseProblem {
  Matrix jacobian;
  Vector residual;
  Index starts = 0;  ///< columns in front of the parameters

  Index parameters() const { return jacobian.cols() - starts; }

  /// Part of some rows that no initial states explain.
  Matrix without_starts(const Matrix& rows) const {
    const Matrix j = jacobian.leftCols(starts);
    return rows - j * j.householderQr().solve(rows);
  }
};

inline Vector dense_residual(ShootingProblem& problem, const WindowPlan& plan,
                             const ShootingPoint& point) {
  const Matrix r = problem.residuals(plan, point);
  std::vector<double> rows(r.data(), r.data() + r.size());
  const auto priors = problem.model().priors();
  for (std::size_t i = 0; i < priors.size(); ++i)
    if (priors[i])
      rows.push_back((priors[i]->value - point.parameters[static_cast<Index>(i)]) /
                     priors[i]->tolerance);
  return Eigen::Map<const Vector>(rows.data(), static_cast<Index>(rows.size()));
}

/// The point with its unknowns moved by u; simulated.
inline ShootingPoint moved(ShootingProblem& problem, const WindowPlan& plan,
                           const ShootingPoint& point, const Vector& u) {
  const Index starts = point.starts.size();
  ShootingPoint next{
      point.parameters + u.tail(u.size() - starts),
      point.starts +
          u.head(starts).reshaped(point.starts.cols(), point.starts.rows()).transpose()};
  problem.evaluate(plan, next);
  return next;
}

inline DenseProblem dense_problem(ShootingProblem& problem, const WindowPlan& plan,
                                  const ShootingPoint& point) {
  constexpr double kReach = 1e-5;
  DenseProblem dense;
  dense.starts = point.starts.size();
  dense.residual = dense_residual(problem, plan, point);
  const Index unknowns = dense.starts + point.parameters.size();
  dense.jacobian.resize(dense.residual.size(), unknowns);
  for (Index j = 0; j < unknowns; ++j) {
    const Vector u = kReach * Vector::Unit(unknowns, j);
    dense.jacobian.col(j) = (dense_residual(problem, plan, moved(problem, plan, point, -u)) -
                             dense_residual(problem, plan, moved(problem, plan, point, u))) /
                            (2.0 * kReach);
  }
  return dense;
}

/// Two noisy records of a Van der Pol oscillator, 25 and 16 samples.
inline Dataset two_records() {
  const TestSystem& system = test_system("van-der-pol");
  Dataset data = noisy_record("van-der-pol", 25, 0.05, 3);
  const Dataset other = record_of(system.model, Dopri8{Dopri8Options{.substeps = 4}},
                                  Vector{{-0.5, 1.5}}, system.step, 16);
  data.trajectories.push_back(add_relative_noise(other, 0.05, 4).trajectories.front());
  data.trajectories.back().source = "other.csv";
  return data;
}

/// Its model with all coefficients of the second equation free, one with a prior.
inline ParametrisedModel van_der_pol() {
  const OdeModel& model = test_system("van-der-pol").model;
  std::vector<FreeCoefficient> free;
  for (std::size_t i = 0; i < model.equations()[1].size(); ++i)
    free.push_back({1, static_cast<Index>(i)});
  free[0].prior = Prior{model.equations()[1][0].coefficient + 0.2, 0.1};
  return {model, free};
}

/// The problem at a point that is no minimum, in four windows.
struct ShootingCase {
  explicit ShootingCase(std::optional<double> huber = {}, Dataset data = two_records())
      : problem(van_der_pol(), data, huber), plan(equal_windows(problem.record().begins, 10)) {
    problem.set_sigma(Vector::LinSpaced(problem.sigma().size(), 0.1, 0.2));
    point.parameters = 1.02 * problem.model().values();
    point.starts = Matrix::Zero(static_cast<Index>(plan.size()), 2);
    for (std::size_t w = 0; w < plan.size(); ++w)
      for (std::size_t q = 0; q < problem.record().measured.size(); ++q)
        point.starts(static_cast<Index>(w), problem.record().measured[q]) =
            problem.record().values(plan[w].first, static_cast<Index>(q));
    problem.evaluate(plan, point);
  }

  ShootingProblem problem;
  WindowPlan plan;
  ShootingPoint point;
};

}  // namespace lacuna::testing
