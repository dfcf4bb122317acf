// SPDX-License-Identifier: MIT
// Models with time scales far apart, fitted to records that no explicit steps can follow.
#include <gtest/gtest.h>

#include <cmath>

#include "lacuna/data/derivatives/finite_differences.hpp"
#include "lacuna/records/binding/model_view.hpp"
#include "lacuna/trajectories/fit/fit.hpp"
#include "support/stiff_models.hpp"

namespace lacuna {
namespace {

/// Fits a record from parameters that are off by a factor, in turn up and down.
Fit fitted(const support::StiffRecord& record, double factor) {
  const SystemModel truth = parse_ode_system(record.text, "stiff");
  std::vector<Parameter> parameters = truth.parameters();
  for (std::size_t i = 0; i < parameters.size(); ++i)
    parameters[i].value *= i % 2 == 0 ? factor : 1.0 / factor;
  const Dataset view = model_view(truth.model(), record.data, FiniteDifferences{});
  return fit({truth.symbolic(), parameters}, view, {});
}

void expect_parameters(const Fit& found, const support::StiffRecord& record, double most) {
  EXPECT_TRUE(found.converged);
  EXPECT_EQ(found.substeps, 0) << "implicit steps";
  const SystemModel truth = parse_ode_system(record.text, "stiff");
  ASSERT_FALSE(truth.parameters().empty());
  for (std::size_t i = 0; i < truth.parameters().size(); ++i) {
    const double value = truth.parameters()[i].value;
    EXPECT_NEAR(found.model.parameters()[i].value, value, most * value)
        << truth.parameters()[i].name;
    ASSERT_TRUE(found.model.parameters()[i].standard_error);
    EXPECT_LT(std::abs(found.model.parameters()[i].value - value),
              4.0 * *found.model.parameters()[i].standard_error)
        << truth.parameters()[i].name;
  }
}

TEST(StiffFit, RobertsonsReactionsTo1e5Seconds) {
  if (!Cvode::unavailable().empty()) return;
  const support::StiffRecord record = support::robertson_record(0.01);
  expect_parameters(fitted(record, 1.5), record, 0.05);
}

TEST(StiffFit, VanDerPolsOscillationThatJumpsInMilliseconds) {
  if (!Cvode::unavailable().empty()) return;
  support::StiffRecord record = support::van_der_pol_record(0.01);
  record.text += "y = x\n";
  Dataset& data = record.data;
  data.states = {{"y", ""}};
  data.trajectories.front().states = data.trajectories.front().states.leftCols(1).eval();
  expect_parameters(fitted(record, 1.05), record, 0.01);
}

TEST(StiffFit, AGateWithNanosecondsAndMilliseconds) {
  const support::StiffRecord record = support::gate(0.01, support::gate_text(), 2);
  const Fit found = fitted(record, 1.5);
  EXPECT_TRUE(found.converged);
  EXPECT_EQ(found.substeps, 0);
  const Parameter& slow = found.model.parameters()[1];
  EXPECT_NEAR(slow.value, 1000.0, 10.0);
  ASSERT_TRUE(slow.standard_error);
  // Samples of 10 us do not show a time of 5 ns, only that it is short: the likelihood of the
  // rate is flat upwards. (Not of the noise of seed 1: there chi squared is 6 higher at any
  // large rate than at 3.4e6.)
  const Parameter& fast = found.model.parameters()[0];
  EXPECT_FALSE(fast.standard_error) << fast.value;
  EXPECT_FALSE(fast.ci95);
  EXPECT_GT(fast.value, 1e5) << "ten samples in its time";
  EXPECT_FALSE(found.numbers[0].at_most);
  const FitStanding standing = standing_of(found);
  EXPECT_EQ(standing.open.size() + standing.at_ends.size(), 1u) << "is said";
}

}  // namespace
}  // namespace lacuna
