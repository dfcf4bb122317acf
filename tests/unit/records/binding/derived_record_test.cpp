// SPDX-License-Identifier: MIT
#include "records/binding/derived_record.hpp"

#include <gtest/gtest.h>

#include "lacuna/core/base/error.hpp"
#include "lacuna/data/derivatives/finite_differences.hpp"
#include "lacuna/data/derivatives/savitzky_golay.hpp"
#include "support/oscillation.hpp"

namespace lacuna {
namespace {

TEST(WithDerivatives, ComputesThem) {
  const Trajectory record = oscillation(200);
  const Trajectory derived = with_derivatives(record, FiniteDifferences{{.order = 8}});
  EXPECT_LT((derived.derivatives.col(0) - record.states.col(1)).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_EQ(derived.states, record.states);
}

TEST(WithDerivatives, SmoothsStatesAndInputsAlike) {
  const Trajectory record = oscillation(200);
  const SavitzkyGolay method{{.window = 31, .degree = 2}};
  const Trajectory smooth = with_derivatives(record, method);
  EXPECT_EQ(smooth.states, method.differentiate(record.time, record.states, 0));
  EXPECT_EQ(smooth.inputs, method.differentiate(record.time, record.inputs, 0));
  EXPECT_GT((smooth.states - record.states).norm(), 1e-6);
  const Trajectory raw = with_derivatives(record, method, false);
  EXPECT_EQ(raw.states, record.states);
  EXPECT_EQ(raw.inputs, record.inputs);
}

TEST(WithDerivatives, LeavesARecordThatBringsThemAlone) {
  Trajectory record = oscillation(50);
  give_derivatives(record);
  const Trajectory derived = with_derivatives(record, SavitzkyGolay{});
  EXPECT_EQ(derived.derivatives, record.derivatives);
  EXPECT_EQ(derived.states, record.states);
}

TEST(DifferentiateRecord, NamesTheRecordThatIsTooShort) {
  const Trajectory record = oscillation(4);
  try {
    differentiate_record(record, record.states, FiniteDifferences{{.order = 4}}, 1);
    FAIL();
  } catch (const DataError& error) {
    EXPECT_NE(error.where().find("run.csv"), std::string::npos) << error.what();
    EXPECT_NE(error.problem().find("at least 5 samples"), std::string::npos);
  }
}

}  // namespace
}  // namespace lacuna
