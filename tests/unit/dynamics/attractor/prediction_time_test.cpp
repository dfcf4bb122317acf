// SPDX-License-Identifier: MIT
#include "dynamics/attractor/prediction_time.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lacuna/core/base/error.hpp"
#include "lacuna/dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/test_systems/measurement.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"

namespace lacuna {
namespace {

OdeModel drift(double speed) {
  const Variables names{{"x"}, {}};
  return OdeModel({{"x", ""}}, {}, {{{Term::parse("1", names), speed, {}, {}}}});
}

TEST(ValidPredictionTime, EndsWhereTheErrorPassesTheThreshold) {
  const Dataset ramp = record_of(drift(1.0), Rk4{}, Vector{{0.0}}, 0.01, 1001);
  // x = t for 10 time units has a standard deviation of 10 / sqrt(12); the error of 2 t is t.
  const PredictionTime time =
      valid_prediction_time(drift(2.0), ramp, Rk4{}, {.threshold = 0.4, .starts = 2});
  EXPECT_NEAR(time.median, 4.0 / std::sqrt(12.0), 0.011);
  EXPECT_EQ(time.times.size(), 2);
  EXPECT_EQ(time.cut_off, 0);
}

TEST(ValidPredictionTime, OfTheTrueModelEndsWithTheRecord) {
  const Dataset ramp = record_of(drift(1.0), Rk4{}, Vector{{0.0}}, 0.01, 1001);
  const PredictionTime time = valid_prediction_time(drift(1.0), ramp, Rk4{}, {.starts = 1});
  EXPECT_EQ(time.cut_off, 1);
  EXPECT_NEAR(time.median, 10.0, 1e-9);
}

TEST(ValidPredictionTime, OfAChaoticSystemFallsWithTheErrorOfTheModel) {
  const TestSystem& lorenz = test_system("lorenz");
  const Dataset record = record_of(lorenz.model, Dopri8{}, lorenz.start, 0.01, 6000);
  const auto median = [&](double change) {
    const Term term = lorenz.model.equations()[0][0].term;
    const OdeModel model = lorenz.model.with_term(0, {term, change, {}, {}});
    return valid_prediction_time(model, record, Dopri8{}).median;
  };
  EXPECT_GT(median(1e-8), median(1e-4) + 5.0);
  EXPECT_GT(median(1e-4), median(1e-1) + 3.0);
}

}  // namespace
}  // namespace lacuna
