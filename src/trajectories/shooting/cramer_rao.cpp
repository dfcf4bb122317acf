// SPDX-License-Identifier: MIT
#include "trajectories/shooting/cramer_rao.hpp"

#include "lacuna/core/base/error.hpp"
#include "shooting_fit.hpp"
#include "state_guess.hpp"

namespace lacuna {

Vector cramer_rao_bound(const ParametrisedModel& model, const Dataset& truth,
                        const Vector& sigma, const WindowPlan& windows) {
  check_dataset(truth);
  for (const Window& window : windows)
    if (window.first < 0 || window.samples < 1 || window.intervals < 0 ||
        window.first > truth.samples() - window.samples ||
        window.intervals > truth.samples() - window.first)
      throw ArgumentError("cramer_rao_bound", "a window is not inside the record", "");
  ShootingProblem problem(model, truth, {});
  const auto measured = static_cast<Index>(problem.record().measured.size());
  if (sigma.size() != measured || !(sigma.minCoeff() > 0.0))
    throw ArgumentError("cramer_rao_bound", "there is not one positive sigma per state",
                        "give the noise of each state of the record");
  problem.set_sigma(sigma);
  const Matrix states = guess_states(model, problem.record(), problem.rates(),
                                     problem.signals(), Vector::Zero(measured));
  ShootingPoint point{model.values(), starts_of(windows, states)};
  problem.set_scheme(accurate_scheme(problem, windows, point, sigma));
  problem.evaluate(windows, point);
  const Matrix reduced = problem.linearise(windows, point).reduced;
  return covariance_of(reduced.topLeftCorner(model.size(), model.size()))
      .diagonal()
      .cwiseSqrt();
}

}  // namespace lacuna
