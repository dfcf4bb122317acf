// SPDX-License-Identifier: MIT
#include "dynamics/test_systems/rossler_circuit.hpp"

#include <gtest/gtest.h>

#include "lacuna/core/base/error.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"

namespace lacuna {
namespace {

TEST(RosslerCircuit, IdealPartsGiveTheOriginalSystem) {
  const OdeModel circuit = rossler_circuit({.r4 = 50.0});
  const OdeModel& original = test_system("rossler-circuit").model;
  for (Index k = 0; k < 3; ++k)
    for (const char* term : {"1", "x", "y", "z", "x*z"})
      EXPECT_NEAR(circuit.coefficient(k, term), original.coefficient(k, term), 1e-14)
          << "equation " << k << ", term " << term;
}

TEST(RosslerCircuit, MeasuredPartsGiveTheAdjustedSystem) {
  const OdeModel circuit = rossler_circuit(RosslerComponents::measured());
  EXPECT_NEAR(circuit.coefficient(0, "y"), -100.0 / (9.60 * 10.1), 1e-12);
  EXPECT_NEAR(circuit.coefficient(0, "z"), -100.0 / (9.38 * 10.1), 1e-12);
  EXPECT_NEAR(circuit.coefficient(1, "x"), 100.0 / 96.4, 1e-12);
  EXPECT_NEAR(circuit.coefficient(1, "y"), 100.0 / 415.0, 1e-12);
  EXPECT_NEAR(circuit.coefficient(2, "1"), 0.2 * 100.0 / (38.2 * 9.9), 1e-12);
  EXPECT_NEAR(circuit.coefficient(2, "x*z"), 100.0 / (9.9 * 9.9) * 9.99 / 2.21, 1e-12);
  EXPECT_NEAR(circuit.coefficient(2, "z"), -100.0 / (9.9 * 9.9) * 9.99 * 5.7 / 9.12, 1e-12);
}

}  // namespace
}  // namespace lacuna
