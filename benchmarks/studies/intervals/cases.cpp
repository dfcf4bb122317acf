// SPDX-License-Identifier: MIT
#include "cases.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/random.hpp"
#include "core/base/text.hpp"
#include "lacuna/dynamics/integration/integrators.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "model/equations/output_values.hpp"

namespace lacuna::benchmarks {
namespace {

std::vector<double> steps(double step, int count) {
  std::vector<double> times;
  for (int i = 0; i < count; ++i) times.push_back(step * i);
  return times;
}

IntervalCase logistic() {
  return {"logistic",
          "param r = 1 in 0..\nparam K = 10 in 0..\ndx/dt = r*x*(1-x/K)\ny = x + 0 noise LAW\n",
          {0.5},
          steps(0.25, 41)};
}

IntervalCase lotka_volterra() {
  return {"lotka-volterra",
          "param a = 1.1 in 0..\nparam b = 0.4 in 0..\nparam c = 0.1 in 0..\nparam d = 0.4 in "
          "0..\ndx/dt = a*x - b*x*z\ndz/dt = c*x*z - d*z\n"
          "y1 = x + 0 noise LAW\ny2 = z + 0 noise LAW\n",
          {10.0, 5.0},
          steps(0.4, 51)};
}

/// Ramsay, Hooker, Campbell and Cao, J. R. Stat. Soc. B 69:741-796 (2007). Outputs are raised so
/// that their logarithms exist.
IntervalCase fitzhugh_nagumo() {
  return {"fitzhugh-nagumo",
          "param a = 0.2\nparam b = 0.2\nparam c = 3 in 0..\n"
          "dV/dt = c*(V - V^3/3 + R)\ndR/dt = -(V - a + b*R)/c\n"
          "y1 = V + 3 noise LAW\ny2 = R + 3 noise LAW\n",
          {-1.0, 1.0},
          steps(0.25, 81)};
}

/// Hindmarsh and Rose, Proc. R. Soc. Lond. B 221:87-102 (1984), in bursts.
IntervalCase hindmarsh_rose() {
  return {"hindmarsh-rose",
          "param a = 1 in 0..\nparam b = 3 in 0..\nparam c = 1 in 0..\nparam d = 5 in 0..\n"
          "param I = 2 fixed\nparam r = 0.02 fixed\nparam s = 4 fixed\nparam e = 1.6 fixed\n"
          "dx/dt = q - a*x^3 + b*x^2 - z + I\ndq/dt = c - d*x^2 - q\n"
          "dz/dt = r*s*x + r*s*e - r*z\n"
          "y1 = x + 3 noise LAW\ny2 = q + 20 noise LAW\ny3 = z + 1 noise LAW\n",
          {-1.0, -3.0, 1.5},
          steps(0.25, 121)};
}

/// Vyshemirsky and Girolami, Bioinformatics 24:833-839 (2008). Initial values are known, samples
/// begin behind them; outputs are raised as above.
IntervalCase protein_transduction() {
  return {"protein-transduction",
          "param k1 = 0.07 in 0..\nparam k2 = 0.6 in 0..\nparam k3 = 0.05 in 0..\n"
          "param k4 = 0.3 in 0..\nparam V = 0.017 in 0..\nparam Km = 0.3 in 0..\n"
          "dS/dt = -k1*S - k2*S*R + k3*RS\ndD/dt = k1*S\n"
          "dR/dt = -k2*S*R + k3*RS + V*P/(Km + P)\ndRS/dt = k2*S*R - k3*RS - k4*RS\n"
          "dP/dt = k4*RS - V*P/(Km + P)\n"
          "y1 = S + 0.1 noise LAW\ny2 = D + 0.1 noise LAW\ny3 = R + 0.1 noise LAW\n"
          "y4 = RS + 0.1 noise LAW\ny5 = P + 0.1 noise LAW\n"
          "initial S = 1 at 0 fixed\ninitial D = 0 at 0 fixed\ninitial R = 1 at 0 fixed\n"
          "initial RS = 0 at 0 fixed\ninitial P = 0 at 0 fixed\n",
          {1.0, 0.0, 1.0, 0.0, 0.0},
          {0.0, 1.0, 2.0, 4.0, 5.0, 7.0, 10.0, 15.0, 20.0, 30.0, 40.0, 50.0, 60.0, 80.0, 100.0}};
}

/// The outputs without noise, from fine steps.
Matrix outputs_of(const SystemModel& system, const IntervalCase& one, const Vector& time) {
  constexpr Index kSteps = 200;  // in a sampling interval
  const Index n = time.size();
  Vector fine((n - 1) * kSteps + 1);
  for (Index i = 0; i + 1 < n; ++i)
    for (Index k = 0; k < kSteps; ++k)
      fine[i * kSteps + k] = time[i] + (time[i + 1] - time[i]) * static_cast<double>(k) /
                                           static_cast<double>(kSteps);
  fine[fine.size() - 1] = time[n - 1];
  const Vector start =
      Eigen::Map<const Vector>(one.start.data(), static_cast<Index>(one.start.size()));
  const Solution orbit = simulate(system.model(), rk4(), start, fine);
  Matrix states(n, start.size());
  for (Index i = 0; i < n; ++i) states.row(i) = orbit.states.row(i * kSteps);
  return output_values(system.model(), time, states, Matrix(n, 0));
}

/// The value below which a fifth of the values are.
double fifth(Vector values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 5];
}

/// Makes a column of measured values and gives the law that the model has for it.
std::string measure(MeasuredBy noise, Random& random, Eigen::Ref<Vector> values) {
  const double limit = fifth(values);
  const double deviation = 0.1 * std::sqrt((values.array() - values.mean()).square().mean());
  for (double& value : values) {
    if (noise == MeasuredBy::LogNormal) {
      value *= std::exp(0.1 * random.normal());
      continue;
    }
    value += deviation * random.normal();
    if (noise == MeasuredBy::Censored) value = std::max(value, limit);
    if (noise == MeasuredBy::Truncated && value < limit)
      value = std::numeric_limits<double>::quiet_NaN();
  }
  const std::string number = format_number(limit, 17);
  switch (noise) {
    case MeasuredBy::LogNormal:
      return "lognormal";
    case MeasuredBy::Censored:
      return "constant below " + number;
    case MeasuredBy::Truncated:
      return "constant truncated below " + number;
    default:
      return "constant";
  }
}

}  // namespace

