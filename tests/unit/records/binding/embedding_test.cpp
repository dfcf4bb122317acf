// SPDX-License-Identifier: MIT
#include "lacuna/records/binding/embedding.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data/derivatives/finite_differences.hpp"
#include "data/derivatives/savitzky_golay.hpp"
#include "lacuna/core/base/error.hpp"
#include "support/oscillation.hpp"

namespace lacuna {
namespace {

using ::testing::ElementsAre;
using ::testing::Optional;

const FiniteDifferences kEighthOrder{{.order = 8}};

/// Only q = sin(2 t) and p = 2 cos(2 t) with an input.
Dataset measured(Index n = 300) {
  Dataset data = oscillation_data(n);
  data.states = {{"q", "m"}, {"p", "A"}};
  return data;
}

std::vector<std::string> names(const Dataset& data) {
  std::vector<std::string> result;
  for (const Quantity& state : data.states) result.push_back(state.name);
  return result;
}

double largest(const Vector& values) { return values.cwiseAbs().maxCoeff(); }

TEST(Embed, SecondOrderAddsTheDerivative) {
  const Dataset result = embed(measured(), {{"q", 2}}, kEighthOrder);
  EXPECT_THAT(names(result), ElementsAre("q", "q_d1", "p"));
  EXPECT_EQ(result.states[1].unit, "m/s");
  EXPECT_THAT(result.rate_of, ElementsAre(Optional(Index{1}), std::nullopt, std::nullopt));
  const Trajectory& record = result.trajectories[0];
  const Vector q = (2.0 * record.time.array()).sin();
  const Vector rate = 2.0 * (2.0 * record.time.array()).cos();
  EXPECT_LT(largest(record.states.col(0) - q), 1e-14);
  EXPECT_LT(largest(record.states.col(1) - rate), 1e-8);
  EXPECT_EQ(record.derivatives.col(0), record.states.col(1));
  EXPECT_LT(largest(record.derivatives.col(1) + 4.0 * q), 1e-6);
  EXPECT_LT(largest(record.derivatives.col(2) + 4.0 * q), 1e-8);
  EXPECT_NO_THROW(check_dataset(result));
}

TEST(Embed, WhatIsAddedIsReconstructed) {
  Dataset data = measured();
  data.reconstructed = {false, true};
  const Dataset result = embed(data, {{"q", 2}}, kEighthOrder);
  EXPECT_THAT(result.reconstructed, ElementsAre(false, true, true));
  EXPECT_THAT(embed(measured(), {{"q", -1}}, kEighthOrder).reconstructed,
              ElementsAre(false, true, false));
}

TEST(Embed, ThirdOrderAddsTwo) {
  const Dataset result = embed(measured(), {{"q", 3}}, kEighthOrder);
  EXPECT_THAT(names(result), ElementsAre("q", "q_d1", "q_d2", "p"));
  EXPECT_EQ(result.states[2].unit, "m/s^2");
  EXPECT_THAT(result.rate_of,
              ElementsAre(Optional(Index{1}), Optional(Index{2}), std::nullopt, std::nullopt));
}

TEST(Embed, UnitsWithOddPowersOfTimeAreDividedAsAWhole) {
  Dataset data = measured();
  for (const char* unit : {"m/s^0.5", "m/s^1e300"}) {
    data.states[0].unit = unit;
    EXPECT_EQ(embed(data, {{"q", 2}}, kEighthOrder).states[1].unit, unit + std::string("/s"));
  }
}

TEST(Embed, NegativeOrderAddsIntegrals) {
  const Dataset result = embed(measured(), {{"q", -2}}, kEighthOrder);
  EXPECT_THAT(names(result), ElementsAre("q", "q_i1", "q_i2", "p"));
  EXPECT_EQ(result.states[1].unit, "m s");
  EXPECT_EQ(result.states[2].unit, "m s^2");
  EXPECT_THAT(result.rate_of,
              ElementsAre(std::nullopt, Optional(Index{0}), Optional(Index{1}), std::nullopt));
  const Trajectory& record = result.trajectories[0];
  const Vector integral = 0.5 * (1.0 - (2.0 * record.time.array()).cos());
  EXPECT_LT(largest(record.states.col(1) - integral), 1e-8);
  EXPECT_EQ(record.derivatives.col(1), record.states.col(0));
  EXPECT_EQ(record.derivatives.col(2), record.states.col(1));
}

TEST(Embed, SeveralStatesAtOnce) {
  const Dataset result = embed(measured(), {{"p", 2}, {"q", 2}}, kEighthOrder);
  EXPECT_THAT(names(result), ElementsAre("q", "q_d1", "p", "p_d1"));
  EXPECT_THAT(result.rate_of,
              ElementsAre(Optional(Index{1}), std::nullopt, Optional(Index{3}), std::nullopt));
}

TEST(Embed, IdentitiesThatWereKnownStay) {
  Dataset data = measured();
  data.rate_of = {Index{1}, std::nullopt};
  const Dataset result = embed(data, {{"p", 2}}, kEighthOrder);
  EXPECT_THAT(names(result), ElementsAre("q", "p", "p_d1"));
  EXPECT_THAT(result.rate_of,
              ElementsAre(Optional(Index{1}), Optional(Index{2}), std::nullopt));
}

TEST(Embed, SignalsBecomeTheSmoothedOnes) {
  const Dataset data = measured();
  const SavitzkyGolay method{{.window = 41, .degree = 2}};
  const Trajectory& raw = data.trajectories[0];
  const Dataset result = embed(data, {{"q", 2}}, method);
  const Trajectory& record = result.trajectories[0];
  const auto expected = [&](const Matrix& signals, int order) {
    return Vector(method.differentiate(raw.time, signals, order).col(0));
  };
  EXPECT_LT(largest(record.states.col(0) - expected(raw.states, 0)), 1e-13);
  EXPECT_LT(largest(record.derivatives.col(1) - expected(raw.states, 2)), 1e-10);
  EXPECT_LT(largest(record.inputs.col(0) - expected(raw.inputs, 0)), 1e-13);
  EXPECT_GT(largest(record.states.col(0) - raw.states.col(0)), 1e-4);
}

TEST(Embed, GivenDerivativesOfOtherStatesAreKept) {
  Dataset data = measured();
  give_derivatives(data.trajectories[0]);
  data.trajectories[0].derivatives.col(1).setConstant(7.0);
  const Dataset result = embed(data, {{"q", 2}}, SavitzkyGolay{});
  EXPECT_TRUE((result.trajectories[0].derivatives.col(2).array() == 7.0).all());
  EXPECT_EQ(result.trajectories[0].states.col(2), data.trajectories[0].states.col(1));
}

TEST(Embed, UnitsOfRatesAreCounted) {
  Dataset data = measured();
  data.states = {{"q", "rad/s"}, {"p", ""}};
  const Dataset result = embed(data, {{"q", 3}, {"p", 2}}, kEighthOrder);
  EXPECT_EQ(result.states[1].unit, "rad/s^2");
  EXPECT_EQ(result.states[2].unit, "rad/s^3");
  EXPECT_EQ(result.states[4].unit, "");
}

TEST(Embed, RequestsThatCannotBeMetAreRefused) {
  const Dataset data = measured();
  EXPECT_THROW(embed(data, {{"Q", 2}}, kEighthOrder), ConfigError);
  EXPECT_THROW(embed(data, {{"q", 0}}, kEighthOrder), ConfigError);
  EXPECT_THROW(embed(data, {{"q", 2}, {"q", 3}}, kEighthOrder), ConfigError);
  Dataset taken = data;
  taken.states[1].name = "q_d1";
  EXPECT_THROW(embed(taken, {{"q", 2}}, kEighthOrder), ConfigError);
}

TEST(Embed, ShortRecordIsNamed) {
  try {
    embed(measured(6), {{"q", 2}}, kEighthOrder);
    FAIL();
  } catch (const DataError& error) {
    EXPECT_NE(error.where().find("run.csv"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace lacuna
