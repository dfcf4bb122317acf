// SPDX-License-Identifier: MIT
// Models with time scales far apart, fitted to records that no explicit steps can follow.
#include <gtest/gtest.h>

#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>

#include "lacuna/data/derivatives/finite_differences.hpp"
#include "lacuna/records/binding/model_view.hpp"
#include "lacuna/trajectories/fit/fit.hpp"
#include "support/stiff_models.hpp"

namespace lacuna {
namespace {

/// Fits a record from free parameters that are off by a factor, in turn up and down.
Fit fitted(const support::StiffRecord& record, double factor) {
  const SystemModel truth = parse_ode_system(record.text, "stiff");
  std::vector<Parameter> parameters = truth.parameters();
  for (std::size_t i = 0; i < parameters.size(); ++i)
    if (parameters[i].free) parameters[i].value *= i % 2 == 0 ? factor : 1.0 / factor;
  const Dataset view = model_view(truth.model(), record.data, FiniteDifferences{});
  return fit({truth.symbolic(), parameters}, view, {});
}

void expect_parameters(const Fit& found, const support::StiffRecord& record, double most) {
  EXPECT_TRUE(found.converged);
  EXPECT_EQ(found.substeps, 0) << "implicit steps";
  const SystemModel truth = parse_ode_system(record.text, "stiff");
  ASSERT_FALSE(truth.parameters().empty());
  for (std::size_t i = 0; i < truth.parameters().size(); ++i) {
    if (!truth.parameters()[i].free) continue;
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

/// 100 minutes of the chain of reactions, by the exponential of its matrix.
support::StiffRecord chain(double noise) {
  constexpr Index kLength = support::kChain;
  support::StiffRecord chain{support::chain_text(), {}};
  Matrix flow = Matrix::Zero(kLength, kLength);
  std::vector<Index> seen;
  for (Index i = 0; i < kLength; ++i) {
    flow(i, i) = -support::chain_rate(i);
    if (i > 0) flow(i, i - 1) = support::chain_rate(i - 1);
    if (!support::is_measured_in_chain(i)) continue;
    seen.push_back(i);
    chain.data.states.push_back({"y" + std::to_string(i), ""});
  }
  const Matrix minute = Matrix(60.0 * flow).exp();
  const Vector times = sample_times(0.0, 60.0, 101);
  Matrix states(times.size(), kLength);
  states.row(0) = Vector::Unit(kLength, 0).transpose();
  for (Index n = 1; n < times.size(); ++n)
    states.row(n) = states.row(n - 1) * minute.transpose();
  chain.data.trajectories = {
      {"chain", times, states(Eigen::all, seen), Matrix(times.size(), 0), Matrix()}};
  support::add_noise(noise, 1, chain.data);
  return chain;
}

TEST(StiffFit, AChainOfThirtyReactionsOverNineDecades) {
  expect_parameters(fitted(chain(0.05), 3.0), chain(0.05), 0.1);
}

}  // namespace
}  // namespace lacuna
