// SPDX-License-Identifier: MIT
#include "core/numerics/column_kernels.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

namespace lacuna {
namespace {

constexpr Index kMost = 70;  // several vectors of any machine, and what is left of them

TEST(ColumnKernels, AnyValueThatIsNotFiniteIsSeen) {
  for (Index count = 0; count < kMost; ++count) {
    Vector values = Vector::Random(count);
    Vector copy = Vector::Zero(count + 1);
    EXPECT_TRUE(is_finite(values.data(), count));
    EXPECT_TRUE(copy_finite(values.data(), count, copy.data()));
    EXPECT_EQ(copy.head(count), values);
    EXPECT_EQ(copy[count], 0.0) << "is not its own";
    for (Index i = 0; i < count; ++i)
      for (const double bad : {std::nan(""), -std::numeric_limits<double>::infinity()}) {
        const double good = std::exchange(values[i], bad);
        EXPECT_FALSE(is_finite(values.data(), count)) << i << " of " << count;
        EXPECT_FALSE(copy_finite(values.data(), count, copy.data())) << i << " of " << count;
        values[i] = good;
      }
  }
}

TEST(ColumnKernels, TheLargestValuesAreFinite) {
  const Vector values = Vector::Constant(kMost, std::numeric_limits<double>::max());
  EXPECT_TRUE(is_finite(values.data(), kMost));
}

TEST(ColumnKernels, ProductsAreThoseOfEachRow) {
  for (Index count = 0; count < kMost; ++count) {
    const Vector a = Vector::Random(count), b = Vector::Random(count);
    Vector product = Vector::Zero(count + 1);
    multiply(a.data(), b.data(), count, product.data());
    for (Index i = 0; i < count; ++i) EXPECT_EQ(product[i], a[i] * b[i]);
    EXPECT_EQ(product[count], 0.0) << "is not its own";
    multiply(a.data(), a.data(), count, product.data());
    for (Index i = 0; i < count; ++i) EXPECT_EQ(product[i], a[i] * a[i]);
  }
}

TEST(ColumnKernels, DifferencesAreThoseOfNeighbours) {
  for (Index count = 0; count < kMost; ++count) {
    const Vector values = Vector::Random(count + 2);
    Vector x = values;
    difference(x.data(), count);
    for (Index i = 0; i < count; ++i) EXPECT_EQ(x[i], values[i + 1] - values[i]);
    EXPECT_EQ(x.tail(2), values.tail(2));
  }
}

}  // namespace
}  // namespace lacuna
