// SPDX-License-Identifier: MIT
#include "trajectories/fit/population/population_problem.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/populations.hpp"

namespace lacuna {
namespace {

TEST(VaryingParameter, DerivativesAreThoseOfItsValue) {
  constexpr double kStep = 1e-6;
  for (const bool by_factor : {false, true}) {
    const VaryingParameter one{0, by_factor, 0.3};
    const auto value = [&](double typical, double z) { return one.value(typical, 0.3, z); };
    EXPECT_NEAR(one.by_deviation(2.0, 0.3, 0.7),
                (value(2.0, 0.7 + kStep) - value(2.0, 0.7 - kStep)) / (2.0 * kStep), 1e-8);
    EXPECT_NEAR(one.by_typical(0.3, 0.7),
                (value(2.0 + kStep, 0.7) - value(2.0 - kStep, 0.7)) / (2.0 * kStep), 1e-8);
    EXPECT_NEAR(value(2.0, one.deviation_at(1.5, 2.0, 0.3)), 1.5, 1e-12) << by_factor;
  }
}

TEST(PopulationProblem, SizesOfNoiseAreThoseThatAreNotGiven) {
  const SystemModel system = parse_ode_system(
      "param k = 0.5 varies */ 1.3\ndx/dt = -k*x\ny = 2*x noise both\n", "m.ode");
  const Dataset data = support::lines(system, 3, 0.1, 0.1, 0.1, 1);
  const ParametrisedModel model = system.parametrised();
  FitEngine engine = fit_engine(model, fit_records(model, data));
  const PopulationProblem problem = population_problem(system, engine, fit_unknowns(model, {}));
  ASSERT_EQ(problem.sizes.size(), 2u);
  ASSERT_EQ(problem.varying.size(), 1u);
  EXPECT_DOUBLE_EQ(problem.varying[0].start, std::log(1.3));
  EXPECT_EQ(problem.free_starts, std::vector<Index>{0});
  EXPECT_EQ(problem.own(), 2);
  set_noise_sizes(problem.sizes, Vector{{0.2, 0.3}}, engine);
  EXPECT_TRUE(noise_sizes(engine, problem.sizes).isApprox(Vector{{0.2, 0.3}}, 1e-15));
  EXPECT_DOUBLE_EQ(*engine.laws[0]->sized().constant, 0.2);
  EXPECT_DOUBLE_EQ(*engine.laws[0]->sized().fraction, 0.3);
}

}  // namespace
}  // namespace lacuna
