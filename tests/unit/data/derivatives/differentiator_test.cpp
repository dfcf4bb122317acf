// SPDX-License-Identifier: MIT
#include "lacuna/data/derivatives/differentiator.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "lacuna/core/base/options.hpp"

namespace lacuna {
namespace {

struct MarkerOptions {
  static constexpr StageInfo kInfo{"marker", "", ""};
  void describe(OptionVisitor&) {}
};

/// Gives the order back, to see that the checked call reaches the hook.
class Marker final : public Configured<Differentiator, MarkerOptions> {
 public:
  using Configured::Configured;

 private:
  Matrix do_differentiate(const Vector&, const Eigen::Ref<const Matrix>& values,
                          int order) const override {
    return Matrix::Constant(values.rows(), values.cols(), order);
  }
};

const Vector kTime = Vector::LinSpaced(5, 0.0, 1.0);
const Matrix kValues = Matrix::Ones(5, 2);

std::string data_error(const Vector& time, const Matrix& values) {
  try {
    Marker{}.differentiate(time, values);
  } catch (const DataError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Differentiator, UsableArgumentsReachTheMethod) {
  EXPECT_EQ(Marker{}.differentiate(kTime, kValues, 3), Matrix::Constant(5, 2, 3.0));
}

TEST(Differentiator, TimeMustIncrease) {
  Vector time = kTime;
  time[3] = time[2];
  EXPECT_NE(data_error(time, kValues).find("sample 4"), std::string::npos);
}

TEST(Differentiator, ValuesMustBeFinite) {
  Matrix values = kValues;
  values(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(data_error(kTime, values).find("column 2 is not finite at sample 2"),
            std::string::npos);
}

}  // namespace
}  // namespace lacuna
