// SPDX-License-Identifier: MIT
#include "trajectories/refiners/noise_growth.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>

#include "bases/monomials.hpp"
#include "core/base/random.hpp"
#include "lacuna/model/equations/term.hpp"
#include "support/noisy_records.hpp"
#include "support/one_record.hpp"
#include "trajectories/refiners/reference_path.hpp"
#include "trajectories/subset_selection/negligible_columns.hpp"

namespace lacuna {
namespace {

/// Growth from 1 to 100 with noise sqrt(floor^2 + (fraction x)^2).
Dataset growing(double floor, double fraction, Index samples, std::uint64_t seed) {
  Random random(seed);
  Dataset data;
  data.states = {{"x", ""}};
  Trajectory& record = data.trajectories.emplace_back();
  record.time = Vector::LinSpaced(samples, 0.0, 10.0);
  record.states.resize(samples, 1);
  record.inputs.resize(samples, 0);
  for (Index i = 0; i < samples; ++i) {
    const double x = 100.0 / (1.0 + 99.0 * std::exp(-record.time[i]));
    const double deviation = std::sqrt(floor * floor + fraction * fraction * x * x);
    record.states(i, 0) = x + deviation * random.normal();
  }
  return data;
}

SampleNoise noise_of(const Dataset& data, const GrowingNoise& rule = {}) {
  const std::vector<StateNoise> noise = analyse_noise(data);
  return noise_of_samples(data, Vector::Constant(1, noise[0].sigma), noise, rule);
}

TEST(NoiseGrowth, IsFoundWithItsFraction) {
  for (const Index samples : {256, 512, 4096}) {
    const SampleNoise noise = noise_of(growing(0.0, 0.05, samples, 1));
    ASSERT_TRUE(noise.growth[0].has_value()) << samples;
    EXPECT_NEAR(noise.growth[0]->fraction, 0.05, 0.01) << samples;
    const Matrix& deviations = noise.deviations[0];
    EXPECT_NEAR(deviations(samples - 5, 0), 5.0, 1.0);
    EXPECT_LT(deviations(4, 0), 0.2);
    EXPECT_NEAR(noise.rms[0], std::sqrt(deviations.squaredNorm() / double(samples)), 1e-12);
  }
}

TEST(NoiseGrowth, KnowsAFloor) {
  const SampleNoise noise = noise_of(growing(1.0, 0.05, 4096, 2));
  ASSERT_TRUE(noise.growth[0].has_value());
  EXPECT_NEAR(noise.growth[0]->floor, 1.0, 0.2);
  EXPECT_NEAR(noise.growth[0]->fraction, 0.05, 0.01);
  EXPECT_NEAR(noise.growth[0]->at(20.0), std::sqrt(2.0), 0.3);
}

TEST(NoiseGrowth, TheRuleDecides) {
  const Dataset data = growing(0.0, 0.05, 512, 1);
  EXPECT_FALSE(noise_of(data, {.least_fraction = 0.1}).growth[0].has_value());
  EXPECT_FALSE(noise_of(data, {.significance = 1e3}).growth[0].has_value());
  EXPECT_FALSE(noise_of(data, {.unit_variance = 0.5}).growth[0].has_value());
}

TEST(NoiseGrowth, ConstantNoiseDoesNotGrow) {
  int growing_ones = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const SampleNoise noise = noise_of(growing(1.0, 0.0, 512, seed));
    growing_ones += noise.growth[0].has_value();
    if (noise.growth[0]) continue;
    EXPECT_EQ(noise.deviations[0].minCoeff(), noise.rms[0]);
  }
  EXPECT_LE(growing_ones, 2);
}

TEST(NoiseGrowth, DoesNotVanishWhereASignalCrossesZero) {
  Random random(3);
  Dataset data = growing(0.0, 0.0, 1000, 1);
  for (Index i = 0; i < 1000; ++i)
    data.trajectories[0].states(i, 0) =
        std::sin(data.trajectories[0].time[i]) * (1.0 + 0.05 * random.normal());
  const SampleNoise noise = noise_of(data);
  ASSERT_TRUE(noise.growth[0].has_value());
  EXPECT_GT(noise.deviations[0].minCoeff(), 1e-4);
}

TEST(NoiseGrowth, FastStretchesAreNoNoise) {
  // Spikes, sampled coarsely: what differences see of them is largest where they are high.
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    Dataset data = growing(0.0, 0.0, 3000, 1);
    for (Index i = 0; i < 3000; ++i) {
      const double phase = 0.05 * static_cast<double>(i);
      data.trajectories[0].states(i, 0) =
          std::exp(8.0 * (std::cos(phase) - 1.0)) + 0.002 * random.normal();
    }
    EXPECT_FALSE(noise_of(data).growth[0].has_value()) << seed;
  }
}

