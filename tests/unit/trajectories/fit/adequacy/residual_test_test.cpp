// SPDX-License-Identifier: MIT
#include "trajectories/fit/adequacy/residual_test.hpp"

#include <gtest/gtest.h>

#include <Eigen/QR>
#include <cmath>
#include <numeric>

#include "core/base/random.hpp"

namespace lacuna {
namespace {

/// exp(-k t) of an amplitude and a rate, in so many records alike.
struct Decays {
  Decays(Index samples, Index records) : n(samples), rows(samples * records, 2) {
    model.resize(rows.rows());
    for (Index i = 0; i < rows.rows(); ++i) {
      const double t = 3.0 * static_cast<double>(i % n) / static_cast<double>(n);
      model[i] = std::exp(-t);
      rows.row(i) << std::exp(-t), -t * std::exp(-t);
    }
    for (Index r = 0; r <= records; ++r) begins.push_back(r * n);
  }

  FittedDirections directions() const { return {rows, begins, 0}; }

  FittedResiduals residuals(Vector values) const {
    FittedResiduals fitted{std::move(values), model, {}, 1};
    for (std::size_t r = 0; r + 1 < begins.size(); ++r) {
      fitted.sequences.push_back({0, std::vector<Index>(static_cast<std::size_t>(n))});
      auto& own = fitted.sequences.back().rows;
      std::iota(own.begin(), own.end(), begins[r]);
    }
    return fitted;
  }

  Index n;
  Matrix rows;
  Vector model;
  std::vector<Index> begins;
};

ChannelStructure tested(const Decays& decays, Vector noise, std::uint64_t seed) {
  const FittedDirections directions = decays.directions();
  directions.remove(noise);
  return test_structure(decays.residuals(noise), directions, {.draws = 199, .seed = seed})[0];
}

TEST(FittedDirections, TakeWhatLeastSquaresTakes) {
  // Two records with an offset each and a slope in common; v - A (A'A)^-1 A'v from the whole.
  Random random(1);
  Matrix rows(12, 2), whole = Matrix::Zero(12, 3);
  Vector values(12);
  for (Index i = 0; i < 12; ++i) {
    rows.row(i) << 1.0, random.normal();
    whole(i, i < 5 ? 0 : 1) = 1.0;
    whole(i, 2) = rows(i, 1);
    values[i] = random.normal();
  }
  const FittedDirections directions(rows, {0, 5, 12}, 1);
  EXPECT_EQ(directions.rank(), 3);
  const Vector expected = values - whole * whole.colPivHouseholderQr().solve(values);
  const Matrix hat = whole * whole.completeOrthogonalDecomposition().pseudoInverse();
  Vector left = values;
  directions.remove(left);
  EXPECT_LT((left - expected).norm(), 1e-12);
  EXPECT_LT((directions.leverage() - hat.diagonal()).norm(), 1e-12);
}

TEST(TestStructure, RightModelsAreRefusedAtTheStatedLevel) {
  // Normal noise, noise in proportion to the value, and the heavy tails of Student's t with 4
  // degrees of freedom; 200 draws of each: 5 % are 10 +- 3.1.
  const Decays decays(30, 1);
  for (const int law : {0, 1, 2}) {
    int refused = 0;
    Random random(static_cast<std::uint64_t>(11 + law));
    for (std::uint64_t draw = 1; draw <= 200; ++draw) {
      Vector noise(30);
      for (Index i = 0; i < 30; ++i) {
        double squares = 0.0;
        for (int k = 0; k < 4; ++k) squares += std::pow(random.normal(), 2);
        noise[i] = random.normal() * (law == 1   ? decays.model[i]
                                      : law == 2 ? 2.0 / std::sqrt(squares)
                                                 : 1.0);
      }
      refused += tested(decays, noise, draw).chance < 0.05 ? 1 : 0;
    }
    EXPECT_GE(refused, 2) << law;
    EXPECT_LE(refused, 20) << law;
  }
}

TEST(TestStructure, SeesSlowAndFastStructureAndNamesIt) {
  const Decays decays(40, 1);
  Random random(3);
  Vector noise(40), slow(40), fast(40);
  for (Index i = 0; i < 40; ++i) {
    noise[i] = random.normal();
    slow[i] = 2.0 * std::sin(0.25 * static_cast<double>(i));
    fast[i] = i / 2 % 2 == 0 ? 2.0 : -2.0;
  }
  EXPECT_LT(tested(decays, noise + slow, 1).chance, 0.01);
  EXPECT_FALSE(tested(decays, noise + slow, 1).sign.empty());
  EXPECT_LT(tested(decays, noise + fast, 1).chance, 0.01);
  EXPECT_EQ(tested(decays, noise + fast, 1).sign, "correlation");
  EXPECT_GT(tested(decays, noise, 1).chance, 0.05);
}

TEST(TestStructure, WhatRecordsHaveInCommonIsSeen) {
  // The same fast pattern, white by itself, in six records of 12 samples.
  const Decays decays(12, 6);
  Random random(5);
  Vector pattern(12), noise(72);
  for (double& value : pattern) value = random.normal();
  for (Index i = 0; i < 72; ++i) noise[i] = random.normal() + 1.5 * pattern[i % 12];
  EXPECT_LT(tested(decays, noise, 1).chance, 0.01);
}

TEST(TestStructure, FewSamplesHaveLittlePower) {
  Random random(7);
  const auto power = [&](Index samples) {
    Vector noise(samples);
    for (double& value : noise) value = random.normal();
    return tested(Decays(samples, 1), noise, 1).power;
  };
  EXPECT_LT(power(8), 0.5);
  EXPECT_GT(power(60), 0.95);
}

TEST(TestStructure, NothingIsSaidWhereNothingIsLeft) {
  const Decays decays(3, 1);
  EXPECT_EQ(tested(decays, Vector::Ones(3), 1).chance, 1.0);
  EXPECT_EQ(tested(decays, Vector::Ones(3), 1).power, 0.0);
  EXPECT_EQ(tested(Decays(30, 1), Vector::Zero(30), 1).chance, 1.0);
}

}  // namespace
}  // namespace lacuna
