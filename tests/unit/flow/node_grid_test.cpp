// SPDX-License-Identifier: MIT
#include "lacuna/flow/node_grid.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace lacuna {
namespace {

const Vector kTime{{0.0, 0.1, 0.3, 0.4, 0.5, 0.7, 0.8}};

TEST(NodeTimes, DivideEachInterval) {
  const Vector nodes = node_times(Vector{{0.0, 1.0, 3.0}}, 4);
  ASSERT_EQ(nodes.size(), 9);
  EXPECT_DOUBLE_EQ(nodes[3], 0.75);
  EXPECT_DOUBLE_EQ(nodes[5], 1.5);
  EXPECT_EQ(nodes[8], 3.0);
}

TEST(NodeSlots, HoldTheSamplesAndACubicBetween) {
  Matrix values(7, 2);
  values << kTime.array().cube(), Vector::Random(7);
  const Matrix slots = node_slots(kTime, values, 2);
  ASSERT_EQ(slots.rows(), 13);
  ASSERT_EQ(slots.cols(), 3);
  const Vector at_samples = slots.col(1)(Eigen::seq(0, 12, 2));
  EXPECT_EQ(at_samples, values.col(1)) << "to the bit";
  EXPECT_LT((slots.col(0).array() - slots.col(2).array().cube()).abs().maxCoeff(), 1e-15);
  EXPECT_DOUBLE_EQ(slots(3, 2), 0.2);
}

TEST(NodeSlots, GoOnBetweenSamplesAsTold) {
  const Matrix values = Vector::LinSpaced(7, 0.0, 6.0).array().square();
  EXPECT_EQ(node_slots(kTime, values, 2, Interpolation::Held)(5, 0), 4.0);
  EXPECT_DOUBLE_EQ(node_slots(kTime, values, 2, Interpolation::Linear)(5, 0), 6.5);
}

TEST(DelayedSlots, AreWhatWasBefore) {
  Matrix values(7, 1);
  values << kTime.array().square();
  const Matrix slots = node_slots(kTime, values, 4);
  const Matrix past = delayed_slots(slots, 4, {{0, 0.15}});
  ASSERT_EQ(past.cols(), 1);
  for (Index i = 0; i < slots.rows(); ++i) {
    const double then = std::max(slots(i, 1) - 0.15, 0.0);
    EXPECT_NEAR(past(i, 0), then * then, 1e-14) << "the first sample holds before it";
  }
}

}  // namespace
}  // namespace lacuna
