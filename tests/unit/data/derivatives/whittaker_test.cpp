// SPDX-License-Identifier: MIT
#include "lacuna/data/derivatives/whittaker.hpp"

#include <gtest/gtest.h>

#include "core/base/random.hpp"
#include "data/derivatives/sample_differences.hpp"
#include "grids.hpp"

namespace lacuna {
namespace {

Vector rough_cosine(const Vector& time, double noise) {
  Random random(9);
  Vector y = time.array().cos();
  for (Index i = 0; i < y.size(); ++i) y[i] += noise * random.normal();
  return y;
}

TEST(Whittaker, IsTheDenseSolution) {
  const Vector time = jittered_grid(50, 5.0);
  const Vector y = rough_cosine(time, 0.1);
  const double lambda = 0.02, step = (time[49] - time[0]) / 49.0;
  const Matrix d = divided_differences(time, 3);
  const Matrix inverse =
      (Matrix::Identity(50, 50) + lambda * step * d.transpose() * d).inverse();
  const Whittaker method{{.lambda = lambda}};
  EXPECT_LT(relative_error(method.differentiate(time, y, 0), inverse * y), 1e-8);
  const double noise = (y - inverse * y).norm() / std::sqrt(50.0 - inverse.trace());
  EXPECT_LT(relative_error(*method.standard_error(time, y, 0),
                           noise * inverse.diagonal().cwiseSqrt()),
            1e-8);
  EXPECT_FALSE(method.standard_error(time, y, 1));
}

TEST(Whittaker, RatesFollowTheSignal) {
  const Vector time = uniform_grid(400, 12.0);
  for (const auto choice : {PenaltyChoice::Gcv, PenaltyChoice::Reml, PenaltyChoice::Noise}) {
    const Vector rate =
        Whittaker{{.choice = choice}}.differentiate(time, rough_cosine(time, 0.1));
    EXPECT_LT((rate.array() + time.array().sin()).matrix().norm() / 20.0, 0.2);
  }
}

}  // namespace
}  // namespace lacuna
