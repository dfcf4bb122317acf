// SPDX-License-Identifier: MIT
// Blocks and windows of a record that are predicted by what the others determine.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/base/random.hpp"
#include "identify/validation/held_blocks.hpp"
#include "identify/validation/prediction_windows.hpp"
#include "identify/validation/refit.hpp"
#include "lacuna/dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/test_systems/measurement.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/identify/pipeline/presets.hpp"
#include "lacuna/model/files/ode_text.hpp"

namespace lacuna {
namespace {

/// Records of so many samples; the one state counts samples through all records.
Dataset counted(const std::vector<Index>& samples) {
  Dataset data;
  data.states = {{"x", ""}};
  double value = 0.0;
  for (const Index n : samples) {
    Trajectory record;
    record.time = Vector::LinSpaced(n, 0.0, static_cast<double>(n - 1));
    record.states = Matrix(n, 1);
    record.inputs = Matrix(n, 0);
    for (Index i = 0; i < n; ++i) record.states(i, 0) = value++;
    data.trajectories.push_back(std::move(record));
  }
  return data;
}

Index samples_in(const std::vector<Block>& blocks) {
  Index total = 0;
  for (const Block& block : blocks) total += block.count;
  return total;
}

TEST(HeldBlocks, AreAQuarterSpreadOverTheRecord) {
  const Dataset data = counted({2000});
  const std::vector<Block> blocks = held_blocks(data, 30);
  EXPECT_EQ(samples_in(blocks), 500);
  ASSERT_EQ(blocks.size(), 5U);
  for (std::size_t b = 1; b < blocks.size(); ++b)
    EXPECT_EQ(blocks[b].first - blocks[b - 1].first, 400);
}

TEST(HeldBlocks, HoldAWindowUnlessThatLeavesFewerThanEight) {
  EXPECT_NEAR(double(held_blocks(counted({2000}), 150).front().count), 2000.0 / 13.0, 1.0);
  EXPECT_EQ(held_blocks(counted({800}), 800).front().count, 100);
}

TEST(HeldBlocks, OfManyShortRecordsEveryFourthIsHeldOut) {
  const std::vector<Block> blocks = held_blocks(counted(std::vector<Index>(40, 25)), 20);
  ASSERT_EQ(blocks.size(), 10U);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    EXPECT_EQ(blocks[b].record, 4 * b + 2);
    EXPECT_EQ(blocks[b].count, 25);
  }
}

/// A record that rests, moves for a while and rests again.
Dataset resting(Index before, Index moving, Index behind) {
  Dataset data = counted({before + moving + behind});
  auto x = data.trajectories[0].states.col(0);
  x.head(before).setConstant(double(before));
  x.tail(behind).setConstant(double(before + moving - 1));
  return data;
}

TEST(HeldBlocks, AreWhereARecordMoves) {
  const std::vector<Block> blocks = held_blocks(resting(3000, 400, 5000), 20);
  ASSERT_NEAR(double(samples_in(blocks)), 100.0, 20.0);
  ASSERT_FALSE(blocks.empty());
  for (const Block& block : blocks) {
    EXPECT_GE(block.first, 2999);
    EXPECT_LE(block.first + block.count, 3402);
  }
}

TEST(HeldBlocks, WithThemTheRestIsTheWholeRecord) {
  const Dataset data = counted({500, 300});
  const std::vector<Block> blocks = held_blocks(data, 20);
  const Dataset rest = without_blocks(data, blocks, 2);
  EXPECT_EQ(rest.samples() + samples_in(blocks), 800);
  double sum = 0.0;
  for (const Trajectory& record : rest.trajectories) sum += record.states.sum();
  for (const Block& block : blocks)
    sum += data.trajectories[block.record].states.middleRows(block.first, block.count).sum();
  EXPECT_EQ(sum, 799.0 * 800.0 / 2.0);
}

TEST(HeldBlocks, ShortStretchesOfTheRestAreDropped) {
  const Dataset data = counted({30});
  const Dataset rest = without_blocks(data, {{0, 5, 10}}, 10);
  ASSERT_EQ(rest.trajectories.size(), 1U);
  EXPECT_EQ(rest.trajectories[0].states(0, 0), 15.0);
  EXPECT_EQ(rest.samples(), 15);
}

Dataset lorenz_samples(double noise, Index samples) {
  const TestSystem& lorenz = test_system("lorenz");
  Dataset data = record_of(lorenz.model, Dopri87{}, lorenz.start, 0.01, samples);
  if (noise > 0.0) return add_relative_noise(data, noise, 3);
  data.trajectories[0].derivatives.resize(0, 0);
  return data;
}

TEST(Refit, FitsWindowsAndNoMore) {
  // Of what does not fit to the noise multiple shooting would fit the coefficients again, which
  // predictions do not notice.
  const OdeModel& truth = test_system("lorenz").model;
  std::vector<Equation> equations = truth.equations();
  equations[1].pop_back();
  int fitted = 0, refined = 0;
  RunContext context;
  context.progress = [&](const Progress& progress) {
    const std::string activity(progress.activity);
    fitted += activity == "searching the structure";
    refined += activity == "refining";
  };
  ASSERT_TRUE(refitted_on(lorenz_samples(0.01, 2000), truth.with_equations(equations),
                          preset("algorithm1"), context)
                  .has_value());
  EXPECT_GT(fitted, 0);
  EXPECT_EQ(refined, 0);
}

TEST(Refit, IsNotPossibleWithoutTermsOrWithoutSamples) {
  const OdeModel& truth = test_system("lorenz").model;
  std::vector<Equation> equations = truth.equations();
  equations[1].clear();
  EXPECT_FALSE(refitted_on(lorenz_samples(0.0, 500), truth.with_equations(equations),
                           preset("algorithm1"), {})
                   .has_value());
  EXPECT_FALSE(
      refitted_on(lorenz_samples(0.0, 3), truth, preset("algorithm1"), {}).has_value());
}

OdeModel oscillator() {
  const Variables variables{{"x", "v"}, {}};
  return OdeModel(
      {{"x", ""}, {"v", ""}}, {},
      {{{Term::parse("v", variables), 1.0}}, {{Term::parse("x", variables), -1.0}}});
}

/// cos t, -sin t with noise.
PredictedRecord turning(Index n, double h, double sigma, std::uint64_t seed) {
  Random random(seed);
  PredictedRecord record;
  record.samples.time = Vector::LinSpaced(n, 0.0, h * static_cast<double>(n - 1));
  record.samples.inputs = Matrix(n, 0);
  record.path.resize(n, 2);
  for (Index i = 0; i < n; ++i)
    record.path.row(i) << std::cos(record.samples.time[i]), -std::sin(record.samples.time[i]);
  record.samples.states = record.path;
  for (double& value : record.samples.states.reshaped()) value += sigma * random.normal();
  record.deviations = Matrix::Constant(n, 2, sigma);
  return record;
}

TEST(PredictionWindows, OfTwoSamplesAreOneStepErrorsOverTheNoiseOfBoth) {
  constexpr double kStep = 0.3, kSigma = 0.02;
  const PredictedRecord record = turning(201, kStep, kSigma, 3);
  const WindowResiduals found = predict(oscillator(), record, 2, 1);
  // A rotation: y1 - R y0 has the covariance 2 sigma^2 and is shared out evenly.
  Matrix rotation(2, 2);
  rotation << std::cos(kStep), std::sin(kStep), -std::sin(kStep), std::cos(kStep);
  double expected = 0.0;
  for (Index i = 0; i + 1 < 201; i += 2) {
    const Vector error = record.samples.states.row(i + 1).transpose() -
                         rotation * record.samples.states.row(i).transpose();
    expected += error.squaredNorm() / 2.0;
  }
  EXPECT_EQ(found.windows, 100);
  EXPECT_NEAR(found.squares.sum(), expected, 1e-4 * expected);
  EXPECT_NEAR(found.freedom.sum(), 200.0, 1e-9);
  EXPECT_NEAR(found.expected.sum(), 200.0 * kSigma * kSigma, 1e-9);
}

TEST(PredictionWindows, StatesThatWereNotMeasuredTakeTheirFreedom) {
  PredictedRecord record = turning(300, 0.1, 1e-3, 1);
  record.deviations.col(1).setZero();
  record.samples.states.col(1).setConstant(99.0);
  const WindowResiduals found = predict(oscillator(), record, 3, 1);
  EXPECT_NEAR(found.freedom[0], 100.0, 1e-6);  // three samples less two initial states
  EXPECT_EQ(found.freedom[1], 0.0);
  EXPECT_NEAR(found.squares[0] / found.expected[0], 1.0, 4.0 * std::sqrt(2.0 / 100.0));
}

TEST(PredictionWindows, InWhichTheModelRunsThoughNotAlongThePathAreNotLost) {
  const OdeModel model = parse_ode("dx/dt = x - x^3", "test");
  const Dataset run = record_of(model, Dopri87{}, Vector{{0.05}}, 0.1, 60);
  PredictedRecord record{run.trajectories[0], Matrix::Constant(60, 1, 1e-3), {}};
  record.path = record.samples.states;
  for (const Index i : {5, 25, 45}) record.path(i, 0) = 1e160;  // its cube is no number
  const WindowResiduals once = predict(model, record, 20, 1);
  EXPECT_EQ(once.windows, 3);
  EXPECT_EQ(once.lost, 0);
  EXPECT_EQ(once.unstarted, 3);
  EXPECT_EQ(once.freedom[0], 0.0);
  // The next pass begins at the run.
  const WindowResiduals again = predict(model, record, 20, 2);
  EXPECT_EQ(again.lost + again.unstarted, 0);
  EXPECT_LT(std::sqrt(again.squares[0] / again.freedom[0]), 1e-5);
}

}  // namespace
}  // namespace lacuna
