// SPDX-License-Identifier: MIT
#include "trajectories/windows/event_maps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <functional>

#include "core/base/random.hpp"
#include "dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/trajectories/fit/fit.hpp"
#include "trajectories/fit/fit_engine.hpp"

namespace lacuna {
namespace {

using Complex = std::complex<double>;
/// The first state at a time, by start and parameters.
using Solved = std::function<Complex(double, const std::vector<Complex>&)>;

/// A record of all states of a model.
Dataset record_of(const OdeModel& model, const Vector& start, const Vector& times,
                  double noise) {
  Dataset data{"s", model.states(), {}, {}, {}};
  Trajectory record{"r", times, simulate(model, Dopri87{}, start, times).states,
                    Matrix(times.size(), 0), Matrix()};
  Random random(11);
  for (double& value : record.states.reshaped()) value += noise * random.normal();
  data.trajectories = {record};
  return data;
}

/// Compares the first state and its derivatives with a solution and its complex step.
void expect_solution(const std::string& text, const std::vector<double>& numbers,
                     const Vector& times, const Solved& solved) {
  constexpr double kStep = 1e-30;
  const SystemModel system = parse_ode_system(text, "m.ode");
  const ParametrisedModel model = system.parametrised();
  const Index m = model.symbolic().dimension();
  const Vector start = Eigen::Map<const Vector>(numbers.data(), m);
  const Dataset data = record_of(system.model(), start, times, 0.0);
  FitEngine engine = fit_engine(
      model, fit_records(model, with_event_rows(data, system.symbolic())));
  set_substeps(engine, 16);
  const FitPoint point{model.values().transpose(), start.transpose()};
  const FitPath path = follow(engine, point, {});
  const Vector& rows_at = engine.records.series.time;
  sensitivities(engine, point, path, {}, 0, [&](Index n, const Matrix& rows, const Vector&) {
    if (engine.records.valid(n, 0) == 0.0) return;
    std::vector<Complex> all(numbers.begin(), numbers.end());
    EXPECT_NEAR(path.states(n, 0), solved(rows_at[n], all).real(), 1e-6) << rows_at[n];
    for (std::size_t j = 0; j < all.size(); ++j) {
      all[j] += Complex(0.0, kStep);
      const double expected = solved(rows_at[n], all).imag() / kStep;
      all[j] = numbers[j];
      EXPECT_NEAR(rows(0, static_cast<Index>(j)) * engine.sigma[0], expected,
                  1e-5 * (1.0 + std::abs(expected)))
          << "number " << j << " at " << rows_at[n];
    }
  });
}

TEST(EventMaps, TimedJumpsCarryDerivatives) {
  const Solved solved = [](double t, const std::vector<Complex>& p) {
    const auto [x0, k, d] = std::tuple(p[0], p[1], p[2]);
    if (t < 0.35) return x0 * std::exp(-k * t);
    const Complex dosed = x0 * std::exp(-k * 0.35) + d;
    if (t < 1.25) return dosed * std::exp(-k * (t - 0.35));
    const Complex before = dosed * std::exp(-k * 0.9);
    return k * before * before * std::exp(-k * (t - 1.25));
  };
  expect_solution(
      "param k = 0.7\nparam d = 2\ndx/dt = -k*x\nat 0.35: x += d\nat 1.25: x = k*x^2\n",
      {1.5, 0.7, 2.0}, sample_times(0.0, 0.1, 25), solved);
}

TEST(EventMaps, GuardsMoveWithParameters) {
  // A sawtooth: x rises by a and falls by c, whenever it comes to c.
  const Solved solved = [](double t, const std::vector<Complex>& p) {
    const double k = std::floor((p[0] + p[1] * t).real() / p[2].real());
    return p[0] + p[1] * t - k * p[2];
  };
  expect_solution("param a = 2\nparam c = 3\ndx/dt = a\nwhen x > c: x -= c\n",
                  {0.5, 2.0, 3.0}, sample_times(0.0, 0.37, 30), solved);
}

TEST(EventMaps, GuardsOfTimeMoveToo) {
  // A lag: dx/dt = -x after x is set at the instant t = c to 2 t + x.
  const Solved solved = [](double t, const std::vector<Complex>& p) {
    if (t < p[1].real()) return p[0] * std::exp(-t);
    return (2.0 * p[1] + p[0] * std::exp(-p[1])) * std::exp(-(t - p[1]));
  };
  expect_solution("param c = 1.234\ndx/dt = -x\nwhen t > c: x += 2*t\n", {1.0, 1.234},
                  sample_times(0.0, 0.2, 20), solved);
}

TEST(EventMaps, BouncesHaveTheDerivativesOfTheAnalyticTimes) {
  const Solved solved = [](double t, const std::vector<Complex>& p) {
    const auto [h0, v0, g, e] = std::tuple(p[0], p[1], p[2], p[3]);
    Complex speed = std::sqrt(v0 * v0 + 2.0 * g * h0), begin = (v0 - speed) / g;
    for (;;) {
      const Complex flight = 2.0 * speed / g;
      if (t < (begin + flight).real())
        return (t - begin) * (speed - 0.5 * g * (t - begin));
      begin += flight;
      speed *= e;
    }
  };
  expect_solution(
      "param g = 9.81\nparam e = 0.8\ndh/dt = v\ndv/dt = -g\nwhen h < 0: v = -e*v\n",
      {1.0, 0.3, 9.81, 0.8}, sample_times(0.0, 0.07, 30), solved);
}

TEST(EventMaps, RepeatedDosesAreFitted) {
  const OdeModel truth = parse_ode(
      "dgut/dt = -1.3*gut\ndx/dt = 1.3*gut - 0.2*x\nevery 12 until 40: gut += 100\n", "m.ode");
  const Dataset data =
      record_of(truth, Vector::Zero(2), sample_times(0.0, 0.75, 80), 0.5);
  const Fit found = fit(
      parse_ode_system("param ka = 0.6 in 0..\nparam k = 0.4 in 0..\nparam D = 150\n"
                       "dgut/dt = -ka*gut\ndx/dt = ka*gut - k*x\ninitial gut = 0 at 0 fixed\n"
                       "initial x = 0 at 0 fixed\nevery 12 until 40: gut += D\n",
                       "m.ode"),
      data, {});
  const std::vector<double> expected{1.3, 0.2, 100.0};
  ASSERT_EQ(found.numbers.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    ASSERT_TRUE(found.numbers[i].standard_error) << found.numbers[i].name;
    EXPECT_NEAR(found.numbers[i].value, expected[i], 4.0 * *found.numbers[i].standard_error);
    EXPECT_LT(*found.numbers[i].standard_error, 0.05 * expected[i]);
  }
  EXPECT_NEAR(found.quality[1].rmse, 0.5, 0.15);
}

TEST(EventMaps, RestitutionIsFitted) {
  const OdeModel truth =
      parse_ode("dh/dt = v\ndv/dt = -9.81\nwhen h < 0: v *= -0.8\n", "m.ode");
  const Dataset data = record_of(truth, (Vector(2) << 1.0, 0.0).finished(),
                                 sample_times(0.0, 0.02, 120), 0.01);
  const Fit found = fit(
      parse_ode_system("param g = 9 in 1..\nparam e = 0.7 in 0..1\ndh/dt = v\ndv/dt = -g\n"
                       "when h < 0: v = -e*v\n",
                       "m.ode"),
      data, {});
  ASSERT_EQ(found.numbers.size(), 2u);
  EXPECT_NEAR(found.numbers[0].value, 9.81, 0.02);
  EXPECT_NEAR(found.numbers[1].value, 0.8, 0.005);
  EXPECT_NEAR(found.quality[0].rmse, 0.01, 0.003);
}

}  // namespace
}  // namespace lacuna
