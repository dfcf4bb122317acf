// SPDX-License-Identifier: MIT
#include "trajectories/fit/fit_quality.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/grey_box.hpp"

namespace lacuna {
namespace {

struct Walk {
  explicit Walk(double noise = 0.02)
      : system(parse_ode_system("input u hold linear\ndx/dt = -0.5*x + 0.7*u\ny = x\n", "m")) {
    const Dataset view =
        support::grey_box(system.model(), {.start = Vector::Constant(1, 2.0), .noise = noise});
    const ParametrisedModel model = system.parametrised();
    engine = std::make_unique<FitEngine>(fit_engine(model, fit_records(model, view)));
    point = {model.values().transpose(), Matrix::Constant(1, 1, 2.0)};
  }
  SystemModel system;
  std::unique_ptr<FitEngine> engine;
  FitPoint point;
};

TEST(QualityOf, IsThatOfTheResidualsThatCount) {
  Walk walk;
  FitPath path = follow(*walk.engine, walk.point, {});
  const Vector y = walk.engine->records.values.col(0).tail(500);
  const Vector e = path.residuals.col(0).tail(500);
  const FitQuality quality = quality_of(*walk.engine, walk.point, path, 5, 100)[0];
  EXPECT_NEAR(quality.rmse, std::sqrt(e.squaredNorm() / 500.0), 1e-12);
  EXPECT_NEAR(quality.fit_percent,
              100.0 * (1.0 - e.norm() / (y.array() - y.mean()).matrix().norm()), 1e-9);
  EXPECT_TRUE(quality.white);
  EXPECT_GT(quality.prediction, 0.8 * quality.rmse);
  EXPECT_LT(quality.prediction, 2.0 * quality.rmse);
  ASSERT_EQ(quality.rmse_per_record.size(), 1u);
}

/// dx/dt = -0.5 x + 0.7 u, where the gain of u is each record's own.
TEST(GapOf, FitsWhatEachRecordHasForItselfOnItsFirstSamples) {
  Walk walk;
  const Dataset other = support::grey_box(
      walk.system.model(), {.start = Vector::Constant(1, -1.0), .noise = 0.02, .seed = 9});
  FitPoint elsewhere = walk.point;
  elsewhere.parameters(0, 1) += 0.5;
  const ParametrisedModel model = walk.system.parametrised();
  const Matrix usual = (Matrix(1, 2) << 1.0, 0.5).finished();
  const auto common = gap_of(model, elsewhere, other, usual, {}, fit_unknowns(model, {}));
  const auto own = gap_of(model, elsewhere, other, usual, {}, fit_unknowns(model, {1}));
  ASSERT_TRUE(common && own);
  EXPECT_GT(common->after, 0.1);
  EXPECT_NEAR(own->after, 0.02, 0.006);
}

TEST(QualityOf, WhatWasNotComparedIsNoNumber) {
  Walk walk;
  const FitPath path = follow(*walk.engine, walk.point, {});
  const Index all = walk.engine->records.samples();
  const FitQuality quality = quality_of(*walk.engine, walk.point, path, all, all)[0];
  EXPECT_EQ(quality.samples, 0);
  EXPECT_EQ(quality.predicted, 0);
  EXPECT_TRUE(std::isnan(quality.rmse));
  EXPECT_TRUE(std::isnan(quality.prediction));
  EXPECT_TRUE(std::isnan(quality.fit_percent));
  EXPECT_EQ(quality_of(*walk.engine, walk.point, path, 5, 100)[0].samples, all - 100);
}

}  // namespace
}  // namespace lacuna
