// SPDX-License-Identifier: MIT
// States that nobody measured, and what their changes leave open.
#include "trajectories/smoother/hidden_states.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "dynamics/integration/runge_kutta.hpp"
#include "lacuna/data/records/marks.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "support/driven_oscillator.hpp"
#include "support/one_record.hpp"
#include "trajectories/smoother/unknown_past.hpp"
#include "trajectories/smoother/unseen_changes.hpp"

namespace lacuna {
namespace {

/// x measured as sin(t), everything else hidden.
Dataset sine(const OdeModel& model) {
  Trajectory record;
  record.time = Vector::LinSpaced(401, 0.0, 20.0);
  record.states = Matrix::Zero(401, model.dimension());
  record.states.col(0) = record.time.array().sin();
  Dataset data = support::one_record(model.states(), {}, record);
  data.reconstructed.assign(model.states().size(), true);
  data.reconstructed[0] = false;
  return data;
}

Matrix path_of(const OdeModel& model, const Vector& start) {
  return record_of(model, Dopri87{}, start, 0.05, 401).trajectories.front().states;
}

/// The first state alone, with an error of so much.
Dataset observed_first(const OdeModel& model, const Vector& values, double error) {
  Dataset data = sine(model);
  for (Index i = 0; i < 401; ++i)
    data.trajectories.front().states(i, 0) =
        values[i] + error * std::sin(917.0 * std::pow(static_cast<double>(i), 2));
  return data;
}

TEST(HiddenStates, ADerivativeOfAMeasuredStateIsNone) {
  const OdeModel model = parse_ode("dx/dt = v\ndv/dt = -x - w\ndw/dt = v - w\n", "test");
  const std::vector<bool> expected{false, false, true};
  EXPECT_EQ(hidden_states(model, sine(model)), expected);
  const OdeModel known = parse_ode("dx/dt = v\ndv/dt = -x\n", "test");
  EXPECT_TRUE(hidden_states(known, sine(known)).empty());
}

TEST(HiddenStates, PathFollowsTheMeasuredStates) {
  const OdeModel model = parse_ode("dx/dt = cos(t)\ndz/dt = x - 0.5*z\n", "test");
  const Dataset data = with_hidden_paths(model, sine(model), {false, true}, Vector{{0.0, 2.0}});
  const Trajectory& record = data.trajectories.front();
  // dz/dt = sin t - z/2, z(0) = 2: the exact solution.
  for (const Index i : {0, 100, 400}) {
    const double t = record.time[i];
    const double exact = 2.8 * std::exp(-0.5 * t) + 0.4 * std::sin(t) - 0.8 * std::cos(t);
    EXPECT_NEAR(record.states(i, 1), exact, 2e-3) << t;
  }
  EXPECT_EQ(record.states(100, 0), std::sin(record.time[100])) << "measured values stay";
}

TEST(HiddenStates, SeveralAlsoBeginARangeApartTogether) {
  const OdeModel model = parse_ode("dx/dt = -x\ndz/dt = 1\ndw/dt = 2\n", "test");
  const std::vector<bool> hidden{false, true, true};
  const Dataset data = with_hidden_paths(model, sine(model), hidden, Vector::Zero(3));
  const auto begins = hidden_begins(data, hidden, Vector::Zero(3));
  ASSERT_EQ(begins.size(), 7u);
  EXPECT_TRUE(begins[5].isApprox(Vector{{0.0, 20.0, 40.0}}, 1e-9));
  EXPECT_TRUE(begins[6].isApprox(Vector{{0.0, -20.0, -40.0}}, 1e-9));
}

TEST(HiddenStates, LevelsOfWhichTheModelTakesRootsAreFound) {
  // Three tanks in a row, only the last level measured; no rate has a slope at an empty tank.
  const OdeModel truth = parse_ode(
      "dx/dt = 0.5*sqrt(w) - 0.4*sqrt(x)\n"
      "dz/dt = 0.4 + 0.2*sin(0.7*t) - 0.5*sqrt(z)\ndw/dt = 0.5*sqrt(z) - 0.5*sqrt(w)\n",
      "test");
  const Matrix exact = path_of(truth, Vector{{1.2, 0.8, 0.6}});
  const Dataset data = observed_first(truth, exact.col(0), 1e-4);
  AssimilationOptions options;
  options.hidden = {false, true, true};
  const Assimilation fit =
      assimilate_from_starts(truth, as_measured(data), options, RunContext{});
  ASSERT_TRUE(std::isfinite(fit.deviance));
  EXPECT_LT((fit.records.front().path - exact).cwiseAbs().maxCoeff(), 0.05);
}

TEST(HiddenStates, AMissingColumnIsNoMarkAnyMore) {
  const OdeModel model = parse_ode("dx/dt = -x\ndz/dt = x - z\n", "test");
  Dataset data = sine(model);
  data.trajectories.front().marks = Matrix::Zero(401, 2);
  data.trajectories.front().marks.col(1).setConstant(number_of(Mark::Missing));
  data = with_hidden_paths(model, std::move(data), {false, true}, Vector::Zero(2));
  EXPECT_TRUE(data.trajectories.front().marks.isZero(0.0));
}

TEST(HiddenStates, TheirPathAndCoefficientsAreFound) {
  // x' = -x + z, z' = 0.3 x - 0.5 z + cos(1.3 t), x measured.
  const OdeModel truth = parse_ode(
      "fixed dx/dt: z\nfixed dz/dt: x\nfixed dz/dt: cos(1.3*t)\ndx/dt = -x + z\n"
      "dz/dt = 0.3*x - 0.5*z + cos(1.3*t)\n",
      "test");
  const Matrix exact = path_of(truth, Vector{{0.2, 1.0}});
  const Dataset data = observed_first(truth, exact.col(0), 1e-3);
  AssimilationOptions options;
  options.hidden = {false, true};
  options.free = free_coefficients(truth);
  options.held_among = options.free.size();
  const OdeModel off = parse_ode(
      "fixed dx/dt: z\nfixed dz/dt: x\nfixed dz/dt: cos(1.3*t)\ndx/dt = -1.2*x + z\n"
      "dz/dt = 0.3*x - 0.6*z + cos(1.3*t)\n",
      "test");
  const Assimilation fit =
      assimilate_from_starts(off, as_measured(data), options, RunContext{});
  EXPECT_NEAR(fit.model.coefficient(0, "x"), -1.0, 0.02);
  EXPECT_NEAR(fit.model.coefficient(1, "z"), -0.5, 0.03);
  EXPECT_LT((fit.records.front().path.col(1) - exact.col(1)).cwiseAbs().maxCoeff(), 0.03);
}

constexpr const char* kLate =
    "input F\ndq/dt = v\ndv/dt = -4*q - 0.2*v + 3*delay(F, 1.5) + delay(q, 0.5)\n";

TEST(UnknownPast, IsAsLongAsTheLongestDelayOfAnEquation) {
  const Vector longest = longest_delays(parse_ode(kLate, "late"));
  EXPECT_EQ(longest[0], 0.0);
  EXPECT_EQ(longest[1], 1.5);
}

TEST(UnknownPast, MovesTheStateAsAValueAnywhereInTheRangeDoes) {
  const OdeModel late = parse_ode(kLate, "late");
  const Dataset data = support::oscillator_record();
  const LinearisedRecord record =
      grid_of(data.inputs, data.trajectories[0], data.trajectories[0].states);
  const Matrix density = unknown_past(late, record);
  ASSERT_EQ(density.rows(), 2);
  ASSERT_EQ(density.cols(), 1000);
  EXPECT_TRUE(density.row(0).isZero(0.0)) << "dq/dt = v has no past";
  const double of_force = 1.5 * 9.0 / 12.0, of_state = 0.5 * 4.0 / 12.0;
  EXPECT_NEAR(density(1, 0), of_force + of_state, 1e-3);
  EXPECT_NEAR(density(1, 60), of_force, 1e-3) << "q is known by 0.6 s";
  EXPECT_EQ(density(1, 151), 0.0) << "F is known by 1.5 s";
  EXPECT_EQ(unknown_past(support::oscillator(), record).size(), 0) << "no delays";
}

/// Records with states that are no functions of each other.
Dataset records_of(const OdeModel& model) {
  Trajectory record;
  const Index n = 300;
  record.time = Vector::LinSpaced(n, 0.0, 30.0);
  record.states.resize(n, model.dimension());
  record.inputs.resize(n, static_cast<Index>(model.inputs().size()));
  for (Index k = 0; k < model.dimension(); ++k)
    record.states.col(k) =
        1.5 + (record.time.array() * (1.0 + 0.37 * static_cast<double>(k))).sin();
  for (Index j = 0; j < record.inputs.cols(); ++j)
    record.inputs.col(j) = (record.time.array() * (0.31 + 0.2 * static_cast<double>(j))).cos();
  return support::one_record(model.states(), model.inputs(), record);
}

UnseenChanges unseen_of(const std::string& text, const std::vector<bool>& hidden,
                        const std::vector<CoefficientPrior>& known = {}) {
  const OdeModel model = parse_ode(text, "test");
  return unseen_changes(model, records_of(model), hidden,
                        {free_coefficients(model), known, {}});
}

const std::string kCompartments =
    "input d\ndc1/dt = -0.7*c1 + 0.3*c2 + 0.1*d\ndc2/dt = 0.5*c1 - 0.3*c2\n";

TEST(UnseenChanges, TheScaleOfAHiddenStateIsOne) {
  const UnseenChanges unseen = unseen_of(kCompartments, {false, true});
  ASSERT_EQ(unseen.coefficients.cols(), 1);
  // Free coefficients in order: c1, c2, d of dc1/dt; c1, c2 of dc2/dt.
  const Vector direction = unseen.coefficients.col(0) / unseen.coefficients(1, 0);
  EXPECT_NEAR(direction[0], 0.0, 1e-6);
  EXPECT_NEAR(direction[1], 1.0, 1e-6);
  EXPECT_NEAR(direction[2], 0.0, 1e-6);
  EXPECT_NEAR(direction[3], -1.0, 1e-6);
  EXPECT_NEAR(direction[4], 0.0, 1e-6);
  EXPECT_FALSE(unseen.unseen_states[1]);
}

/// kCompartments with an effect in dc2/dt, whose numbers are estimated as well.
UnseenChanges unseen_with(const std::string& effect, const std::vector<NumberChange>& numbers) {
  const OdeModel nominal = parse_ode(kCompartments, "test");
  const OdeModel model = parse_ode(
      "input d\ndc1/dt = -0.7*c1 + 0.3*c2 + 0.1*d\ndc2/dt = 0.5*c1 - 0.3*c2" + effect + "\n",
      "test");
  return unseen_changes(model, records_of(model), {false, true},
                        {free_coefficients(nominal), {}, numbers});
}

TEST(UnseenChanges, AreTheScaleAndTheOffsetUnlessANumberOrAFunctionGivesThem) {
  const auto directions = [](const std::string& text,
                             const std::vector<CoefficientPrior>& known = {}) {
    return unseen_of(text, {false, true}, known).coefficients.cols();
  };
  EXPECT_EQ(directions(kCompartments, {{{0, 1}, 0.3, 0.01}}), 0);
  EXPECT_EQ(directions("input u\ndx/dt = z - x + 0.2\ndz/dt = u - 0.5*z + 0.4\n"), 2);
  EXPECT_EQ(directions("dx/dt = sin(z) - x\ndz/dt = 0.3*x - 0.2*z\n"), 0);
  // With c2 = s y the term a c2^2 is a s y^2: its coefficient makes up for the scale.
  const UnseenChanges power = unseen_with(" - 0.2*c2^2", {{{1, parse_expression("c2^2")}}});
  EXPECT_EQ(power.coefficients.cols(), 1);
}

TEST(UnseenChanges, AnEdgeShowsTheScaleWhereItIsKnown) {
  const NumberChange coefficient{{1, parse_expression("max(c2-1.5,0)")}};
  const NumberChange edge{{1, parse_expression("-step(c2-1.5)")}};
  EXPECT_EQ(unseen_with(" - 0.2*max(c2-1.5,0)", {coefficient}).coefficients.cols(), 0);
  EXPECT_EQ(unseen_with(" - 0.2*max(c2-1.5,0)", {coefficient, edge}).coefficients.cols(), 1);
}

TEST(UnseenChanges, AnEffectShowsWhatMixesStates) {
  // z may have a scale and a fraction of x; a term in z^2 would become one in x z as well.
  const std::string linear = "input u\ndx/dt = 0.8*z - x\ndz/dt = 0.5*u + 0.4*x - 0.3*z";
  const OdeModel nominal = parse_ode(linear + "\n", "test");
  const OdeModel square = parse_ode(linear + " - 0.1*z^2\n", "test");
  const EstimatedNumbers numbers{free_coefficients(nominal)};
  EXPECT_EQ(
      unseen_changes(nominal, records_of(nominal), {false, true}, numbers).coefficients.cols(),
      2);
  const EstimatedNumbers more{numbers.free, {}, {{{1, parse_expression("z^2")}}}};
  EXPECT_EQ(unseen_changes(square, records_of(square), {false, true}, more).coefficients.cols(),
            1);
}

TEST(UnseenChanges, AStateOnWhichNothingDependsIsUnseen) {
  const UnseenChanges unseen =
      unseen_of("input u\ndx/dt = -x + u\ndz/dt = x - 0.5*z\n", {false, true});
  EXPECT_TRUE(unseen.unseen_states[1]);
  EXPECT_FALSE(unseen.unseen_states[0]);
}

}  // namespace
}  // namespace lacuna