std::vector<IntervalCase> interval_cases() {
  return {logistic(), lotka_volterra(), fitzhugh_nagumo(), hindmarsh_rose(),
          protein_transduction()};
}

IntervalDraw interval_draw(const IntervalCase& one, MeasuredBy noise, std::uint64_t number) {
  std::string truth = one.text;
  for (std::size_t at = truth.find(" noise LAW"); at != std::string::npos;
       at = truth.find(" noise LAW"))
    truth.erase(at, std::string(" noise LAW").size());
  const SystemModel system = parse_ode_system(truth, one.name);
  const Vector time =
      Eigen::Map<const Vector>(one.times.data(), static_cast<Index>(one.times.size()));
  Trajectory run{one.name, time, outputs_of(system, one, time), Matrix(time.size(), 0), Matrix()};
  IntervalDraw draw{{}, one.text, {}};
  Random random(number);
  const bool is_given = system.symbolic().initial_time().has_value();
  for (Index c = 0; c < run.states.cols(); ++c) {
    const Output& output = system.symbolic().outputs()[static_cast<std::size_t>(c)];
    draw.columns.states.push_back({output.name, ""});
    const Index first = is_given ? 1 : 0, rows = time.size() - first;
    const std::string law = measure(noise, random, run.states.col(c).tail(rows));
    if (is_given) run.states(0, c) = std::numeric_limits<double>::quiet_NaN();
    draw.model.replace(draw.model.find("LAW"), 3, law);
  }
  for (const Parameter& parameter : system.parameters()) {
    if (!parameter.free) continue;
    draw.truth.push_back(parameter.value);
    const std::string name = "param " + parameter.name + " = ";
    const std::size_t at = draw.model.find(name) + name.size();
    const double start = parameter.value * (1.0 + 0.2 * random.uniform(-1.0, 1.0));
    draw.model.replace(at, draw.model.find_first_of(" \n", at) - at, format_number(start, 17));
  }
  draw.columns.trajectories = {std::move(run)};
  return draw;
}

}  // namespace lacuna::benchmarks
