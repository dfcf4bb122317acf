// SPDX-License-Identifier: MIT
// What a fit is made of: records, runs along them and their quality.
#include "trajectories/fit/fit_engine.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "lacuna/core/base/error.hpp"
#include "lacuna/data/records/marks.hpp"
#include "support/grey_box.hpp"
#include "trajectories/fit/fit_quality.hpp"
#include "trajectories/fit/fit_records.hpp"

namespace lacuna {
namespace {

using ::testing::ElementsAre;

constexpr const char* kBox = R"(input u hold linear
param k = 0.8 in 0..5
param c = 1.5
dx/dt = -k*x^2 + 2*z - 0.3*x
dz/dt = u - c*z - 0.2*x*z
y = x^2+k*z
w = z
)";

struct Box {
  Box() {
    system = std::make_unique<SystemModel>(parse_ode_system(kBox, "box.ode"));
    const OdeModel plain = system->model();
    view = support::grey_box(plain, {.start = (Vector(2) << 0.5, 0.2).finished()});
    const ParametrisedModel model = system->parametrised();
    engine = std::make_unique<FitEngine>(fit_engine(model, fit_records(model, view)));
    point = {model.values().transpose(), (Matrix(1, 2) << 0.5, 0.2).finished()};
  }
  std::unique_ptr<SystemModel> system;
  Dataset view;
  std::unique_ptr<FitEngine> engine;
  FitPoint point;
};

/// Derivatives by differences of whole runs.
void expect_derivatives(Box& box, const Gains& gains) {
  const FitPath path = follow(*box.engine, box.point, gains);
  const Index columns = box.engine->states() + box.engine->parameters();
  std::vector<Matrix> rows(static_cast<std::size_t>(box.engine->records.samples()));
  sensitivities(*box.engine, box.point, path, gains, 0,
                [&](Index n, const Matrix& row, const Vector&) {
                  rows[static_cast<std::size_t>(n)] = row;
                });
  for (Index j = 0; j < columns; ++j) {
    const auto moved = [&](double by) {
      FitPoint point = box.point;
      if (j < 2)
        point.starts(0, j) += by;
      else
        point.parameters(0, j - 2) += by;
      return follow(*box.engine, point, gains).residuals;
    };
    constexpr double kStep = 1e-5;
    const Matrix difference = -(moved(kStep) - moved(-kStep)) / (2.0 * kStep);
    for (const Index n : {0, 1, 40, 599})
      for (Index c = 0; c < 2; ++c)
        EXPECT_NEAR(rows[static_cast<std::size_t>(n)](c, j) * box.engine->sigma[c],
                    difference(n, c), 1e-6 * (1.0 + std::abs(difference(n, c))))
            << "column " << j << ", sample " << n;
  }
}

TEST(FitEngine, DerivativesKnowOfTheGains) {
  Box box;
  FitPath filtered;
  const Disturbances disturbances{(Vector(2) << 1.0, 0.5).finished(), 0.3};
  const Gains gains = filter_gains(*box.engine, box.point, disturbances, filtered);
  EXPECT_GT(gains.bottomRows(1).cwiseAbs().maxCoeff(), 1e-3);
  expect_derivatives(box, gains);
  const FitPath again = follow(*box.engine, box.point, gains);
  EXPECT_LT((again.states - filtered.states).cwiseAbs().maxCoeff(), 1e-12)
      << "the gains are those of the path that they give";
}

/// A rate of 1e6 at steps of 0.1, or of another size.
FitEngine stiff_engine(const SystemModel& system, FitPoint& point) {
  const ParametrisedModel model = system.parametrised();
  const Dataset view = support::grey_box(
      parse_ode("dx/dt = -0.5*x\ny = x\n", "d.ode"),
      {.start = Vector::Constant(1, 1.0), .step = 0.1, .samples = 20});
  FitEngine engine = fit_engine(model, fit_records(model, view));
  point = {model.values().transpose(), Matrix::Constant(1, 1, 1.0)};
  return engine;
}

TEST(LeaveImplicitSteps, WhereAnotherPointWasStiff) {
  const SystemModel system = parse_ode_system("param k = 1e6\ndx/dt = -k*(x-1)\ny = x\n", "m");
  FitPoint point;
  FitEngine engine = stiff_engine(system, point);
  choose_method(engine, point);
  ASSERT_TRUE(engine.implicit);
  EXPECT_FALSE(leave_implicit_steps(engine, point));
  EXPECT_TRUE(engine.implicit) << "still stiff there";
  point.parameters(0, 0) = 2.0;
  const FitPath before = follow(engine, point, {});
  EXPECT_TRUE(leave_implicit_steps(engine, point));
  EXPECT_FALSE(engine.implicit);
  EXPECT_LT((follow(engine, point, {}).states - before.states).cwiseAbs().maxCoeff(), 1e-4);
}

/// x' = v, v' = -4 x - 0.3 v + u, a hidden filter z of x; x is measured as q, e is a formula.
constexpr const char* kText = R"(input u hold zero
param g = 2
dx/dt = v
dv/dt = -4*x - 0.3*v + u
dz/dt = x - z
q = x
e = g*abs(v)
initial z = 0.5
)";

Dataset view_of(const OdeModel& model) {
  return support::grey_box(
      model, {.start = (Vector(3) << 1.0, -2.0, 0.5).finished(), .step = 0.02, .noise = 0.001});
}

TEST(FitRecords, StartsAreMeasuredKnownOrSlopes) {
  const SystemModel system = parse_ode_system(kText, "m.ode");
  const FitRecords records = fit_records(system.parametrised(), view_of(system.model()));
  EXPECT_NEAR(records.starts(0, 0), 1.0, 0.01);
  EXPECT_NEAR(records.starts(0, 1), -2.0, 0.3);
  EXPECT_EQ(records.starts(0, 2), 0.5);
  EXPECT_THAT(records.guessed, ElementsAre(false, false, false));
  EXPECT_GT(records.scale[1], 0.5 * records.scale[0]);
  EXPECT_EQ(records.scale[2], 0.0) << "nothing is known of it";
  EXPECT_NEAR(records.time_scale, 0.5, 0.25) << "1 / 2 rad/s";
}

TEST(FitRecords, ASlopeThatIsNoiseIsNoStart) {
  const SystemModel system = parse_ode_system(kText, "m.ode");
  Dataset view = view_of(system.model());
  view.trajectories[0].states(2, 0) += 1.0;  // 25 per time unit, where rates are about 2
  EXPECT_EQ(fit_records(system.parametrised(), view).starts(0, 1), 0.0);
}

TEST(FitRecords, SomethingHasToBeMeasured) {
  const SystemModel system = parse_ode_system(kText, "m.ode");
  Dataset view = view_of(system.model());
  for (Index n = 0; n < view.samples(); ++n)
    for (const Index k : {0, 3}) set_mark(view.trajectories[0], n, k, Mark::Missing);
  EXPECT_THROW(fit_records(system.parametrised(), view), DataError);
}

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
