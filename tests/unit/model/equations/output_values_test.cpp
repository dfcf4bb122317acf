// SPDX-License-Identifier: MIT
#include "model/equations/output_values.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

OdeModel model() {
  return OdeModel({{"x", ""}, {"v", ""}}, {{"u", ""}}, {{}, {}})
      .with_outputs(
          {{"y", "", parse_expression("abs(v)*u+t")}, {"z", "", parse_expression("exp(x)")}});
}

TEST(OutputValues, AreTheFormulasAlongTheOrbit) {
  const Vector time = (Vector(2) << 10.0, 20.0).finished();
  const Matrix states = (Matrix(2, 2) << 0.0, -2.0, 1.0, 3.0).finished();
  const Matrix inputs = (Matrix(2, 1) << 4.0, 5.0).finished();
  const Matrix values = output_values(model(), time, states, inputs);
  EXPECT_EQ(values, (Matrix(2, 2) << 18.0, 1.0, 35.0, std::exp(1.0)).finished());
  EXPECT_EQ(output_values(model().with_outputs({}), time, states, inputs).cols(), 0);
}

TEST(OutputValues, ShapesHaveToFit) {
  EXPECT_THROW(output_values(model(), Vector::Zero(2), Matrix::Zero(2, 1), Matrix::Zero(2, 1)),
               ArgumentError);
}

}  // namespace
}  // namespace lacuna
