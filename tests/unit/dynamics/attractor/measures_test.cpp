// SPDX-License-Identifier: MIT
// Measures of an attractor beside closed forms and published numbers.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dynamics/attractor/density_distance.hpp"
#include "dynamics/attractor/extents.hpp"
#include "dynamics/attractor/lyapunov.hpp"
#include "dynamics/attractor/power_spectrum.hpp"
#include "dynamics/attractor/prediction_time.hpp"
#include "lacuna/dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/test_systems/measurement.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"

namespace lacuna {
namespace {

Matrix orbit(const std::string& name, Index first) {
  const TestSystem& system = test_system(name);
  const Dataset record = record_of(system.model, Dopri8{}, system.start, 0.1, first + 10000);
  return record.trajectories[0].states.bottomRows(10000);
}

TEST(DensityDistance, IsZeroForTheSameAndOneForSeparateAttractors) {
  const Matrix states = orbit("rossler", 0);
  EXPECT_NEAR(density_distance(states, states), 0.0, 1e-6);
  EXPECT_EQ(density_distance(states, states.array() + 1000.0), 1.0);
}

TEST(DensityDistance, TellsSystemsApartThatLookAlike) {
  const double chance =
      density_distance(orbit("rossler-adjusted", 1000), orbit("rossler-adjusted", 12000));
  const double systems =
      density_distance(orbit("rossler-adjusted", 1000), orbit("tl072", 1000));
  EXPECT_LT(chance, 0.2);
  EXPECT_GT(systems, 2.0 * chance);
}

TEST(DensityDistance, UnitsDoNotCount) {
  Matrix a = orbit("rossler", 500), b = orbit("rossler", 9000);
  const double before = density_distance(a, b);
  a.col(2) *= 8.0;
  b.col(2) *= 8.0;
  EXPECT_NEAR(density_distance(a, b), before, 1e-12);
}

Dataset record_of_columns(const Vector& x, const Vector& y) {
  Trajectory run;
  run.source = "made";
  run.time = Vector::LinSpaced(x.size(), 0.0, static_cast<double>(x.size() - 1));
  run.states.resize(x.size(), 2);
  run.states << x, y;
  Dataset record;
  record.states = {{"x", "V"}, {"y", "V"}};
  record.trajectories = {run};
  return record;
}

TEST(AttractorExtents, SizesAreThoseOfTheWholeRecord) {
  const Dataset record =
      record_of_columns(Vector{{0, 1, 0, 2, 1, 3}}, Vector{{5, 5, 1, 2, 3, 3}});
  const AttractorExtents extents = attractor_extents(record, 2);
  EXPECT_EQ(extents.size, (Vector{{3.0, 4.0}}));
  EXPECT_EQ(extents.volume, 12.0);
}

TEST(AttractorExtents, IntervalIsThatOfTheMeanOfTheBlocks) {
  // Blocks of x: sizes 1, 2, 3; mean 2, s = 1; t for 2 degrees of freedom is 4.3027.
  const Dataset record =
      record_of_columns(Vector{{0, 1, 0, 2, 0, 3}}, Vector{{0, 1, 0, 1, 0, 1}});
  const AttractorExtents extents = attractor_extents(record, 3);
  EXPECT_NEAR(extents.half_width[0], 4.302653 / std::sqrt(3.0), 1e-5);
  EXPECT_EQ(extents.half_width[1], 0.0);
  EXPECT_NEAR(extents.volume_half_width, extents.half_width[0], 1e-12);
}

TEST(AttractorExtents, TrajectoriesCountTogether) {
  Dataset record = record_of_columns(Vector{{0, 1, 0, 1}}, Vector{{0, 1, 0, 1}});
  record.trajectories.push_back(record.trajectories[0]);
  record.trajectories[1].states.array() += 10.0;
  EXPECT_EQ(attractor_extents(record, 2).size, (Vector{{11.0, 11.0}}));
}

OdeModel linear_model(double a, double b) {
  const Variables names{{"x", "y"}, {}};
  return OdeModel(
      {{"x", ""}, {"y", ""}}, {},
      {{{Term::parse("x", names), a, {}, {}}, {Term::parse("y", names), 3.0, {}, {}}},
       {{Term::parse("y", names), b, {}, {}}}});
}

TEST(LyapunovSpectrum, OfALinearSystemAreItsEigenvalues) {
  const LyapunovSpectrum spectrum = lyapunov_spectrum(linear_model(-0.5, -2.0), Dopri8{},
                                                      Vector{{1.0, 1.0}}, {0.05, 50.0, 200.0});
  EXPECT_NEAR(spectrum.exponents[0], -0.5, 1e-9);
  EXPECT_NEAR(spectrum.exponents[1], -2.0, 1e-9);
  EXPECT_EQ(spectrum.dimension, 0.0);
}

TEST(LyapunovSpectrum, OfLorenzIsTheKnownOne) {
  const TestSystem& lorenz = test_system("lorenz");
  const LyapunovSpectrum spectrum =
      lyapunov_spectrum(lorenz.model, Rk4{}, lorenz.start, {0.01, 20.0, 600.0});
  EXPECT_NEAR(spectrum.exponents[0], 0.906, 0.02);
  EXPECT_NEAR(spectrum.exponents[1], 0.0, 0.01);
  EXPECT_NEAR(spectrum.exponents[2], -14.572, 0.03);
  EXPECT_NEAR(spectrum.exponents.sum(), -(10.0 + 1.0 + 8.0 / 3.0), 1e-3);
  EXPECT_NEAR(spectrum.dimension, 2.062, 0.002);
  EXPECT_LT(spectrum.half_width[0], 0.05);
}

TEST(KaplanYorkeDimension, FillsTheSumOfTheExponents) {
  EXPECT_DOUBLE_EQ(kaplan_yorke_dimension(Vector{{0.5, 0.0, -2.0}}), 2.25);
  EXPECT_DOUBLE_EQ(kaplan_yorke_dimension(Vector{{-0.1, -0.2}}), 0.0);
  EXPECT_DOUBLE_EQ(kaplan_yorke_dimension(Vector{{0.3, -0.1}}), 2.0);
}

Trajectory sine(double frequency, double amplitude, Index n = 4000) {
  Trajectory run;
  run.time = Vector::LinSpaced(n, 0.0, 0.01 * static_cast<double>(n - 1));
  run.states.resize(n, 1);
  run.states.col(0) =
      7.0 + amplitude * (2.0 * std::numbers::pi * frequency * run.time).array().sin();
  return run;
}

TEST(PowerSpectrum, OfASineHasItsFrequencyAndItsVariance) {
  const PowerSpectrum spectrum = power_spectrum(sine(5.0, 3.0), 8);
  Index peak = 0;
  spectrum.density.col(0).maxCoeff(&peak);
  EXPECT_NEAR(spectrum.frequency[peak], 5.0, 0.2);
  EXPECT_NEAR(spectrum.density.sum() * spectrum.frequency[1], 0.5 * 9.0, 0.05);
  EXPECT_NEAR(spectrum.frequency[spectrum.frequency.size() - 1], 50.0, 1e-9);
}

TEST(PowerSpectrumDistance, KnowsTheShapeNotTheSize) {
  EXPECT_NEAR(power_spectrum_distance(sine(5.0, 1.0), sine(5.0, 4.0)), 0.0, 1e-6);
  EXPECT_GT(power_spectrum_distance(sine(5.0, 1.0), sine(20.0, 1.0)), 0.95);
}

TEST(PowerSpectrumDistance, CutsToTheShorterRecord) {
  EXPECT_LT(power_spectrum_distance(sine(5.0, 1.0), sine(5.0, 1.0, 3600)), 0.05);
}

OdeModel drift(double speed) {
  const Variables names{{"x"}, {}};
  return OdeModel({{"x", ""}}, {}, {{{Term::parse("1", names), speed, {}, {}}}});
}

TEST(ValidPredictionTime, EndsWhereTheErrorPassesTheThreshold) {
  const Dataset ramp = record_of(drift(1.0), Rk4{}, Vector{{0.0}}, 0.01, 1001);
  // x = t for 10 time units has a standard deviation of 10 / sqrt(12); the error of 2 t is t.
  const PredictionTime time =
      valid_prediction_time(drift(2.0), ramp, Rk4{}, {.threshold = 0.4, .starts = 2});
  EXPECT_NEAR(time.median, 4.0 / std::sqrt(12.0), 0.011);
  EXPECT_EQ(time.times.size(), 2);
  EXPECT_EQ(time.cut_off, 0);
}

TEST(ValidPredictionTime, OfTheTrueModelEndsWithTheRecord) {
  const Dataset ramp = record_of(drift(1.0), Rk4{}, Vector{{0.0}}, 0.01, 1001);
  const PredictionTime time = valid_prediction_time(drift(1.0), ramp, Rk4{}, {.starts = 1});
  EXPECT_EQ(time.cut_off, 1);
  EXPECT_NEAR(time.median, 10.0, 1e-9);
}

TEST(ValidPredictionTime, OfAChaoticSystemFallsWithTheErrorOfTheModel) {
  const TestSystem& lorenz = test_system("lorenz");
  const Dataset record = record_of(lorenz.model, Dopri8{}, lorenz.start, 0.01, 6000);
  const auto median = [&](double change) {
    const Term term = lorenz.model.equations()[0][0].term;
    const OdeModel model = lorenz.model.with_term(0, {term, change, {}, {}});
    return valid_prediction_time(model, record, Dopri8{}).median;
  };
  EXPECT_GT(median(1e-8), median(1e-4) + 5.0);
  EXPECT_GT(median(1e-4), median(1e-1) + 3.0);
}

}  // namespace
}  // namespace lacuna
