// SPDX-License-Identifier: MIT
// Plants as benches record them: the position alone, rounded, inputs held from sample to
// sample.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/base/random.hpp"
#include "data/derivatives/finite_differences.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/identify/journey/identify_records.hpp"
#include "lacuna/records/binding/embedding.hpp"
#include "support/one_record.hpp"

namespace lacuna {
namespace {

using ::testing::HasSubstr;
using ::testing::UnorderedElementsAre;

constexpr int kFine = 50;  // steps of the simulation in a sample

/// A plant of second order, its acceleration a(x, v, u), behind an encoder.
struct Bench {
  std::function<double(double, double, double)> acceleration;
  Index late = 0;  ///< samples
  double step = 0.01, lattice = 1e-4, x = 0.0, v = 0.0;
  /// The input at a sample, of the position that was read.
  std::function<double(Index, double)> input = nullptr;
  Index samples = 2000;
};

Dataset record_of(const Bench& bench) {
  Trajectory record;
  record.time = Vector::LinSpaced(bench.samples, 0.0,
                                  bench.step * static_cast<double>(bench.samples - 1));
  record.states.resize(bench.samples, 1);
  record.inputs.resize(bench.samples, bench.input ? 1 : 0);
  double x = bench.x, v = bench.v;
  const double h = bench.step / kFine;
  for (Index i = 0; i < bench.samples; ++i) {
    const double seen = bench.lattice * std::round(x / bench.lattice);
    record.states(i, 0) = seen;
    if (bench.input) record.inputs(i, 0) = bench.input(i, seen);
    const double u = bench.input ? record.inputs(std::max<Index>(i - bench.late, 0), 0) : 0.0;
    for (int s = 0; s < kFine; ++s) {  // the midpoint rule
      const double half = v + 0.5 * h * bench.acceleration(x, v, u);
      const double middle = x + 0.5 * h * v;
      v += h * bench.acceleration(middle, half, u);
      x += h * half;
    }
  }
  Dataset data;
  data.states = {{"x", ""}};
  if (bench.input) data.inputs = {{"u", "", Hold::Zero}};
  data.trajectories = {record};
  data.rate_of = {std::nullopt};
  return embed(data, {{"x", 2}}, FiniteDifferences{});
}

/// Levels that change every so many samples.
std::function<double(Index, double)> levels(Index length, std::uint64_t seed) {
  std::vector<double> values;
  Random random(seed);
  for (int i = 0; i < 1000; ++i) values.push_back(0.1 * std::round(20.0 * random.normal()));
  return [=](Index i, double) { return values[static_cast<std::size_t>(i / length) % 1000]; };
}

std::vector<std::string> terms_of(const OdeModel& model, Index equation) {
  std::vector<std::string> terms;
  for (const WeightedTerm& summand : model.equations()[static_cast<std::size_t>(equation)])
    terms.push_back(summand.term.name());
  return terms;
}

TEST(Plants, AnInputThatActsLateIsWrittenAsADelay) {
  const Dataset data = record_of({[](double, double v, double u) { return -3.0 * v + 8.0 * u; },
                                  3, 0.01, 2e-4, 0.0, 0.0, levels(40, 7)});
  const Identification found = identify_records(data);
  const IdentificationResult& result = found.result;
  ASSERT_EQ(result.dead_times.size(), 1u);
  EXPECT_EQ(result.dead_times[0].input, "u");
  EXPECT_NEAR(result.dead_times[0].time, 0.03, 2e-4);
  ASSERT_EQ(result.model.equations()[1].size(), 2u) << to_text(result.model, 5);
  for (const WeightedTerm& summand : result.model.equations()[1])
    EXPECT_NEAR(summand.coefficient, summand.term.name() == "x_d1" ? -3.0 : 8.0, 0.02)
        << summand.term.name();
  EXPECT_THAT(terms_of(result.model, 1),
              ::testing::Contains(::testing::StartsWith("delay(u,")));
  EXPECT_EQ(result.validation->verdict, ValidationVerdict::FitsToNoise);
  EXPECT_EQ(found.records.in_memory()->samples(), data.samples());
}

TEST(Plants, AnInputThatActsAtOnceHasNoDeadTime) {
  const Dataset data = record_of({[](double, double v, double u) { return -3.0 * v + 8.0 * u; },
                                  0, 0.01, 2e-4, 0.0, 0.0, levels(40, 8)});
  const IdentificationResult result = identify_records(data).result;
  EXPECT_TRUE(result.dead_times.empty());
  EXPECT_THAT(terms_of(result.model, 1), UnorderedElementsAre("x_d1", "u"));
}

/// Of two inputs one acts late and is said to act later than that: what is given stays.
TEST(Plants, ADeadTimeThatIsGivenStaysBesideOnesThatAreSought) {
  Bench bench{[](double, double v, double u) { return -3.0 * v + 8.0 * u; },
              2,
              0.01,
              2e-4,
              0.0,
              0.0,
              levels(40, 12)};
  Dataset data = record_of(bench);
  data.inputs.push_back({"idle", "", Hold::Zero});
  Trajectory& record = data.trajectories[0];
  record.inputs.conservativeResize(Eigen::NoChange, 2);
  for (Index i = 0; i < record.samples(); ++i) record.inputs(i, 1) = levels(30, 13)(i, 0.0);
  IdentificationTask task;
  task.options.dead_time.given = {{"u", 0.05}};
  const IdentificationResult result = identify_records(data, task).result;
  ASSERT_FALSE(result.dead_times.empty());
  EXPECT_EQ(result.dead_times[0].input, "u");
  EXPECT_EQ(result.dead_times[0].time, 0.05);
}

TEST(Plants, ADeadTimeThatIsGivenIsTaken) {
  const Dataset data = record_of({[](double, double v, double u) { return -3.0 * v + 8.0 * u; },
                                  2, 0.01, 2e-4, 0.0, 0.0, levels(40, 9)});
  IdentificationTask task;
  task.options.effort = Thoroughness::Quick;
  task.options.dead_time.given = {{"u", 0.02}};
  const IdentificationResult result = identify_records(data, task).result;
  EXPECT_THAT(terms_of(result.model, 1), UnorderedElementsAre("x_d1", "delay(u,0.02)"));
  EXPECT_FALSE(result.dead_times.at(0).standard_error);
  task.options.dead_time.given = {{"w", 0.02}};
  EXPECT_THROW(identify_records(data, task), ConfigError);
}

/// Under feedback from rest, with a dead time and dry friction at once: nothing of these is in
/// the library.
TEST(Plants, DryFrictionAndADeadTimeUnderFeedbackAreFoundByFreeRuns) {
  const auto target = levels(120, 11);
  const Dataset data = record_of(
      {[](double, double v, double u) {
         return -4.0 * v + 6.0 * u - 0.5 * std::tanh(v / 0.01);
       },
       2, 0.01, 1e-4, 0.0, 0.0,
       [&](Index i, double seen) {
         return i < 100 ? 0.0 : 0.01 * std::round(400.0 * (0.1 * target(i, 0.0) - seen));
       }});
  const IdentificationResult result = identify_records(data).result;
  ASSERT_EQ(result.dead_times.size(), 1u) << to_text(result.model, 5);
  EXPECT_NEAR(result.dead_times[0].time, 0.02, 0.003);
  ASSERT_EQ(result.model.equations()[1].size(), 3u) << to_text(result.model, 5);
  for (const WeightedTerm& summand : result.model.equations()[1]) {
    const std::string& name = summand.term.name();
    const double truth = name == "x_d1" ? -4.0 : name.starts_with("tanh(x_d1/") ? -0.5 : 6.0;
    EXPECT_NEAR(summand.coefficient, truth, 0.03 * std::abs(truth)) << name;
  }
}

TEST(Plants, LightDampingOfAPendulumIsFoundByFreeRuns) {
  const Dataset data =
      record_of({[](double x, double v, double) { return -14.0 * std::sin(x) - 0.15 * v; }, 0,
                 0.01, 2.0 * M_PI / 512, 2.0, 0.0, nullptr, 2500});
  const IdentificationResult result = identify_records(data).result;
  EXPECT_THAT(terms_of(result.model, 1), UnorderedElementsAre("sin(x)", "x_d1"));
  EXPECT_NEAR(result.model.coefficient(1, "x_d1"), -0.15, 2e-3);
  EXPECT_EQ(result.validation->verdict, ValidationVerdict::FitsToNoise);
}

/// dT/dt = (0.7 Q - (T - 20)) / 60 behind noise, Q acts late, solved exactly.
Dataset heater(Index late, const std::function<double(Index)>& input) {
  constexpr Index kSamples = 900;
  Random random(2);
  Trajectory record;
  record.time = Vector::LinSpaced(kSamples, 0.0, kSamples - 1.0);
  record.states.resize(kSamples, 1);
  record.inputs.resize(kSamples, 1);
  double rise = 0.0;
  for (Index i = 0; i < kSamples; ++i) {
    record.states(i, 0) = 20.0 + rise + 0.05 * random.normal();
    record.inputs(i, 0) = input(i);
    const double level = 0.7 * (i < late ? input(0) : input(i - late));
    rise = level + (rise - level) * std::exp(-1.0 / 60.0);
  }
  return support::one_record({{"T", "degC"}}, {{"Q", "%", Hold::Zero}}, record);
}

TEST(Plants, AtASingleStepTheLinearLawIsTaken) {
  const IdentificationResult result =
      identify_records(heater(8, [](Index i) { return i < 150 ? 0.0 : 50.0; })).result;
  ASSERT_EQ(result.dead_times.size(), 1u);
  EXPECT_NEAR(result.dead_times[0].time, 8.0, 0.5);
  ASSERT_EQ(result.model.equations()[0].size(), 3u) << to_text(result.model, 5);
  EXPECT_NEAR(result.model.coefficient(0, "T"), -1.0 / 60.0, 2e-4);
  EXPECT_NEAR(result.model.coefficient(0, "1"), 20.0 / 60.0, 6e-3);
  EXPECT_THAT(result.warnings, ::testing::Contains(HasSubstr("cannot be distinguished from")));
}

/// The same plant by a clock that is late by up to a tenth of a step.
TEST(Plants, UnevenStepsHideNoDeadTime) {
  Dataset data = heater(5, [](Index i) { return i / 60 % 2 == 0 ? 10.0 : 60.0; });
  Trajectory& record = data.trajectories[0];
  for (Index i = 0; i < record.samples(); ++i)
    record.time[i] += 0.05 * std::sin(0.7 * static_cast<double>(i * i));
  const IdentificationResult result = identify_records(data).result;
  ASSERT_EQ(result.dead_times.size(), 1u) << to_text(result.model, 5);
  EXPECT_NEAR(result.dead_times[0].time, 5.0, 0.5);
  EXPECT_NEAR(result.model.coefficient(0, "T"), -1.0 / 60.0, 5e-4);
}

/// A -> B -> C at 0.5 and 0.2 per minute from 9, in closed form.
TEST(Plants, FewSamplesGetASmallLibrary) {
  constexpr Index kSamples = 16;
  Random random(3);
  Trajectory record;
  record.time = Vector::LinSpaced(kSamples, 0.0, 15.0);
  record.states.resize(kSamples, 3);
  record.inputs.resize(kSamples, 0);
  for (Index i = 0; i < kSamples; ++i) {
    const double t = record.time[i], a = 9.0 * std::exp(-0.5 * t);
    const double b = 9.0 * 0.5 / 0.3 * (std::exp(-0.2 * t) - std::exp(-0.5 * t));
    record.states.row(i) << a, b, 9.0 - a - b;
  }
  for (double& value : record.states.reshaped()) value += 0.01 * random.normal();
  Dataset data;
  data.states = {{"A", ""}, {"B", ""}, {"C", ""}};
  data.trajectories = {record};
  const IdentificationResult result = identify_records(data).result;
  EXPECT_THAT(terms_of(result.model, 0), UnorderedElementsAre("A"));
  EXPECT_THAT(terms_of(result.model, 1), UnorderedElementsAre("A", "B"));
  EXPECT_THAT(terms_of(result.model, 2), UnorderedElementsAre("B"));
  EXPECT_THAT(result.warnings,
              ::testing::Contains(HasSubstr("16 samples do not determine 20 candidate terms")));
}

}  // namespace
}  // namespace lacuna
