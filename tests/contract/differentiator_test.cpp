// SPDX-License-Identifier: MIT
#include "lacuna/data/derivatives/differentiator.hpp"

#include "contract/contract.hpp"

namespace lacuna::contract {
namespace {

class EveryDifferentiator : public testing::TestWithParam<StageVariant> {
 protected:
  Matrix differentiate(const Vector& time, const Matrix& values, int order = 1) const {
    return stage_of<Differentiator>(GetParam())->differentiate(time, values, order);
  }
};

Vector uniform_grid() { return Vector::LinSpaced(101, 0.0, 2.0); }

/// Steps between 0.5 and 1.5 times the mean.
Vector uneven_grid() {
  Random random(3);
  Vector time(101);
  time[0] = 0.0;
  for (Index i = 1; i < time.size(); ++i) time[i] = time[i - 1] + random.uniform(0.01, 0.03);
  return time;
}

TEST_P(EveryDifferentiator, IsExactForParabolas) {
  for (const Vector& time : {uniform_grid(), uneven_grid()}) {
    Matrix values(time.size(), 2);
    values << time.array().square().matrix(), (1.0 - 3.0 * time.array()).matrix();
    const Matrix first = differentiate(time, values);
    const Matrix second = differentiate(time, values, 2);
    EXPECT_LT((first.col(0) - 2.0 * time).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_LT((first.col(1).array() + 3.0).abs().maxCoeff(), 1e-9);
    EXPECT_LT((second.col(0).array() - 2.0).abs().maxCoeff(), 1e-6);
    EXPECT_LT(second.col(1).cwiseAbs().maxCoeff(), 1e-6);
  }
}

TEST_P(EveryDifferentiator, OrderZeroIsTheSignal) {
  const Vector time = uniform_grid();
  const Matrix values = time.array().square().matrix();
  EXPECT_LT((differentiate(time, values, 0) - values).cwiseAbs().maxCoeff(), 1e-12);
}

TEST_P(EveryDifferentiator, FollowsASine) {
  const Vector time = uniform_grid();
  const Matrix rate = differentiate(time, time.array().sin().matrix());
  EXPECT_LT((rate.array() - time.array().cos()).abs().maxCoeff(), 1e-3);
}

TEST_P(EveryDifferentiator, RefusesTooFewSamplesAndShapesThatDoNotFit) {
  const Vector two = Vector::LinSpaced(2, 0.0, 1.0);
  EXPECT_THROW(differentiate(two, Matrix(two)), DataError);
  EXPECT_THROW(differentiate(uniform_grid(), Matrix::Zero(5, 1)), ArgumentError);
  EXPECT_THROW(differentiate(uniform_grid(), Matrix(uniform_grid()), -1), ArgumentError);
}

TEST_P(EveryDifferentiator, GoesOnOverAGap) {
  const Vector all = uniform_grid();
  Vector time(91);
  time << all.head(45), all.tail(46);
  const Matrix rate = differentiate(time, time.array().sin().matrix());
  EXPECT_LT((rate.array() - time.array().cos()).abs().maxCoeff(), 0.01);
}

TEST_P(EveryDifferentiator, StandardErrorsAreOfTheShapeAndOfTheSizeOfTheErrors) {
  const Vector time = Vector::LinSpaced(300, 0.0, 6.0);
  Random random(9);
  Matrix values(300, 2);
  values << time.array().sin().matrix(), time.array().cos().matrix();
  for (Index i = 0; i < 300; ++i)
    for (Index k = 0; k < 2; ++k) values(i, k) += 0.05 * random.normal();
  const auto method = stage_of<Differentiator>(GetParam());
  const auto errors = method->standard_error(time, values);
  if (!errors) return;
  ASSERT_EQ(errors->rows(), 300);
  ASSERT_EQ(errors->cols(), 2);
  EXPECT_GT(errors->minCoeff(), 0.0);
  const Vector off = method->differentiate(time, values).col(0) - time.array().cos().matrix();
  const double ratio = off.norm() / errors->col(0).norm();
  EXPECT_GT(ratio, 0.2);
  EXPECT_LT(ratio, 5.0);
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryDifferentiator,
                         testing::ValuesIn(available(Differentiator::kKind)), test_name);

}  // namespace
}  // namespace lacuna::contract
