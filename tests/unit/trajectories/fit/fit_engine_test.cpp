// SPDX-License-Identifier: MIT
#include "trajectories/fit/fit_engine.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/grey_box.hpp"

namespace lacuna {
namespace {

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

}  // namespace
}  // namespace lacuna
