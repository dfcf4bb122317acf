// SPDX-License-Identifier: MIT
#include "regression/linear/weighted_rows.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

TEST(WeightedRows, RefuseWeightsThatAreNegativeOrNotFinite) {
  const auto rows = make_row_source(Matrix::Ones(20, 1), Matrix::Ones(20, 1));
  for (const double bad : {-1.0, std::numeric_limits<double>::infinity(),
                           std::numeric_limits<double>::quiet_NaN()}) {
    const auto weights = [bad](const Eigen::Ref<const Vector>&, Eigen::Ref<Vector> w) {
      w.setOnes();
      w[3] = bad;
    };
    const auto weighted = make_weighted_rows(*rows, {0, {0}, Vector::Ones(1)}, weights);
    Matrix theta(8, 1);
    Matrix target(8, 1);
    EXPECT_THROW(weighted->open()->read(8, theta, target), ArgumentError);
  }
}

}  // namespace
}  // namespace lacuna
