// SPDX-License-Identifier: MIT
// What must not matter with the default tolerances: units, time scale, repeated rows, the order
// of the variables. Structure stays, coefficients change by rounding only.
#include <cmath>

#include "lacuna/identify/pipeline/presets.hpp"
#include "unit/identify/pipeline/records.hpp"

namespace lacuna {
namespace {

using testing::rossler_record;

/// Records the properties are tried on: exact derivatives, sampled, noisy.
class Invariance : public ::testing::TestWithParam<int> {
 protected:
  Dataset record() const {
    const Dataset exact = rossler_record(3000);
    if (GetParam() == 0) return exact;
    if (GetParam() == 1) return testing::without_derivatives(exact);
    return add_relative_noise(exact, 0.002, 3);
  }
};

Dataset scaled(Dataset data, double state_scale, double time_scale) {
  for (Trajectory& trajectory : data.trajectories) {
    trajectory.time *= time_scale;
    trajectory.states *= state_scale;
    trajectory.derivatives *= state_scale / time_scale;
  }
  return data;
}

/// Degree of a monomial in the states.
int degree(const Term& term) {
  int sum = 0;
  const std::vector<int> exponents = *term.exponents();
  for (const int exponent : exponents) sum += exponent;
  return sum;
}

void expect_scaled_model(const OdeModel& found, const OdeModel& original, double state_scale,
                         double time_scale) {
  for (Index k = 0; k < original.dimension(); ++k) {
    const auto equation = static_cast<std::size_t>(k);
    ASSERT_EQ(found.equations()[equation].size(), original.equations()[equation].size())
        << to_text(found) << "\n"
        << to_text(original);
    for (const WeightedTerm& term : original.equations()[equation]) {
      const double expected =
          term.coefficient * std::pow(state_scale, 1.0 - degree(term.term)) / time_scale;
      EXPECT_NEAR(found.coefficient(k, term.term.name()), expected, 1e-7 * std::abs(expected))
          << term.term.name() << " in equation " << k;
    }
  }
}

TEST_P(Invariance, UnitsOfTheStatesDoNotMatter) {
  const Dataset data = record();
  const OdeModel original = identify(data, algorithm1()).model;
  for (const double scale : {1e-3, 1e4})
    expect_scaled_model(identify(scaled(data, scale, 1.0), algorithm1()).model, original, scale,
                        1.0);
}

TEST_P(Invariance, TimeScaleDoesNotMatter) {
  const Dataset data = record();
  const OdeModel original = identify(data, algorithm1()).model;
  const OdeModel slow = identify(scaled(data, 1.0, 1e-4), algorithm1()).model;
  expect_scaled_model(slow, original, 1.0, 1e-4);
}

TEST_P(Invariance, RepeatedRowsDoNotMatter) {
  Dataset data = record();
  const OdeModel original = identify(data, algorithm1()).model;
  data.trajectories.push_back(data.trajectories.front());
  expect_scaled_model(identify(data, algorithm1()).model, original, 1.0, 1.0);
}

TEST_P(Invariance, OrderOfTheVariablesDoesNotMatter) {
  const Dataset data = record();
  const OdeModel original = identify(data, algorithm1()).model;
  const std::vector<Index> order = {2, 0, 1};
  Dataset permuted = data;
  for (std::size_t k = 0; k < order.size(); ++k)
    permuted.states[k] = data.states[static_cast<std::size_t>(order[k])];
  for (Trajectory& trajectory : permuted.trajectories) {
    trajectory.states = Matrix(trajectory.states(Eigen::all, order));
    if (trajectory.has_derivatives())
      trajectory.derivatives = Matrix(trajectory.derivatives(Eigen::all, order));
  }
  const OdeModel found = identify(permuted, algorithm1()).model;
  for (std::size_t k = 0; k < order.size(); ++k) {
    const Equation& expected = original.equations()[static_cast<std::size_t>(order[k])];
    ASSERT_EQ(found.equations()[k].size(), expected.size());
    for (const WeightedTerm& term : expected) {
      const std::string name = Term::parse(term.term.name(), found.variables()).name();
      EXPECT_NEAR(found.coefficient(static_cast<Index>(k), name), term.coefficient,
                  1e-7 * std::abs(term.coefficient));
    }
  }
}

std::string record_name(const ::testing::TestParamInfo<int>& record) {
  return record.param == 0 ? "ExactDerivatives" : record.param == 1 ? "Sampled" : "Noisy";
}

INSTANTIATE_TEST_SUITE_P(Records, Invariance, ::testing::Values(0, 1, 2), record_name);

}  // namespace
}  // namespace lacuna
