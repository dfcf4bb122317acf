// SPDX-License-Identifier: MIT
#include "data/records/columns/derivative_columns.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/records/columns/derivative_agreement.hpp"
#include "data/records/columns/many_valued.hpp"
#include "lacuna/core/base/error.hpp"
#include "unit/data/records/columns/rate_columns.hpp"

namespace lacuna {
namespace {

using ::testing::ElementsAre;
using Names = std::vector<std::string>;
using testing::lotka_volterra;
using testing::named_columns;
using testing::Rates;
using testing::states_and_rates;

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

const std::vector<std::string> kNames{"x", "y", "dx", "dy"};

Trajectory cycle(Index n = 1000) {
  return states_and_rates(lotka_volterra, Vector{{0.4, 0.7}}, n, 20.0 / static_cast<double>(n));
}

Dataset columns_of(Trajectory record, double noise = 0.0) {
  return named_columns({std::move(record)}, {0, 1, 2, 3}, kNames, noise);
}

/// The derivative of x by another rule.
Dataset by_differences(Index before, Index after) {
  Trajectory record = cycle();
  const Vector x = record.states.col(0);
  for (Index i = 1; i + 1 < record.samples(); ++i)
    record.states(i, 2) =
        (x[i + after] - x[i - before]) / (record.time[i + after] - record.time[i - before]);
  return columns_of(std::move(record));
}

bool agrees(const Dataset& data, Index derivative, Index of) {
  return is_derivative(data, analyse_noise(data), derivative, of);
}

TEST(IsDerivative, HoldsForDifferencesOfNeighbours) {
  EXPECT_TRUE(agrees(by_differences(0, 1), 2, 0));
  EXPECT_TRUE(agrees(by_differences(1, 0), 2, 0));
  EXPECT_TRUE(agrees(by_differences(1, 1), 2, 0));
}

TEST(IsDerivative, HoldsForAStraightLineAndUnevenTimes) {
  Trajectory record = cycle();
  record.states.col(2).setConstant(3.0);
  for (Index i = 0; i < record.samples(); ++i) record.time[i] += i % 2 == 0 ? 0.0 : 0.008;
  record.states.col(1) = record.time.array().sin();
  record.states.col(3) = record.time.array().cos();
  record.states.col(0) = 3.0 * record.time;
  const Dataset data = columns_of(std::move(record));
  EXPECT_TRUE(agrees(data, 2, 0));
  EXPECT_TRUE(agrees(data, 3, 1));
}

TEST(IsDerivative, FailsForOneOfAnotherSize) {
  for (const double factor : {-1.0, 0.7, 1.3, 1000.0}) {
    Trajectory record = cycle();
    record.states.col(2) *= factor;
    EXPECT_FALSE(agrees(columns_of(std::move(record), 0.01), 2, 0)) << factor;
  }
}

TEST(IsDerivative, FailsWherePartOfTheRecordIsAnother) {
  Trajectory record = cycle();
  record.states.col(2).segment(400, 200).reverseInPlace();
  EXPECT_FALSE(agrees(columns_of(std::move(record)), 2, 0));
}

TEST(IsDerivative, FailsWhereARippleStandsOnIt) {
  Trajectory record = cycle();
  record.states.col(2).array() += 0.5 * (20.0 * record.time.array()).sin();
  EXPECT_FALSE(agrees(columns_of(std::move(record)), 2, 0));
}

TEST(IsDerivative, NeedsEnoughSamplesAndNumbers) {
  EXPECT_FALSE(agrees(columns_of(rows_of(cycle(), 0, 5)), 2, 0));
  Dataset data = columns_of(cycle());
  data.trajectories[0].states(7, 0) = std::nan("");
  const std::vector<StateNoise> noise(4);
  EXPECT_FALSE(is_derivative(data, noise, 2, 0));
  EXPECT_THROW(is_derivative(data, noise, 4, 0), ArgumentError);
  EXPECT_THROW(is_derivative(data, {}, 2, 0), ArgumentError);
}

/// Two records that run through the same positions with unlike velocities.
TEST(IsManyValued, ComparesRecords) {
  const auto decay = [](double rate) {
    return states_and_rates([rate](double, const Vector& x) { return Vector(-rate * x); },
                            Vector{{1.0}}, 200, 0.01);
  };
  const std::vector<std::string> names{"x", "dx"};
  EXPECT_FALSE(is_many_valued(named_columns({decay(1.0)}, {0, 1}, names), {1}, {0}));
  EXPECT_FALSE(
      is_many_valued(named_columns({decay(1.0), decay(1.0)}, {0, 1}, names), {1}, {0}));
  EXPECT_TRUE(is_many_valued(named_columns({decay(1.0), decay(3.0)}, {0, 1}, names), {1}, {0}));
}

TEST(IsManyValued, InputsDetermineToo) {
  Trajectory record = states_and_rates(testing::driven, Vector{{0.4, 0.7}}, 2000, 0.05);
  const Dataset free = named_columns({record}, {0, 1, 3}, {"x", "v", "a"});
  EXPECT_TRUE(is_many_valued(free, {2}, {0, 1}));
  Dataset known = free;
  known.inputs = {{"u", ""}};
  known.trajectories[0].inputs = record.time.unaryExpr(&testing::drive);
  EXPECT_FALSE(is_many_valued(known, {2}, {0, 1}));
}

}  // namespace
}  // namespace lacuna
