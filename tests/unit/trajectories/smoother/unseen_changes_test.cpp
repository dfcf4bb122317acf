// SPDX-License-Identifier: MIT
#include "trajectories/smoother/unseen_changes.hpp"

#include <gtest/gtest.h>

#include "lacuna/model/files/ode_text.hpp"

namespace lacuna {
namespace {

/// Records with states that are no functions of each other.
Dataset records_of(const OdeModel& model) {
  Dataset data;
  data.states = model.states();
  data.inputs = model.inputs();
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
  data.trajectories = {record};
  return data;
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

TEST(UnseenChanges, AnEffectOfAPowerKeepsTheScaleUnseen) {
  // With c2 = s y the term a c2^2 is a s y^2: its coefficient makes up for the scale.
  EXPECT_EQ(unseen_with(" - 0.2*c2^2", {{{1, parse_expression("c2^2")}}}).coefficients.cols(),
            1);
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

TEST(UnseenChanges, AFixedOrKnownCoefficientGivesTheScale) {
  EXPECT_EQ(unseen_of(kCompartments, {false, true}, {{{0, 1}, 0.3, 0.01}}).coefficients.cols(),
            0);
}

TEST(UnseenChanges, AnOffsetOfAHiddenStateIsOne) {
  const UnseenChanges unseen =
      unseen_of("input u\ndx/dt = z - x + 0.2\ndz/dt = u - 0.5*z + 0.4\n", {false, true});
  // Scale and offset of z.
  EXPECT_EQ(unseen.coefficients.cols(), 2);
}

TEST(UnseenChanges, AStateOnWhichNothingDependsIsUnseen) {
  const UnseenChanges unseen =
      unseen_of("input u\ndx/dt = -x + u\ndz/dt = x - 0.5*z\n", {false, true});
  EXPECT_TRUE(unseen.unseen_states[1]);
  EXPECT_FALSE(unseen.unseen_states[0]);
}

TEST(UnseenChanges, ANonlinearFunctionGivesTheScale) {
  EXPECT_EQ(unseen_of("dx/dt = sin(z) - x\ndz/dt = 0.3*x - 0.2*z\n", {false, true})
                .coefficients.cols(),
            0);
}

}  // namespace
}  // namespace lacuna
