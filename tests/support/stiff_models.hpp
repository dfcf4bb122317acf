// SPDX-License-Identifier: MIT
// Models with time scales far apart, and records of them.
#pragma once

#include <cmath>
#include <string>

#include "core/base/random.hpp"
#include "core/base/text.hpp"
#include "dynamics/integration/cvode.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/model/files/model_file.hpp"

namespace lacuna::support {

/// A model as text and what was measured of it.
struct StiffRecord {
  std::string text;
  Dataset data;
};

inline const char* robertson_text() {
  return "param k1 = 0.04 in 0..1\nparam k2 = 1e4 in 0..1e6\nparam k3 = 3e7 in 0..1e9\n"
         "dx/dt = -k1*x + k2*y*z\ndy/dt = k1*x - k2*y*z - k3*y^2\ndz/dt = k3*y^2\n";
}

/// Robertson's reactions (1966), the standard stiff problem: rates 0.04, 1e4 and 3e7.
inline OdeModel robertson() { return parse_ode(robertson_text(), "robertson"); }

/// Adds noise of a fraction of the spread of each state.
inline void add_noise(double noise, std::uint64_t seed, Dataset& data) {
  Random random(seed);
  Matrix& states = data.trajectories.front().states;
  for (Index k = 0; k < states.cols() && noise > 0.0; ++k) {
    const Vector centred = states.col(k).array() - states.col(k).mean();
    const double sigma =
        noise * centred.norm() / std::sqrt(static_cast<double>(centred.size()));
    for (double& value : states.col(k)) value += sigma * random.normal();
  }
}

/// What CVODE makes of a model at the given times, with noise of a fraction of each spread.
inline Dataset stiff_data(const OdeModel& model, const Vector& start, const Vector& times,
                          const Matrix& inputs, double noise, std::uint64_t seed = 1) {
  Dataset data{"s", {}, {}, {}, {}};
  data.states = model.states();
  data.inputs = model.inputs();
  Trajectory record{"stiff", times, Matrix::Zero(times.size(), model.dimension()), inputs,
                    Matrix()};
  if (inputs.cols() > 0) {
    RecordInput driving(record, model.inputs());
    record.states =
        simulate(DrivenModel{model, driving, driving.breaks()}, Cvode(), start, times).states;
  } else {
    record.states = simulate(model, Cvode(), start, times).states;
  }
  data.trajectories = {record};
  add_noise(noise, seed, data);
  return data;
}

/// Robertson's reactions from 1e-5 to 1e5 seconds, ten samples in a decade and more.
inline StiffRecord robertson_record(double noise, const std::string& text = robertson_text()) {
  Vector times(241);
  times[0] = 0.0;
  for (Index i = 1; i < times.size(); ++i)
    times[i] = std::pow(10.0, -5.0 + 10.0 * static_cast<double>(i - 1) / 239.0);
  return {text, stiff_data(parse_ode(text, "robertson"), Vector{{1.0, 0.0, 0.0}}, times,
                           Matrix(times.size(), 0), noise)};
}

inline const char* van_der_pol_text() {
  return "param mu = 1000 in 1..1e6\ndx/dt = v\ndv/dt = mu*v - mu*x^2*v - x\n";
}

/// Two periods of van der Pol's oscillation with mu = 1000, which jumps in milliseconds.
inline StiffRecord van_der_pol_record(double noise) {
  const Vector times = sample_times(0.0, 8.0, 400);
  return {van_der_pol_text(), stiff_data(parse_ode(van_der_pol_text(), "v"), Vector{{2.0, 0.0}},
                                         times, Matrix(times.size(), 0), noise)};
}

inline const char* gate_text() {
  return "input u hold zero\nparam a = 2e8 in 0..1e12\nparam b = 1000 in 0..1e6\n"
         "dv/dt = a*(1 - u - v)\ndw/dt = b*(v - w)\n";
}

/// The states of the gate from one sample to the next, u held: v = 1 - u + (v0 - 1 + u)
/// exp(-a t), and w from it by the variation of constants.
inline Vector gate_after(const Vector& state, double input, double time) {
  const double a = 2e8, b = 1000.0, rest = 1.0 - input, off = state[0] - rest;
  const double charge = b * off / (b - a);
  return Vector{{rest + off * std::exp(-a * time),
                 rest + charge * std::exp(-a * time) +
                     (state[1] - rest - charge) * std::exp(-b * time)}};
}

/// A gate that follows its input in 5 ns and charges a capacitor in 1 ms, every 10 us; in
/// closed form.
inline StiffRecord gate(double noise = 0.0, const std::string& text = gate_text(),
                        std::uint64_t seed = 1) {
  const Vector times = sample_times(0.0, 1e-5, 400);
  Matrix input(times.size(), 1), states(times.size(), 2);
  Vector state{{1.0, 0.0}};
  for (Index i = 0; i < times.size(); ++i) {
    input(i, 0) = i / 40 % 2 == 0 ? 0.0 : 1.0;
    states.row(i) = state.transpose();
    state = gate_after(state, input(i, 0), 1e-5);
  }
  const OdeModel model = parse_ode(text, "gate");
  Dataset data{"s", model.states(), model.inputs(), {}, {}};
  data.trajectories = {{"stiff", times, states, input, Matrix()}};
  add_noise(noise, seed, data);
  return {text, data};
}

/// A chain of thirty reactions x0 -> x1 -> ... with rates from 1e-3 to 1e6 in mixed order.
constexpr Index kChain = 30;

/// The place of a rate among all, from the slowest on.
inline Index chain_place(Index i) { return 7 * i % kChain; }

inline double chain_rate(Index i) {
  return std::pow(10.0, -3.0 + 9.0 * static_cast<double>(chain_place(i)) / 29.0);
}

/// Whether a member of the chain is measured: those with the four slowest rates, and the last.
inline bool is_measured_in_chain(Index i) { return chain_place(i) < 4 || i == kChain - 1; }

/// The four slowest rates are free.
inline std::string chain_text() {
  std::string free, fixed, equations, outputs;
  for (Index i = 0; i < kChain; ++i) {
    const std::string n = std::to_string(i), before = std::to_string(i - 1);
    (chain_place(i) < 4 ? free : fixed) += "param k" + n + " = " + format_number(chain_rate(i)) +
                                           (chain_place(i) < 4 ? "\n" : " fixed\n");
    equations += "dx" + n + "/dt = " + (i > 0 ? "k" + before + "*x" + before : "") + " - k" + n +
                 "*x" + n + "\ninitial x" + n + (i > 0 ? " = 0 fixed\n" : " = 1 fixed\n");
    if (is_measured_in_chain(i)) outputs += "y" + n + " = x" + n + "\n";
  }
  return free + fixed + equations + outputs;
}

}  // namespace lacuna::support