TEST(NoiseGrowth, ErrorsOfSolversAndDigitsAreNoNoise) {
  EXPECT_FALSE(noise_of(growing(0.0, 1e-6, 4096, 1)).growth[0].has_value());
  EXPECT_TRUE(noise_of(growing(0.0, 1e-3, 4096, 1)).growth[0].has_value());
}

/// Values of a term at all nodes of the path.
Vector values_of(const std::string& term, const WindowSearch& search) {
  std::vector<double> values;
  for (const SampleWindow& window : search.path.windows) {
    const PathRecord& record = search.path.records[window.record];
    const Index nodes = (window.samples - 1) * record.stride() + 1;
    for (Index i = 0; i < nodes; ++i) {
      const double x = record.slots(window.first * record.stride() + i, 0);
      const double y = record.slots(window.first * record.stride() + i, 1);
      values.push_back(term == "x" ? x : term == "y" ? y : x * x * y);
    }
  }
  return Eigen::Map<const Vector>(values.data(), static_cast<Index>(values.size()));
}

TEST(RateEffects, AreWhatTheOtherTermsCannotSay) {
  const Dataset data = noisy_record("van-der-pol", 300, 0.01, 1);
  const TermLibrary library = Monomials{}.library({{"x", "y"}, {}});
  const SearchTask task = search_task(data, {library}, analyse_noise(data), {});
  WindowSearch search = prepared_search(task);
  search.path.windows = windows_of(search.path.records, 50);
  search.fit.coefficients = Matrix::Zero(2, library.size());
  const auto place = [&](const std::string& name) {
    const std::vector<std::string> names = library.names();
    return std::find(names.begin(), names.end(), name) - names.begin();
  };
  const std::vector<Coefficient> columns = {
      {1, place("x")}, {0, place("y")}, {1, place("x^2*y")}, {1, place("y")}};
  const RateEffects effects(search, columns);

  const Vector h = Eigen::Vector3d(-1.0, -2.0, 2.0);
  const Vector fractions = effects.fractions({0, 2, 3}, h);
  const std::string names[] = {"x", "x^2*y", "y"};
  Matrix theta(values_of("x", search).size(), 3);
  for (Index i = 0; i < 3; ++i) theta.col(i) = values_of(names[i], search);
  const double rate = (theta * h).norm();
  for (Index i = 0; i < 3; ++i) {
    Matrix others(theta.rows(), 2);
    others << theta.col((i + 1) % 3), theta.col((i + 2) % 3);
    const Vector left =
        theta.col(i) - others * others.colPivHouseholderQr().solve(Vector(theta.col(i)));
    EXPECT_NEAR(fractions[i], std::abs(h[i]) * left.norm() / rate, 1e-9);
  }
  // Alone in its equation a term is the whole rate.
  EXPECT_NEAR(effects.fractions({1}, Vector::Constant(1, 0.7))[0], 1.0, 1e-12);
}

/// dx/dt = u, u held at 0, 0, 3, 3, -1 over steps of 0.1.
Dataset ramp(std::optional<Hold> hold) {
  Trajectory record;
  record.time = Vector{{0.0, 0.1, 0.2, 0.3, 0.4, 0.5}};
  record.inputs = Vector{{0.0, 0.0, 3.0, 3.0, -1.0, -1.0}};
  record.states = Vector{{0.0, 0.0, 0.0, 0.3, 0.6, 0.5}};
  return support::one_record({{"x", ""}}, {{"u", "", hold}}, record);
}

Vector input_nodes(const Dataset& data, Index substeps) {
  TermLibrary library{{{"x"}, {"u"}}, {}};
  library.terms = {Term::parse("u", library.variables)};
  const Program program = library.compile();
  PathRecord path = make_paths(data, {Matrix::Zero(6, 1)}, program)[0];
  if (substeps > 1) set_substeps(path, substeps, program);
  return path.slots.col(1);
}

/// Simpson's rule over the nodes gives the ramp, in however many parts.
TEST(ReferencePath, TheIntegralOfAHeldInputIsTheRamp) {
  for (const Index substeps : {1, 2, 5}) {
    const Vector u = input_nodes(ramp(Hold::Zero), substeps);
    const double part = 0.1 / static_cast<double>(substeps);
    ASSERT_EQ(u.size(), 10 * substeps + 1);
    double x = 0.0;
    for (Index i = 0; i + 2 < u.size(); i += 2)
      x += part / 6.0 * (u[i] + 4.0 * u[i + 1] + u[i + 2]);
    EXPECT_NEAR(x, 0.5, 1e-12) << substeps;
  }
}

}  // namespace
}  // namespace lacuna
