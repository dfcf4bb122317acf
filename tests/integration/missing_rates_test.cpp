// SPDX-License-Identifier: MIT
// Diagnoses of plants whose rates are not constant, each by its own simulation: what is missing is
// named, with its numbers.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "core/base/random.hpp"
#include "data/derivatives/finite_differences.hpp"
#include "lacuna/diagnose/diagnose.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/records/binding/model_view.hpp"

namespace lacuna {
namespace {

using Rates = std::function<Vector(double t, const Vector& x, double u)>;

/// A plant that is sampled.
struct Plant {
  std::string nominal;  ///< its model, as text
  Rates rates;
  Vector start;
  double step = 1.0;
  Index samples = 0;
  double noise = 0.01;       ///< as a fraction of the deviation
  double low = 0, high = 0;  ///< of the input's levels
};

/// One step of Runge and Kutta in so many parts, the input held.
Vector moved(const Plant& plant, double t, Vector x, double u) {
  constexpr int kParts = 20;
  const double h = plant.step / kParts;
  for (int part = 0; part < kParts; ++part, t += h) {
    const Vector a = plant.rates(t, x, u), b = plant.rates(t + 0.5 * h, x + 0.5 * h * a, u);
    const Vector c = plant.rates(t + 0.5 * h, x + 0.5 * h * b, u);
    x += h / 6.0 * (a + 2.0 * b + 2.0 * c + plant.rates(t + h, x + h * c, u));
  }
  return x;
}

/// The record of a plant, its time from `begin` on.
Dataset record_of(const Plant& plant, const OdeModel& nominal, std::uint64_t seed,
                  double begin = 0.0) {
  Random random(seed);
  Trajectory record;
  record.source = "made";
  record.time = Vector::LinSpaced(plant.samples, 0.0,
                                  plant.step * static_cast<double>(plant.samples - 1));
  record.states.resize(plant.samples, plant.start.size());
  record.inputs.resize(plant.samples, static_cast<Index>(nominal.inputs().size()));
  Vector x = plant.start;
  double level = 0.5 * (plant.low + plant.high);
  for (Index i = 0; i < plant.samples; ++i) {
    if (i % 90 == 0) level = random.uniform(plant.low, plant.high);
    record.states.row(i) = x.transpose();
    record.inputs.row(i).setConstant(level);
    x = moved(plant, begin + record.time[i], x, level);
  }
  for (auto column : record.states.colwise()) {
    const double spread = std::sqrt((column.array() - column.mean()).square().mean());
    for (double& value : column) value += plant.noise * spread * random.normal();
  }
  Dataset data;
  data.time_unit = nominal.time_unit();
  data.states = nominal.states();
  data.inputs = nominal.inputs();
  data.trajectories = {std::move(record)};
  return model_view(nominal, data, FiniteDifferences{});
}

Diagnosis diagnosed(const Plant& plant, double begin_of_other = 0.0) {
  const OdeModel nominal = parse_ode(plant.nominal, "made");
  return diagnose(nominal, record_of(plant, nominal, 5),
                  record_of(plant, nominal, 6, begin_of_other), DiagnosisOptions{},
                  RunContext{});
}

std::vector<std::string> names_of(const Diagnosis& found) {
  std::vector<std::string> names;
  for (const NamedEffect& effect : found.effects) names.push_back(effect.name);
  return names;
}

double parameter_of(const NamedEffect& effect, const std::string& name) {
  for (const NamedParameter& parameter : effect.parameters)
    if (parameter.name == name) return parameter.value;
  return std::nan("");
}

/// A tank in which a reaction gives off heat; its rate is that of the model at 300 K only.
Plant reactor(double scale) {
  return {"time s\ninput Tc [K] hold zero\nparam q = 0.01\nparam k = 0.02\nparam kc = 0.02\n"
          "dc/dt = q*(1-c) - k*c\ndT/dt = q*(300-T) + 30*k*c + kc*(Tc-T)\n",
          [scale](double, const Vector& x, double u) {
            const double turnover = 0.02 * std::exp((x[1] - 300.0) / scale) * x[0];
            return Vector{{0.01 * (1.0 - x[0]) - turnover,
                           0.01 * (300.0 - x[1]) + 30.0 * turnover + 0.02 * (u - x[1])}};
          },
          Vector{{0.5, 300.0}}, 2.0, 1500, 0.01, 290.0, 310.0};
}

// One process in two equations, of which one alone is explained nearly as well by functions of
// the concentration: found whatever the scale is among the starting points.
class ReactionOfScale : public ::testing::TestWithParam<double> {};

TEST_P(ReactionOfScale, DependsOnTheTemperatureInBothEquations) {
  const Diagnosis found = diagnosed(reactor(GetParam()));
  EXPECT_EQ(names_of(found),
            (std::vector<std::string>{"exponential-rate", "exponential-rate"}));
  for (const NamedEffect& effect : found.effects)
    EXPECT_NEAR(parameter_of(effect, "scale"), GetParam(), 0.04 * GetParam());
  EXPECT_EQ(found.verdict, Verdict::Explained);
}

INSTANTIATE_TEST_SUITE_P(MissingRates, ReactionOfScale, ::testing::Values(8.0, 12.0, 20.0));

TEST(MissingRates, ABirthRateThatFollowsTheSeason) {
  const Plant prey{
      "time d\nparam a = 0.9\nparam b = 0.022\nparam c = 0.55\nparam d = 0.011\n"
      "dx/dt = a*x - b*x*y\ndy/dt = d*x*y - c*y\n",
      [](double t, const Vector& x, double) {
        return Vector{{(1.0 + 0.3 * std::sin(0.5 * t)) * x[0] - 0.02 * x[0] * x[1],
                       0.01 * x[0] * x[1] - 0.5 * x[1]}};
      },
      Vector{{40.0, 20.0}}, 0.1, 480, 0.02};
  const Diagnosis found = diagnosed(prey, 7.0);
  ASSERT_EQ(names_of(found), std::vector<std::string>{"periodic-parameter"});
  EXPECT_NEAR(parameter_of(found.effects[0], "frequency"), 0.5 / (2.0 * std::numbers::pi),
              1e-3);
  EXPECT_NEAR(std::abs(found.effects[0].coefficient), 0.3, 0.01);
  EXPECT_EQ(found.verdict, Verdict::Explained) << "other records begin in another season";
}

TEST(MissingRates, ABodyThatRadiates) {
  const Plant heated{
      "time s\ninput P [W] hold zero\nparam a = 2e-3\nparam b = 2.5e-3\n"
      "dT/dt = a*P - b*(T-20)\n",
      [](double, const Vector& x, double u) {
        const double radiated = std::pow(x[0] + 273.0, 4) - std::pow(293.0, 4);
        return Vector{{2e-3 * u - 2e-3 * (x[0] - 20.0) - 4e-12 * radiated}};
      },
      Vector{{20.0}}, 5.0, 1800, 0.002, 0.0, 200.0};
  const Diagnosis found = diagnosed(heated);
  ASSERT_EQ(names_of(found), std::vector<std::string>{"radiation"});
  EXPECT_NEAR(parameter_of(found.effects[0], "zero"), 273.0, 80.0);
  EXPECT_EQ(found.verdict, Verdict::Explained);
}

TEST(MissingRates, EffectsBehindASpecialFormAreSoughtAgainBehindThePlainOne) {
  // Of 0.01 (1 - S - I) a power of S comes in before S itself, and a delay of I behind it.
  const Plant epidemic{
      "time s\nparam b = 0.4\nparam g = 0.1\ndS/dt = -b*S*I\ndI/dt = b*S*I - g*I\n",
      [](double, const Vector& x, double) {
        return Vector{{-0.4 * x[0] * x[1] + 0.01 * (1.0 - x[0] - x[1]),
                       0.4 * x[0] * x[1] - 0.1 * x[1]}};
      },
      Vector{{0.99, 0.01}}, 0.5, 360, 0.005};
  const Diagnosis found = diagnosed(epidemic);
  EXPECT_EQ(names_of(found),
            (std::vector<std::string>{"constant-offset", "linear-term", "linear-term"}));
  for (const NamedEffect& effect : found.effects)
    EXPECT_NEAR(std::abs(effect.coefficient), 0.01, 0.0015) << effect.term;
}

}  // namespace
}  // namespace lacuna
