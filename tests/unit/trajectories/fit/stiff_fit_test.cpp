// SPDX-License-Identifier: MIT
// Starts of a fit that are no good, and models with time scales far apart.
#include <gtest/gtest.h>

#include <cmath>
#include <unsupported/Eigen/MatrixFunctions>

#include "data/derivatives/finite_differences.hpp"
#include "lacuna/records/binding/model_view.hpp"
#include "lacuna/trajectories/fit/fit.hpp"
#include "support/grey_box.hpp"
#include "support/stiff_models.hpp"

namespace lacuna {
namespace {

Dataset record_of(const std::string& truth, double start) {
  return support::grey_box(
      parse_ode(truth, "truth.ode"),
      {.start = Vector::Constant(1, start), .step = 0.2, .samples = 30, .noise = 0.02});
}

TEST(SearchFit, BeginsElsewhereWhereTheGivenRunIsNotFinite) {
  // dx/dt = g x^2 - x from 1 has no end where g < 1, and is infinite after ln(g/(g - 1)) else.
  const std::string equation = "dx/dt = g*x^2 - x\ny = x\ninitial x = 1 fixed\n";
  const SystemModel model =
      parse_ode_system("param g = 2000 in 1e-4..1e4\n" + equation, "m.ode");
  const Fit found = fit(model, record_of("dx/dt = 0.3*x^2 - x\ny = x\n", 1.0), {});
  EXPECT_NEAR(found.numbers[0].value, 0.3, 0.02);
}

TEST(SearchFit, ARangeThatIsNotWideIsNotLeft) {
  const SystemModel model = parse_ode_system(
      "param k = 3 in 2..5\ndx/dt = -k*x\ny = x\ninitial x = 2 fixed\n", "m.ode");
  const Fit found = fit(model, record_of("dx/dt = -0.5*x\ny = x\n", 2.0), {});
  EXPECT_EQ(found.numbers[0].value, 2.0);
  EXPECT_LE(found.starts, 11) << "the given ones and eight others";
}

/// Predators that are sated: prey grows 10 000 times, and noise hides what it begins with.
Dataset sated_predators(std::uint64_t seed) {
  return support::grey_box(
      parse_ode("dx/dt = 1.1*x - 0.5*x*z/(1+0.3*x)\n"
                "dz/dt = 0.3*x*z/(1+0.3*x) - 0.4*z\ny = x\nw = z\n",
                "truth.ode"),
      {.start = Vector{{3.0, 2.0}}, .step = 0.25, .samples = 40, .noise = 0.03, .seed = seed});
}

/// The fit with the seed of the record.
Fit fitted(const std::string& text, std::uint64_t seed) {
  RunContext context;
  context.seed = seed;
  return fit(parse_ode_system(text, "m.ode"), sated_predators(seed), {}, {}, context);
}

// One step for each sample meets the noise elsewhere than the model does, from the true
// numbers, with which the model itself leaves 127 and 1.59.
TEST(SearchFit, WhatOnlyLongStepsMakeOfAModelIsNoFit) {
  const Fit found = fitted(
      "param a = 1.1 in 0.01..20\nparam b = 0.5 in 0.01..20\nparam h = 0.3 in 0.001..20\n"
      "param c = 0.3 in 0.01..20\nparam d = 0.4 in 0.01..20\n"
      "dx/dt = a*x - b*x*z/(1+h*x)\ndz/dt = c*x*z/(1+h*x) - d*z\ny = x\nw = z\n",
      44);
  ASSERT_EQ(found.quality.size(), 2u);
  EXPECT_LT(found.quality[0].rmse, 130.0);
  EXPECT_LT(found.quality[1].rmse, 1.65);
}

// Models with time scales far apart, fitted to records that no explicit steps can follow.
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
