// SPDX-License-Identifier: MIT
#include "lacuna/dynamics/integration/integrator.hpp"

#include <cmath>

#include "contract/contract.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"

namespace lacuna::contract {
namespace {

const auto harmonic_rates = [](double, const double* x, double* dxdt) {
  dxdt[0] = x[1];
  dxdt[1] = -x[0];
};

class EveryIntegrator : public testing::TestWithParam<StageVariant> {
 protected:
  Stage<Integrator> integrator() const { return stage_of<Integrator>(GetParam()); }

  /// Error after two periods with `steps` samples.
  double error(Index steps) const {
    const double end = 4.0 * std::acos(-1.0);
    const Vector times = sample_times(0.0, end / static_cast<double>(steps), steps + 1);
    const Solution orbit =
        integrator()->integrate(harmonic_rates, Eigen::Vector2d(1.0, 0.0), times);
    EXPECT_EQ(orbit.status, IntegrationStatus::Completed) << orbit.message;
    return (orbit.end_state - Eigen::Vector2d(1.0, 0.0)).norm();
  }
};

TEST_P(EveryIntegrator, ErrorFallsWithItsOrderOrIsBelowItsTolerance) {
  const double coarse = error(20);
  const double fine = error(40);
  const double observed = std::log2(coarse / fine);
  EXPECT_TRUE(fine < 1e-8 || observed > integrator()->order() - 0.7)
      << coarse << " then " << fine << ", order " << observed;
}

TEST_P(EveryIntegrator, SamplesEveryTimeAskedFor) {
  const Vector times = Eigen::Vector4d(1.0, 1.5, 1.75, 4.0);
  const Solution orbit =
      integrator()->integrate(harmonic_rates, Eigen::Vector2d(1.0, 0.0), times);
  EXPECT_EQ(orbit.time, times);
  EXPECT_EQ(orbit.states.rows(), 4);
  EXPECT_EQ(orbit.states(0, 0), 1.0);
}

TEST_P(EveryIntegrator, ReportsDivergenceWithTimeAndState) {
  const auto explode = [](double, const double* x, double* dxdt) { dxdt[0] = x[0] * x[0]; };
  const Vector start = Vector::Constant(1, 1.0);
  const Solution orbit = integrator()->integrate(explode, start, sample_times(0.0, 0.01, 300));
  EXPECT_NE(orbit.status, IntegrationStatus::Completed);
  EXPECT_FALSE(orbit.message.empty());
  EXPECT_NEAR(orbit.end_time, 1.0, 0.1);
  EXPECT_TRUE(orbit.end_state.allFinite());
}

TEST_P(EveryIntegrator, RefusesBadTimesAndStarts) {
  const Vector backwards = Eigen::Vector2d(1.0, 0.0);
  const Vector start = Eigen::Vector2d(1.0, 0.0);
  EXPECT_THROW(integrator()->integrate(harmonic_rates, start, backwards), ArgumentError);
  const Vector unfinished = Eigen::Vector2d(1.0, std::nan(""));
  EXPECT_THROW(integrator()->integrate(harmonic_rates, unfinished, sample_times(0.0, 0.1, 3)),
               ArgumentError);
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryIntegrator,
                         testing::ValuesIn(available(Integrator::kKind)), test_name);

}  // namespace
}  // namespace lacuna::contract
