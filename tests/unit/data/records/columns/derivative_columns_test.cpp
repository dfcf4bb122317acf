// SPDX-License-Identifier: MIT
#include "data/records/columns/derivative_columns.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lacuna/core/base/error.hpp"
#include "unit/data/records/columns/rate_columns.hpp"

namespace lacuna {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::named_columns;
using testing::Rates;
using testing::states_and_rates;
using Names = std::vector<std::string>;

/// States that are left of some columns of a record (states, then their rates).
Names left(const Rates& rates, const Vector& start, const std::vector<Index>& columns,
           const Names& names, double noise = 0.0, Index n = 1000) {
  const double step = 20.0 / static_cast<double>(n);
  const Dataset data = without_derivative_columns(
      named_columns({states_and_rates(rates, start, n, step)}, columns, names, noise));
  EXPECT_EQ(data.trajectories[0].states.cols(), data.state_count());
  return names_of(data.states);
}

const Vector kStart{{0.4, 0.7}};

/// The derivatives among columns that are called so.
std::vector<NamedDerivative> named(const std::vector<std::string>& names) {
  std::vector<Quantity> columns;
  for (const std::string& name : names) columns.push_back({name, ""});
  return named_derivatives(columns);
}

TEST(NamedDerivatives, HaveTheUsualNames) {
  for (const char* name : {"dx", "d_x", "dx_dt", "dxdt", "x_dot", "xdot", "dot_x"})
    EXPECT_EQ(named({name, "y", "x"}), (std::vector<NamedDerivative>{{0, 2, 1}})) << name;
  for (const char* name : {"ddx", "d2x", "d2x_dt2", "d2xdt2", "x_ddot", "ddot_x"})
    EXPECT_EQ(named({"x", name}), (std::vector<NamedDerivative>{{1, 0, 2}})) << name;
  EXPECT_EQ(named({"theta_1", "dtheta_1"}), (std::vector<NamedDerivative>{{1, 0, 1}}));
  EXPECT_TRUE(named({"v", "x", "d", "_"}).empty());
}

TEST(NamedDerivatives, AreInTheOrderOfTheColumns) {
  EXPECT_EQ(named({"ddx", "x", "dx"}),
            (std::vector<NamedDerivative>{{0, 1, 2}, {0, 2, 1}, {2, 1, 1}}));
  EXPECT_EQ(named({"d_x", "x", "dx"}), (std::vector<NamedDerivative>{{0, 1, 1}, {2, 1, 1}}));
}

TEST(DerivativeColumns, OfAllStatesAreLeftOut) {
  for (const double noise : {0.0, 0.01, 0.05}) {
    EXPECT_THAT(left(testing::lotka_volterra, kStart, {0, 1, 2, 3}, {"x", "y", "dx", "dy"},
                     noise),
                ElementsAre("x", "y"));
    EXPECT_THAT(left(testing::lorenz, Vector{{1.0, 2.0, 20.0}}, {3, 4, 5, 0, 1, 2},
                     {"x_dot", "y_dot", "z_dot", "x", "y", "z"}, noise, 4000),
                ElementsAre("x", "y", "z"));
  }
}

/// v is the derivative of x, by its values, and stays.
TEST(DerivativeColumns, AVelocityWithANameOfItsOwnStays) {
  for (const double noise : {0.0, 0.01, 0.05})
    for (const Rates& rates : {Rates(testing::pendulum), Rates(testing::driven)}) {
      EXPECT_THAT(left(rates, kStart, {0, 1, 2, 3}, {"x", "v", "dx", "dv"}, noise),
                  ElementsAre("x", "v"));
      EXPECT_THAT(left(rates, kStart, {0, 1, 3}, {"x", "v", "dv_dt"}, noise),
                  ElementsAre("x", "v"));
      EXPECT_THAT(left(rates, kStart, {0, 1}, {"x", "v"}, noise), ElementsAre("x", "v"));
    }
}

/// A velocity called as a derivative is a state where positions do not determine it.
TEST(DerivativeColumns, AVelocityCalledSoStaysToo) {
  for (const double noise : {0.0, 0.01, 0.05}) {
    EXPECT_THAT(left(testing::pendulum, kStart, {0, 1}, {"th", "th_dot"}, noise),
                ElementsAre("th", "th_dot"));
    EXPECT_THAT(
        left(testing::pendulum, kStart, {0, 1, 3}, {"th", "th_dot", "th_ddot"}, noise),
        ElementsAre("th", "th_dot"));
    EXPECT_THAT(left(testing::two_masses, Vector{{0.3, 0.1, 0.2, -0.1}}, {0, 1, 2, 3},
                     {"x", "y", "dx", "dy"}, noise, 500),
                ElementsAre("x", "y", "dx", "dy"));
  }
}

TEST(DerivativeColumns, AnotherStateCalledSoStays) {
  for (const double noise : {0.0, 0.01, 0.05, 0.2})
    EXPECT_THAT(left(testing::lorenz, Vector{{1.0, 2.0, 20.0}}, {0, 1, 2}, {"x", "dx", "z"},
                     noise),
                ElementsAre("x", "dx", "z"));
}

TEST(DerivativeColumns, FewSamplesShowNone) {
  EXPECT_THAT(left(testing::lotka_volterra, kStart, {0, 1, 2, 3}, {"x", "y", "dx", "dy"}, 0.0,
                   5),
              ElementsAre("x", "y", "dx", "dy"));
}

TEST(DerivativeColumns, OneRecordInWhichItIsNoneKeepsIt) {
  const Trajectory good = states_and_rates(testing::lotka_volterra, kStart, 500, 0.02);
  Trajectory bad = good;
  bad.states.col(2) = bad.states.col(3);
  const Names names{"x", "y", "dx", "dy"};
  const auto count = [&](const std::vector<Trajectory>& records) {
    return derivative_columns(named_columns(records, {0, 1, 2, 3}, names)).size();
  };
  EXPECT_EQ(count({good, good}), 2u);
  EXPECT_EQ(count({good, bad}), 1u);
}

TEST(DerivativeColumns, ANoteSaysHowToKeepThem) {
  const Dataset data = without_derivative_columns(named_columns(
      {states_and_rates(testing::lotka_volterra, kStart, 500, 0.02)}, {0, 1, 2, 3},
      {"x", "y", "dx", "dy"}));
  ASSERT_EQ(data.notes.size(), 1u);
  EXPECT_THAT(data.notes[0], HasSubstr("run.csv: left out as derivatives"));
  EXPECT_THAT(data.notes[0], HasSubstr("dx (of x), dy (of y); --states x,y,dx,dy"));
}

}  // namespace
}  // namespace lacuna
