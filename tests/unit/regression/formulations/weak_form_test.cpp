// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.hpp"
#include "lacuna/regression/formulations/integral_form.hpp"
#include "lacuna/regression/formulations/weak_form.hpp"
#include "lacuna/regression/linear/subproblem.hpp"
#include "regression/formulations/test_functions.hpp"
#include "support/oscillation.hpp"

namespace lacuna {
namespace {

TermLibrary oscillator_terms() {
  TermLibrary library{{{"x", "v"}, {"u"}}, {}};
  for (const char* text : {"x", "v", "u"})
    library.terms.push_back(Term::parse(text, library.variables));
  return library;
}

Dataset noisy(double sigma, Index n = 2000) {
  Dataset data = oscillation_data(n);
  Random random(5);
  for (Index i = 0; i < data.trajectories[0].states.size(); ++i)
    data.trajectories[0].states.data()[i] += sigma * random.normal();
  return data;
}

TEST(WeakForm, FindsCoefficientsOfACleanRecord) {
  const auto system = WeakForm{}.assemble(oscillation_data(), oscillator_terms());
  EXPECT_LT((system.subproblem(1, {0, 1, 2}).solve() - Eigen::Vector3d(-4, 0, 0)).norm(), 1e-6);
}

TEST(WeakForm, FindsThemInNoise) {
  const auto system = WeakForm{}.assemble(noisy(0.05), oscillator_terms());
  const Vector h = system.subproblem(1, {0, 1, 2}).solve();
  EXPECT_NEAR(h[0], -4.0, 0.1);
  EXPECT_NEAR(h[1], 0.0, 0.1);
}

TEST(WeakForm, ResidualIsTheNoiseOfTheState) {
  const double sigma = 0.01;
  Dataset data = noisy(sigma, 4000);
  data.trajectories[0].states.col(1) = 2.0 * (2.0 * data.trajectories[0].time.array()).cos();
  const auto system = WeakForm{}.assemble(data, oscillator_terms());
  const double rms = system.subproblem(0, {0, 1, 2}).residual_norm() /
                     std::sqrt(static_cast<double>(system.rows()));
  EXPECT_NEAR(rms, sigma, 0.2 * sigma);
  EXPECT_EQ((*WeakForm{}.target_noise(data, Eigen::Vector2d(sigma, 1.0)))[0], sigma);
}

TEST(ChooseTestFunction, WidensWithNoiseAndWithTheStep) {
  const double clean = choose_test_function(noisy(1e-4)).radius;
  EXPECT_GT(choose_test_function(noisy(0.1)).radius, clean);
  Dataset slow = noisy(1e-4);
  slow.trajectories[0].time *= 100.0;
  EXPECT_NEAR(choose_test_function(slow).radius, 100.0 * clean, 1e-6 * clean);
}

TEST(ChooseTestFunction, KeepsWhatIsGiven) {
  const TestFunction phi = choose_test_function(noisy(0.01), {.radius = 0.3, .order = 5});
  EXPECT_EQ(phi.radius, 0.3);
  EXPECT_EQ(phi.order, 5);
  EXPECT_LT(test_function_spacing(phi), 0.3);
}

TEST(ChooseTestFunction, FitsIntoShortRecords) {
  const TestFunction phi = choose_test_function(noisy(0.1, 30));
  EXPECT_LE(4.0 * phi.radius, 0.29 + 1e-12);
}

TermLibrary terms() {
  TermLibrary library{{{"x", "v"}, {"u"}}, {}};
  for (const char* text : {"x", "v"})
    library.terms.push_back(Term::parse(text, library.variables));
  return library;
}

TEST(IntegralForm, FindsAnOscillatorsCoefficients) {
  const auto system = IntegralForm{{.span = 20}}.assemble(oscillation_data(), terms());
  EXPECT_EQ(system.rows(), 38);
  EXPECT_LT((system.subproblem(1, {0, 1}).solve() - Eigen::Vector2d(-4, 0)).norm(), 1e-6);
}

TEST(IntegralForm, RefusesASpanBeyondTheRecord) {
  EXPECT_THROW(IntegralForm{{.span = 500}}.assemble(oscillation_data(), terms()), DataError);
}

}  // namespace
}  // namespace lacuna
