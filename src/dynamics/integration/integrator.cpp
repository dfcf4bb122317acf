// SPDX-License-Identifier: MIT
#include "lacuna/dynamics/integration/integrator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/text.hpp"
#include "dynamics/integration/watched_rates.hpp"

namespace lacuna {
namespace {

// No state is so large in any unit that is in use; what is larger has run away.
constexpr double kDivergence = 1e12;

void check_start(const Vector& x0, const Vector& times) {
  if (x0.size() == 0 || !x0.allFinite())
    throw ArgumentError("integrate", "the initial state is empty or not finite",
                        "give one finite number per state");
  if (times.size() == 0 || !times.allFinite())
    throw ArgumentError("integrate", "the times are empty or not finite",
                        "give at least the time of the initial state");
  for (Index i = 1; i < times.size(); ++i) {
    if (times[i] > times[i - 1]) continue;
    throw ArgumentError("integrate, time " + std::to_string(i),
                        "t = " + format_number(times[i]) + " does not come after " +
                            format_number(times[i - 1]),
                        "give times that increase");
  }
}

/// A largest coefficient need not show one that is no number.
bool beyond(const Vector& x, double bound) {
  return !(x.array().abs() <= std::min(bound, std::numeric_limits<double>::max())).all();
}

std::string state_name(std::span<const std::string> names, Index k) {
  const auto i = static_cast<std::size_t>(k);
  return i < names.size() ? names[i] : std::string("x").append(std::to_string(k + 1));
}

// Keeps the samples that were reached.
void cut(Solution& solution, Index samples) {
  solution.time.conservativeResize(samples);
  solution.states.conservativeResize(samples, Eigen::NoChange);
}

}  // namespace

std::string to_string(IntegrationStatus status) {
  switch (status) {
    case IntegrationStatus::Completed:
      return "completed";
    case IntegrationStatus::Diverged:
      return "diverged";
    case IntegrationStatus::StepTooSmall:
      break;
  }
  return "step too small";
}

double divergence_bound(const double* x, Index dimension) {
  return kDivergence *
         std::max(1.0, Eigen::Map<const Vector>(x, dimension).cwiseAbs().maxCoeff());
}

std::string end_message(IntegrationStatus status, double time, const Vector& state,
                        std::span<const std::string> names, const std::string& time_unit) {
  if (status == IntegrationStatus::Completed) return "";
  std::vector<std::string> values;
  for (Index k = 0; k < state.size(); ++k)
    values.push_back(state_name(names, k) + " = " + format_number(state[k], 6));
  const std::string unit = time_unit.empty() ? "" : " " + time_unit;
  return to_string(status) + " at t = " + format_number(time, 6) + unit + " with " +
         join(values, ", ");
}

Solution Integrator::integrate(RightHandSide rhs, const Vector& x0, const Vector& times,
                               const RunContext& context) const {
  check_start(x0, times);
  Solution solution;
  solution.time = times;
  solution.states.resize(times.size(), x0.size());
  solution.states.row(0) = x0.transpose();
  const double bound = divergence_bound(x0.data(), x0.size());
  const std::unique_ptr<Stepper> stepper = make_stepper(x0.size());
  WatchedRates watched(rhs, context);
  Vector x = x0, last = x0;
  double t = times[0], last_time = t;
  const Index stride = times.size() / 100 + 1;
  for (Index i = 1; i < times.size(); ++i) {
    if (i % stride == 0)
      context.report("integrating", static_cast<double>(i) / static_cast<double>(times.size()));
    context.check_stop();
    solution.status = stepper->advance(watched, t, times[i], x.data());
    if (beyond(x, bound)) {
      solution.status = IntegrationStatus::Diverged;
      x = last;
      t = last_time;
    }
    if (solution.status != IntegrationStatus::Completed) {
      cut(solution, i);
      break;
    }
    solution.states.row(i) = x.transpose();
    last = x;
    last_time = t;
  }
  solution.end_time = t;
  solution.end_state = x;
  solution.message = end_message(solution.status, t, x);
  return solution;
}

}  // namespace lacuna
