// SPDX-License-Identifier: MIT
// Models and records that hold next to nothing: each gets a finite answer or an error that says
// why, through every journey.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/base/random.hpp"
#include "data/derivatives/finite_differences.hpp"
#include "dynamics/integration/runge_kutta.hpp"
#include "effects/families.hpp"
#include "identify/forms_beside/identify_with_forms.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/records/marks.hpp"
#include "lacuna/diagnose/diagnose.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/dynamics/integration/synchroniser.hpp"
#include "lacuna/identify/pipeline/presets.hpp"
#include "lacuna/model/export/export_model.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/records/binding/model_view.hpp"
#include "lacuna/trajectories/fit/fit.hpp"
#include "support/expect_error.hpp"

namespace lacuna {
namespace {

/// Whether a call gives an answer; false where it refuses by an error of the library. Any other
/// exception, or a crash, is a failure of the test.
template <class Call>
bool answers(const Call& call) {
  try {
    call();
    return true;
  } catch (const Error& refusal) {
    EXPECT_FALSE(refusal.problem().empty());
    EXPECT_EQ(refusal.problem().find("number nan"), std::string::npos) << refusal.what();
    return false;
  }
}

void expect_finite(const OdeModel& model) {
  for (const Equation& equation : model.equations())
    for (const WeightedTerm& summand : equation)
      EXPECT_TRUE(std::isfinite(summand.coefficient)) << summand.term.name();
}

DiagnosisOptions few_effects() {
  DiagnosisOptions options;
  options.effects = {FamilyEffect<kConstantOffset>{}, FamilyEffect<kLinearTerm>{},
                     FamilyEffect<kDelay>{}, FamilyEffect<kLag>{}};
  return options;
}

/// dx/dt = -x + u, dy/dt = x - y with noise; samples from 0 on.
Dataset two_stages(Index samples, double noise, std::uint64_t seed) {
  Random random(seed);
  Dataset data{"s", {{"x", ""}, {"y", ""}}, {{"u", ""}}, {}, {}};
  Trajectory record{"made", Vector::LinSpaced(samples, 0.0, 0.05 * double(samples - 1)),
                    Matrix(samples, 2), Matrix(samples, 1), Matrix()};
  if (samples == 1) record.time[0] = 0.0;
  double x = 0.2, y = 0.0;
  for (Index i = 0; i < samples; ++i) {
    const double u = std::sin(0.07 * double(i)) + (i / 40 % 2 == 0 ? 0.5 : -0.5);
    record.inputs(i, 0) = u;
    record.states.row(i) << x + noise * random.normal(), y + noise * random.normal();
    for (int part = 0; part < 10; ++part) {
      constexpr double kStep = 0.005;
      const double of_x = u - x, of_y = x - y;
      x += kStep * of_x - 0.5 * kStep * kStep * of_x;
      y += kStep * of_y + 0.5 * kStep * kStep * (of_x - of_y);
    }
  }
  data.trajectories = {record};
  return data;
}

const char* const kModels[] = {
    "input u\nstate x\nstate y\ndx/dt = 0\ndy/dt = 0\n",            // empty
    "input u\nstate x\nstate y\ndx/dt = -x + u\ndy/dt = 0\n",       // one of them
    "input u\nstate x\nstate y\ndx/dt = -x + u\ndy/dt = -x + u\n",  // repeated
    "input u\nstate x\nstate y\ndx/dt = 1\ndy/dt = -2\n",           // constant
    "input u\nstate x\nstate y\ndx/dt = y\ndy/dt = x\n",            // identities
    "input u\nstate x\nstate y\nstate b\ndx/dt = -x + u + b\ndy/dt = x - y\ndb/dt = 0\n",
    "input u\nstate x\nstate y\ndx/dt = -x + delay(u, 0.3)\ndy/dt = x - y\n",
};

TEST(DegenerateRecords, EquationsThatAreEmptyRepeatedOrConstantGoThroughEveryJourney) {
  const Dataset data = two_stages(240, 0.01, 3), other = two_stages(240, 0.01, 4);
  for (const char* text : kModels) {
    SCOPED_TRACE(text);
    const SystemModel system = parse_ode_system(text, "made");
    const OdeModel model = parse_ode(text, "made");
    const auto view = [&](const Dataset& records) {
      return model_view(model, records, FiniteDifferences{});
    };
    EXPECT_TRUE(answers([&] {
      const Diagnosis found =
          diagnose(model, view(data), view(other), few_effects(), RunContext{});
      expect_finite(found.augmented);
    }));
    answers([&] { expect_finite(fit(system, view(data), view(other)).model.model()); });
    answers([&] { EXPECT_GE(synchronise(model, view(data), Rk4{}).mean, 0.0); });
    Solution run;
    const auto still = [](double, double* u) { *u = 0.5; };
    EXPECT_TRUE(answers([&] {
      run = simulate({model, still}, Dopri5{}, Vector::Constant(model.dimension(), 0.1),
                     sample_times(0.0, 0.05, 50));
    }));
    for (const std::string& format : export_formats())
      answers([&] { EXPECT_FALSE(export_model(model, format).empty()); });
  }
}

/// The verdict on a record, with its own last quarter held out.
Diagnosis answer_to(const char* text, const Dataset& data) {
  const OdeModel model = parse_ode(text, "made");
  return diagnose(model, model_view(model, data, FiniteDifferences{}), {}, few_effects(),
                  RunContext{});
}

TEST(DegenerateRecords, AConstantHiddenBiasIsEstimated) {
  Dataset data = two_stages(800, 0.01, 5);
  for (Trajectory& record : data.trajectories) record.inputs.array() -= 0.4;
  const Diagnosis found = answer_to(kModels[5], data);
  EXPECT_EQ(found.verdict, Verdict::NoDiscrepancy) << "u is 0.4 more than it says: that is b";
  EXPECT_TRUE(found.effects.empty());
}

TEST(DegenerateRecords, ADelayOfTheModelIsTakenAsItIs) {
  Dataset data = two_stages(800, 0.01, 6);
  // The input as it was recorded before it came: 6 steps of 0.05 s.
  Trajectory& record = data.trajectories[0];
  const Vector u = record.inputs.col(0);
  record.inputs.col(0).head(794) = u.tail(794);
  const Diagnosis complete = answer_to(kModels[6], data);
  EXPECT_EQ(complete.verdict, Verdict::NoDiscrepancy);
  const Diagnosis without =
      answer_to("input u\nstate x\nstate y\ndx/dt = -x + u\ndy/dt = x - y\n", data);
  ASSERT_FALSE(without.effects.empty());
  EXPECT_EQ(without.effects[0].name, "delay");
  const OdeModel& augmented = without.augmented;
  const Diagnosis again = diagnose(augmented, model_view(augmented, data, FiniteDifferences{}),
                                   {}, few_effects(), RunContext{});
  EXPECT_EQ(again.verdict, Verdict::NoDiscrepancy) << "its own augmented model";
}

TEST(DegenerateRecords, AChannelThatNeverMovesIsNoReasonToRefuse) {
  const char* const text = kModels[1];
  for (const double value : {0.0, 0.1, 1e6}) {
    Dataset data = two_stages(400, 0.01, 7);
    data.trajectories[0].states.col(1).setConstant(value);
    const Diagnosis found = answer_to(text, data);
    EXPECT_TRUE(found.effects.empty()) << value;
    ASSERT_TRUE(found.gap.has_value()) << value;
    EXPECT_TRUE(std::isfinite(found.gap->before)) << value;
    const OdeModel model = parse_ode(text, "made");
    const Fit fitted =
        fit(parse_ode_system(text, "made"), model_view(model, data, FiniteDifferences{}), {});
    for (const FitQuality& quality : fitted.quality)
      EXPECT_TRUE(std::isfinite(quality.prediction)) << value << " " << quality.channel;
  }
}

/// What is done to the samples of a record, drawn at random.
void spoil(Random& random, Dataset& data) {
  Matrix& states = data.trajectories[0].states;
  const Index n = states.rows();
  const auto draw = [&](double below) { return static_cast<int>(random.uniform(0.0, below)); };
  const Index column = draw(2.0);
  switch (draw(7.0)) {
    case 0:
      states.col(column).setConstant(random.normal());
      break;
    case 1:
      states.col(column) *= std::pow(10.0, random.uniform(-200.0, 200.0));
      break;
    case 2:
      states.col(column).array() += std::pow(10.0, random.uniform(0.0, 12.0));
      break;
    case 3:
      states.col(1) = states.col(0);
      break;
    case 4:
      states.col(column) = states.col(column).array().round();
      break;
    case 5:
      data.trajectories[0].inputs.setZero();
      break;
    case 6:
      states(n / 2, column) += 1e3;
      break;
    default:
      break;
  }
  if (n < 4 || draw(3.0) != 0) return;
  Matrix marks = Matrix::Zero(n, 2);
  marks.col(draw(2.0)).segment(n / 4, n / 2).setConstant(number_of(Mark::Missing));
  data.trajectories[0].marks = marks;
}

TEST(DegenerateRecords, WhateverIsDrawnGetsAnAnswerOrARefusal) {
  constexpr int kDraws = 40;
  int answered = 0;
  for (int draw = 0; draw < kDraws; ++draw) {
    Random random(static_cast<std::uint64_t>(draw) + 1);
    const Index samples = draw % 3 == 0 ? 1 + draw / 3 : 40 + draw;
    Dataset data = two_stages(samples, draw % 2 == 0 ? 0.0 : 0.02, 9);
    spoil(random, data);
    const char* const text = kModels[static_cast<std::size_t>(draw) % std::size(kModels)];
    SCOPED_TRACE(std::to_string(draw) + "\n" + text);
    const OdeModel model = parse_ode(text, "made");
    answered += answers([&] { expect_finite(answer_to(text, data).augmented); });
    answered += answers([&] {
      expect_finite(fit(parse_ode_system(text, "made"),
                        model_view(model, data, FiniteDifferences{}), {}, {.restarts = 1})
                        .model.model());
    });
    answered += answers([&] {
      const Pipeline pipeline = preset(draw % 2 == 0 ? "algorithm1" : "robust");
      expect_finite(identify_with_forms(data, pipeline, few_effects().effects).model);
    });
  }
  EXPECT_GT(answered, kDraws) << "most of them hold something";
}

TEST(DegenerateRecords, ALastQuarterWithoutMotionIsSaid) {
  Dataset data = two_stages(400, 0.0, 8);
  data.trajectories[0].states.bottomRows(120).rowwise() =
      data.trajectories[0].states.row(279).eval();
  const Diagnosis found = answer_to(kModels[4], data);
  EXPECT_FALSE(found.gap.has_value());
  EXPECT_THAT(found.notes, ::testing::Contains(::testing::HasSubstr("last quarter")));
}

TEST(DegenerateRecords, ADelayLongerThanHalfOfARecordIsRefused) {
  const char* const late = "input u\nstate x\nstate y\ndx/dt = -x + delay(u, 9)\ndy/dt = x\n";
  testing::expect_error<DataError>([&] { answer_to(late, two_stages(400, 0.01, 8)); }, "made",
                                   "a delay of 9", "longer records");
}

}  // namespace
}  // namespace lacuna
