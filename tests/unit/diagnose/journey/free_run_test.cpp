// SPDX-License-Identifier: MIT
#include "diagnose/journey/free_run.hpp"

#include <gtest/gtest.h>

#include "support/assimilated_oscillator.hpp"

namespace lacuna {
namespace {

class FreeRun : public ::testing::Test {
 protected:
  std::optional<RunApart> run(const OdeModel& model, Index least = 20) const {
    const std::vector<Matrix> paths{data_.trajectories[0].states};
    NoiseModel noise;
    noise.measurement = {0.01, 0.01};
    noise.coloured.resize(2);
    noise.disturbance = Vector::Zero(2);
    const Matrix& x = paths[0];
    const Vector scale = ((x.rowwise() - x.colwise().mean()).colwise().squaredNorm() /
                          static_cast<double>(x.rows()))
                             .cwiseSqrt()
                             .transpose();
    return run_freely({model, paths, data_, noise, scale, {0}}, least, RunContext{});
  }
  /// The oscillator with another coefficient of v in dv/dt.
  static OdeModel with_damping(double damping) {
    OdeModel model = support::oscillator();
    std::vector<Equation> equations = model.equations();
    for (WeightedTerm& summand : equations[1])
      if (summand.term.name() == "v") summand.coefficient = damping;
    return model.with_equations(std::move(equations));
  }

  Dataset data_ = support::hidden_record(support::nothing, 0.001, 3);
};

TEST_F(FreeRun, OfTheTrueModelStaysOnTheRecord) {
  const auto apart = run(support::oscillator());
  ASSERT_TRUE(apart);
  EXPECT_LT(apart->apart, 0.02);
  EXPECT_NEAR(apart->duration, data_.trajectories[0].duration(), 1e-9);
}

TEST_F(FreeRun, OfAWrongModelIsApart) {
  const auto apart = run(with_damping(-3.0));
  ASSERT_TRUE(apart);
  EXPECT_GT(apart->apart, 0.3);
}

TEST_F(FreeRun, OfOneThatEndsIsInfinite) {
  const OdeModel model = support::oscillator();
  const OdeModel ends = model.with_term(
      1, {.term = Term::parse("10/max(0.01,1-t)", model.variables()), .coefficient = 1e15});
  const auto apart = run(ends, 1);
  ASSERT_TRUE(apart);
  EXPECT_TRUE(std::isinf(apart->apart));
}

TEST_F(FreeRun, IsNothingWhereRecordsAreShorterThanAWindow) {
  EXPECT_FALSE(run(support::oscillator(), 100000));
}

}  // namespace
}  // namespace lacuna
