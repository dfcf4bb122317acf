// SPDX-License-Identifier: MIT
// Measures of attractors and their comparison.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <numbers>

#include "dynamics/attractor/density_distance.hpp"
#include "dynamics/attractor/extents.hpp"
#include "dynamics/attractor/lyapunov.hpp"
#include "dynamics/attractor/power_spectrum.hpp"
#include "dynamics/attractor/prediction_time.hpp"
#include "dynamics/attractor/rosenstein.hpp"
#include "dynamics/integration/runge_kutta.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/dynamics/attractor/comparison.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"

namespace lacuna {
namespace {

// Measures of an attractor beside closed forms and published numbers.
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

/// An orbit of Lorenz's system with another start and another rho.
Dataset lorenz(double start, double rho) {
  const Variables variables{{"x", "y", "z"}, {}};
  const auto term = [&](const char* text) { return Term::parse(text, variables); };
  const OdeModel model({{"x", ""}, {"y", ""}, {"z", ""}}, {},
                       {{{term("x"), -10.0}, {term("y"), 10.0}},
                        {{term("x"), rho}, {term("y"), -1.0}, {term("x*z"), -1.0}},
                        {{term("z"), -8.0 / 3.0}, {term("x*y"), 1.0}}});
  Solution orbit =
      simulate(model, Rk4{}, Eigen::Vector3d(start, 2.0, 20.0), sample_times(0.0, 0.01, 30000));
  return {"s",
          model.states(),
          {},
          {{"orbit", orbit.time, orbit.states, Matrix(30000, 0), Matrix()}},
          {}};
}

std::vector<std::string> failures(const std::vector<AttractorMeasure>& measures) {
  std::vector<std::string> names;
  for (const AttractorMeasure& measure : measures)
    if (measure.agree == false) names.push_back(measure.name);
  return names;
}

TEST(Comparison, OrbitsOfOneAttractorAgree) {
  const auto measures = compare_attractors(lorenz(1.0, 28.0), lorenz(-3.0, 28.0));
  ASSERT_EQ(measures.size(), 6u);
  EXPECT_THAT(failures(measures), ::testing::IsEmpty());
  // Lyapunov exponent of Lorenz's system: 0.906 (Sprott 2003).
  EXPECT_NEAR(measures[5].first, 0.906, 0.15);
  EXPECT_GT(measures[5].first_half, 0.0);
}

TEST(Comparison, OrbitsOfAnotherOneDoNot) {
  const auto names = failures(compare_attractors(lorenz(1.0, 28.0), lorenz(1.0, 35.0)));
  EXPECT_THAT(names, ::testing::Contains("extent of z"));
  EXPECT_THAT(names, ::testing::Contains("density"));
}

/// A sine whose size in five stretches is given.
Dataset swings(const std::vector<double>& sizes) {
  constexpr Index kEach = 600;
  const Index n = kEach * static_cast<Index>(sizes.size());
  Trajectory run{"swings", Vector::LinSpaced(n, 0.0, 0.05 * static_cast<double>(n - 1)),
                 Matrix(n, 1), Matrix(n, 0), Matrix()};
  for (Index i = 0; i < n; ++i)
    run.states(i, 0) = sizes[static_cast<std::size_t>(i / kEach)] * std::sin(run.time[i]);
  return {"s", {{"x", ""}}, {}, {run}, {}};
}

TEST(Comparison, IntervalsOfBothRecordsCount) {
  // Extents of 2 +- 0 and of 1.8 +- 0.39, Student's t of 1, 1.2, 1.4, 1.6, 1.8.
  const auto measures =
      compare_attractors(swings({1, 1, 1, 1, 1}), swings({0.5, 0.6, 0.7, 0.8, 0.9}));
  EXPECT_LT(measures[0].first_half, 0.01);
  EXPECT_NEAR(measures[0].second_half, 2.776 * std::sqrt(0.1) / std::sqrt(5.0), 0.01);
  EXPECT_EQ(measures[0].agree, true);
}

TEST(Comparison, WhatCannotBeToldIsNotJudged) {
  Dataset a = lorenz(1.0, 28.0), b = a;
  a.trajectories[0] = rows_of(a.trajectories[0], 0, 200);
  b.trajectories[0] = rows_of(b.trajectories[0], 200, 200);
  const auto measures = compare_attractors(a, b);
  EXPECT_FALSE(measures[5].agree);
  EXPECT_NE(measures[5].note, "");
}

TEST(Comparison, WhatIsBeyondTheRangeOfNumbersDoesNotAgree) {
  Dataset huge = lorenz(1.0, 28.0);
  huge.trajectories[0].states *= 1e300;
  EXPECT_THROW(compare_attractors(huge, huge), DataError);
}

TEST(Comparison, PastTheDeadlineMeasuresAreLeftOut) {
  const Dataset orbit = lorenz(1.0, 28.0);
  RunContext context;
  context.progress = [&](const Progress&) {
    context.deadline = std::chrono::steady_clock::now();
  };
  const auto measures = compare_attractors(orbit, orbit, context);
  ASSERT_EQ(measures.size(), 6u);
  for (std::size_t i = 0; i < measures.size(); ++i) {
    EXPECT_EQ(measures[i].left_out, i >= 3) << measures[i].name;  // extents take no time
    EXPECT_EQ(measures[i].agree.has_value(), i < 3) << measures[i].name;
  }
  EXPECT_THROW(compare_attractors(orbit, orbit, context), OutOfTime);
}

Divergence divergence_of(const std::string& name, double h, Index n) {
  const TestSystem& system = test_system(name);
  const Dataset record = record_of(system.model, Dopri8{}, system.start, h, n);
  return rosenstein_divergence(record.trajectories[0], 500);
}

TEST(RosensteinDivergence, FindsTheKnownExponents) {
  EXPECT_NEAR(divergence_of("lorenz", 0.02, 8000).exponent, 0.906, 0.15);
  EXPECT_NEAR(divergence_of("rossler", 0.1, 20000).exponent, 0.0714, 0.02);
}

TEST(RosensteinDivergence, ALimitCycleHasNone) {
  EXPECT_NEAR(divergence_of("van-der-pol", 0.05, 6000).exponent, 0.0, 0.02);
}

TEST(RosensteinDivergence, MeanPeriodOfASineIsItsPeriod) {
  Trajectory sine;
  sine.time = Vector::LinSpaced(2001, 0.0, 100.0);
  sine.states.resize(2001, 1);
  sine.states.col(0) = (2.0 * std::numbers::pi / 3.0 * sine.time).array().sin();
  EXPECT_NEAR(rosenstein_divergence(sine, 50).mean_period, 3.0, 0.02);
}

TEST(RosensteinDivergence, UnitsOfTheStatesDoNotCount) {
  const TestSystem& system = test_system("lorenz");
  Dataset record = record_of(system.model, Dopri8{}, system.start, 0.02, 4000);
  const double before = rosenstein_divergence(record.trajectories[0], 200).exponent;
  record.trajectories[0].states.col(1) *= 1000.0;
  EXPECT_NEAR(rosenstein_divergence(record.trajectories[0], 200).exponent, before, 1e-9);
}

}  // namespace
}  // namespace lacuna
