// SPDX-License-Identifier: MIT
// Predictions of what a model has not seen.
#include "identify/validation/held_blocks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/base/random.hpp"
#include "dynamics/integration/runge_kutta.hpp"
#include "identify/validation/map_predictions.hpp"
#include "identify/validation/predicted_records.hpp"
#include "identify/validation/prediction_windows.hpp"
#include "identify/validation/refit.hpp"
#include "identify/validation/validate.hpp"
#include "lacuna/cli/configuration/configuration.hpp"
#include "lacuna/data/records/marks.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/identify/pipeline/presets.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "support/maps.hpp"

namespace lacuna {
namespace {

// Blocks and windows of a record that are predicted by what the others determine.
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
  const Dataset samples = without_blocks(counted({10}), {{0, 1, 3}, {0, 5, 5}}, 1);
  EXPECT_TRUE(samples.trajectories.empty()) << "one sample is no stretch";
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

TEST(PredictionWindows, WhatAModelLacksIsInTheError) {
  const PredictedRecord record = turning(2000, 0.05, 1e-6, 2);
  const OdeModel damped = oscillator().with_term(1, {Term::parse("v", {{"x", "v"}, {}}), -0.1});
  const WindowResiduals found = predict(damped, record, 2, 1);
  // One step is off by 0.1 v h in v, of which each sample takes half.
  const double expected = 0.5 * std::pow(0.1 * 0.05, 2.0) * 0.5 * 1000.0;
  EXPECT_NEAR(found.squares[1], expected, 0.05 * expected);
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

using namespace lacuna::testing;

OdeModel logistic_model() { return parse_ode("x[n+1] = 3.9*x - 3.9*x^2\n", "test"); }

std::vector<Block> whole(const Dataset& data) { return all_blocks(data); }

Validation validated_map(const Dataset& data, const std::vector<std::string>& terms = {}) {
  Configuration configuration;
  configuration.set_discrete();
  if (!terms.empty()) {
    std::string list;
    for (const std::string& term : terms) list += (list.empty() ? "" : ",") + term;
    configuration.set_terms(list);
  }
  const Pipeline pipeline = configuration.build(default_registry());
  const IdentificationResult found = identify(data, pipeline);
  return validate({found, data, pipeline});
}

TEST(MapPredictions, AnExactModelLeavesNothing) {
  const Dataset data = orbit_of_map(logistic, Vector{{0.3}}, 400);
  const PredictionTest test = predict_map(logistic_model(), data, whole(data), 3);
  EXPECT_EQ(test.horizon, 3.0);
  EXPECT_EQ(test.windows, 397);
  EXPECT_EQ(test.lost, 0);
  ASSERT_EQ(test.states.size(), 1u);
  EXPECT_LT(test.states[0].error, 1e-12);
  EXPECT_TRUE(test.states[0].noise_estimated);
  EXPECT_NEAR(test.states[0].freedom, 397.0 / 3.0, 1e-9);
  const Vector x = data.trajectories[0].states.col(0).tail(397);
  EXPECT_NEAR(test.states[0].motion, std::sqrt((x.array() - x.mean()).square().mean()), 1e-9);
}

TEST(MapPredictions, NoiseIsThatOfTheDisturbance) {
  const Dataset data = orbit_of_map(henon, Vector{{0.1, 0.1}}, 3000, {.disturbance = 2e-3});
  const OdeModel model = parse_ode("x[n+1] = 1 + y - 1.4*x^2\ny[n+1] = 0.3*x\n", "test");
  const PredictionTest test = predict_map(model, data, whole(data), 1);
  ASSERT_FALSE(test.states.empty());
  for (const PredictionError& state : test.states) {
    EXPECT_NEAR(state.error, 2e-3, 2e-4);
    EXPECT_NEAR(state.noise, 2e-3, 2e-4);
    EXPECT_TRUE(state.noise_estimated);
  }
}

TEST(MapPredictions, NoiseIsNotSeenWhereNoNeighbourIsNear) {
  // Eight independent maps: a thousand points fill no space of eight dimensions.
  const auto eight = [](const Vector& x) {
    return Vector(3.9 * x.array() * (1.0 - x.array()));
  };
  const Dataset data = orbit_of_map(eight, Vector::LinSpaced(8, 0.11, 0.83), 1000);
  std::string text;
  for (const Quantity& state : data.states) text += state.name + "[n+1] = 0.5\n";
  const PredictionTest test = predict_map(parse_ode(text, "test"), data, whole(data), 1);
  ASSERT_EQ(test.states.size(), 8u);
  for (const PredictionError& state : test.states)
    EXPECT_FALSE(state.noise_estimated) << state.state;
}

TEST(MapPredictions, OrbitsWithoutABoundAreLost) {
  const Dataset data = orbit_of_map(logistic, Vector{{0.3}}, 100);
  const OdeModel wild = parse_ode("x[n+1] = exp(1000*x)\n", "test");
  const PredictionTest test = predict_map(wild, data, whole(data), 4);
  EXPECT_EQ(test.windows, 96);
  EXPECT_GT(2 * test.lost, test.windows);
}

TEST(MapPredictions, VerdictOfMaps) {
  for (const double disturbance : {0.0, 1e-3, 3e-3}) {
    const Dataset data =
        orbit_of_map(henon, Vector{{0.1, 0.1}}, 1000, {.disturbance = disturbance});
    const Validation right = validated_map(data);
    EXPECT_EQ(right.verdict, ValidationVerdict::FitsToNoise) << right.sentence;
    EXPECT_TRUE(right.refitted);
    EXPECT_EQ(right.time_unit, "steps");
    const Validation wrong = validated_map(data, {"1", "x", "y"});
    EXPECT_EQ(wrong.verdict, ValidationVerdict::WrongLibrary) << wrong.sentence;
  }
}

TEST(MapPredictions, NoiseOfTheMeasurementIsNotTakenForStructure) {
  for (const double noise : {1e-3, 5e-3, 2e-2}) {
    const Dataset data = orbit_of_map(henon, Vector{{0.1, 0.1}}, 2000, {.measured = noise});
    const Validation right = validated_map(data, {"1", "x", "y", "x^2"});
    EXPECT_TRUE(right.verdict == ValidationVerdict::FitsToNoise ||
                right.verdict == ValidationVerdict::Undecided)
        << noise << " " << right.sentence;
    const Validation wrong = validated_map(data, {"1", "x", "y"});
    EXPECT_EQ(wrong.verdict, ValidationVerdict::WrongLibrary) << wrong.sentence;
  }
}

TEST(MapPredictions, SlopesOfSeveralStepsAreAProduct) {
  // Two steps of 0.7 x: noise of sqrt(1 + 0.7^2), an offset of 0.245 (1 + 0.7), a slope of
  // 0.7^2.
  const auto map = [](const Vector& x) { return Vector{{0.7 * x[0]}}; };
  const Dataset data = orbit_of_map(map, Vector{{0.0}}, 4000, {.disturbance = 1.0, .seed = 3});
  const OdeModel off = parse_ode("x[n+1] = 0.7*x + 0.245\n", "test");
  ValidationOptions strict;
  strict.noise_slack = 0.0;
  strict.scatter = 0.0;
  const PredictionError state = predict_map(off, data, whole(data), 2, strict).states[0];
  EXPECT_FALSE(state.noise_estimated);
  EXPECT_NEAR(state.error, std::sqrt(1.49 + std::pow(0.245 * 1.7, 2)), 0.05);
  EXPECT_NEAR(state.noise, std::sqrt(1.49 * (1.0 + std::pow(0.7, 4))), 0.06);
}

TEST(MapPredictions, ACubicApproximatesASine) {
  const Dataset data =
      orbit_of_map([](const Vector& x) { return Vector{{0.95 * std::sin(3.14159 * x[0])}}; },
                   Vector{{0.3}}, 1000);
  const Validation cubic = validated_map(data, {"1", "x", "x^2", "x^3", "x^4"});
  EXPECT_EQ(cubic.verdict, ValidationVerdict::Approximation) << cubic.sentence;
  const Validation sine = validated_map(data, {"1", "sin(3.14159*x)"});
  EXPECT_EQ(sine.verdict, ValidationVerdict::FitsToNoise) << sine.sentence;
}

TEST(MapPredictions, OtherRecordsAreJudgedByTheModelAsItIs) {
  Configuration configuration;
  configuration.set_discrete();
  const Pipeline pipeline = configuration.build(default_registry());
  const Dataset data = orbit_of_map(logistic, Vector{{0.3}}, 300);
  const IdentificationResult found = identify(data, pipeline);
  const auto slower = [](const Vector& x) { return Vector{{3.8 * x[0] * (1.0 - x[0])}}; };
  const Validation same =
      validate({found, data, pipeline, orbit_of_map(logistic, Vector{{0.6}}, 200)});
  const Validation other =
      validate({found, data, pipeline, orbit_of_map(slower, Vector{{0.6}}, 200)});
  EXPECT_EQ(same.verdict, ValidationVerdict::FitsToNoise) << same.sentence;
  EXPECT_TRUE(same.given);
  EXPECT_NE(other.verdict, ValidationVerdict::FitsToNoise) << other.sentence;
}

/// sin t with noise beside its derivative, which a bad differentiator made.
TEST(PredictedRecords, OnlyWhatWasMeasuredCountsAndPathsAreNearTheTruth) {
  constexpr Index kSamples = 2000;
  Random random(2);
  Dataset data;
  data.states = {{"q", ""}, {"q_d1", ""}};
  data.rate_of = {1, std::nullopt};
  data.reconstructed = {false, true};
  Trajectory& record = data.trajectories.emplace_back();
  record.time = Vector::LinSpaced(kSamples, 0.0, 40.0);
  record.states = Matrix::Constant(kSamples, 2, 50.0);
  record.inputs.resize(kSamples, 0);
  for (Index i = 0; i < kSamples; ++i)
    record.states(i, 0) = std::sin(record.time[i]) + 0.01 * random.normal();
  record.states(120, 0) += 1.0;
  set_mark(record, 150, 0, Mark::Missing);
  const PredictedRecords all = predicted_records(data, {{0, 100, 500}}, analyse_noise(data));
  ASSERT_EQ(all.records.size(), 1U);
  const PredictedRecord& one = all.records[0];
  EXPECT_TRUE(one.deviations.col(1).isZero(0.0));
  EXPECT_EQ(one.deviations(20, 0), 0.0) << "an outlier";
  EXPECT_EQ(one.deviations(50, 0), 0.0) << "missing";
  EXPECT_EQ((one.deviations.col(0).array() == 0.0).count(), 2);
  EXPECT_NEAR(all.sigma[0], 0.01, 0.0015);
  const auto t = one.samples.time.array();
  EXPECT_LT((one.path.col(0).array() - t.sin()).abs().maxCoeff(), 0.03);
  EXPECT_LT((one.path.col(1).array() - t.cos()).abs().maxCoeff(), 0.3);
}

TEST(HeldBlocks, ALongRecordIsThinnedToItsBeginningOrToPiecesOfAllOfIt) {
  Trajectory record;
  record.time = Vector::LinSpaced(1000, 0.0, 999.0);
  record.states = record.time;
  record.inputs.resize(1000, 0);
  Dataset data;
  data.states = {{"x", ""}};
  data.rate_of = {std::nullopt};
  data.trajectories = {record};
  const Dataset begin = thinned(data, 100), spread = thinned(data, 100, 4);
  ASSERT_EQ(begin.trajectories.size(), 1u);
  EXPECT_EQ(begin.trajectories[0].time[99], 99.0);
  ASSERT_EQ(spread.trajectories.size(), 4u);
  EXPECT_EQ(spread.samples(), 100);
  EXPECT_EQ(spread.trajectories[0].time[0], 0.0);
  EXPECT_EQ(spread.trajectories[3].time[0], 750.0);
  EXPECT_EQ(thinned(data, 1000, 4).trajectories.size(), 1u);
}

}  // namespace
}  // namespace lacuna
