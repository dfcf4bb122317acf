// SPDX-License-Identifier: MIT
#include "lacuna/dynamics/test_systems/test_systems.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "lacuna/dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"

namespace lacuna {
namespace {

Matrix orbit(const std::string& name, double duration, double transient) {
  const TestSystem& system = test_system(name);
  const double h = system.step;
  const Solution solution = simulate(system.model, Dopri8({.substeps = 2}), system.start,
                                     sample_times(0.0, h, static_cast<Index>(duration / h)));
  EXPECT_EQ(solution.status, IntegrationStatus::Completed) << name << " " << solution.message;
  return solution.states.bottomRows(solution.states.rows() - static_cast<Index>(transient / h));
}

Vector extents(const Matrix& states) {
  return (states.colwise().maxCoeff() - states.colwise().minCoeff()).transpose();
}

void expect_extents(const std::string& name, const Vector& expected, double fraction) {
  const Vector found = extents(orbit(name, 1000.0, 100.0));
  for (Index k = 0; k < expected.size(); ++k)
    EXPECT_NEAR(found[k], expected[k], fraction * expected[k]) << name << ", state " << k;
}

TEST(TestSystems, AreOrderedAndComplete) {
  std::vector<std::string> names;
  for (const TestSystem& system : test_systems()) names.push_back(system.name);
  EXPECT_TRUE(std::is_sorted(names.begin(), names.end()));
  EXPECT_THAT(
      names, ::testing::IsSupersetOf({"rossler", "rossler-circuit", "rossler-adjusted", "tl072",
                                      "lorenz", "fitzhugh-nagumo", "chua", "duffing",
                                      "van-der-pol", "pendulum", "memristor"}));
}

TEST(TestSystems, AreDescribedWholly) {
  ASSERT_FALSE(test_systems().empty());
  for (const TestSystem& system : test_systems()) {
    EXPECT_FALSE(system.summary.empty()) << system.name;
    EXPECT_FALSE(system.reference.empty()) << system.name;
    EXPECT_GT(system.step, 0.0) << system.name;
    EXPECT_EQ(system.start.size(), system.model.dimension()) << system.name;
  }
}

TEST(TestSystems, StayBounded) {
  ASSERT_FALSE(test_systems().empty());
  for (const TestSystem& system : test_systems())
    EXPECT_LT(orbit(system.name, 300.0, 0.0).cwiseAbs().maxCoeff(), 60.0) << system.name;
}

TEST(TestSystems, AttractorsHaveTheirKnownExtents) {
  expect_extents("tl072", Vector{{4.260, 3.932, 3.912}}, 0.005);
  expect_extents("opa2134", Vector{{4.88, 4.43, 8.34}}, 0.01);
  expect_extents("rossler-adjusted", Vector{{5.17, 4.70, 7.58}}, 0.01);
  expect_extents("rossler", Vector{{20.5, 18.6, 22.8}}, 0.03);
  expect_extents("rossler-circuit", Vector{{20.5 / 4, 18.6 / 4, 22.8 / 4}}, 0.03);
  expect_extents("lorenz", Vector{{38.0, 51.5, 46.5}}, 0.05);
}

TEST(TestSystems, ChaoticOnesForgetTheirStart) {
  for (const char* name : {"chua", "duffing", "lorenz", "memristor", "rossler", "tl072"}) {
    const TestSystem& system = test_system(name);
    const Vector times =
        sample_times(0.0, system.step, static_cast<Index>(600.0 / system.step));
    Vector beside = system.start;
    beside[0] += 1e-7;
    const Solution a = simulate(system.model, Dopri8{}, system.start, times);
    const Solution b = simulate(system.model, Dopri8{}, beside, times);
    const Matrix distance = (a.states - b.states).cwiseAbs();
    EXPECT_GT(distance.maxCoeff(), 0.05 * extents(a.states).maxCoeff()) << name;
  }
}

TEST(TestSystems, ChuaVisitsBothScrolls) {
  const Matrix states = orbit("chua", 200.0, 20.0);
  EXPECT_GT(states.col(0).maxCoeff(), 1.5);
  EXPECT_LT(states.col(0).minCoeff(), -1.5);
}

TEST(TestSystems, OscillatorsReachTheirCycle) {
  EXPECT_NEAR(orbit("van-der-pol", 100.0, 50.0).col(0).maxCoeff(), 2.0086, 0.005);
  const Matrix spikes = orbit("fitzhugh-nagumo", 400.0, 200.0);
  EXPECT_GT(spikes.col(0).maxCoeff(), 1.5);
  EXPECT_LT(spikes.col(0).minCoeff(), -1.5);
}

TEST(TestSystems, PendulumComesToRest) {
  const Matrix states = orbit("pendulum", 100.0, 95.0);
  EXPECT_LT(states.cwiseAbs().maxCoeff(), 0.05);
}

TEST(TestSystems, CircuitTableIsWhole) {
  const OdeModel& model = test_system("tl072").model;
  const OdeModel& other = test_system("opa2134").model;
  for (const Equation& equation : model.equations()) EXPECT_EQ(equation.size(), 20u);
  for (const Equation& equation : other.equations()) EXPECT_EQ(equation.size(), 20u);
  EXPECT_EQ(other.coefficient(0, "1"), 0.023157);
  EXPECT_EQ(other.coefficient(2, "z^3"), 0.025367);
  EXPECT_EQ(model.coefficient(0, "1"), 0.019849);
  EXPECT_EQ(model.coefficient(2, "x*z"), 4.2853);
  EXPECT_EQ(model.coefficient(1, "z^3"), -4.1591e-05);
}

TEST(TestSystems, UnknownNameIsAnErrorWithTheNearest) {
  try {
    test_system("rosler");
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("rossler"));
  }
}

}  // namespace
}  // namespace lacuna
