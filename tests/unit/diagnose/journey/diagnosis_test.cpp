// SPDX-License-Identifier: MIT
#include "lacuna/diagnose/journey/diagnosis.hpp"

#include <gtest/gtest.h>

namespace lacuna {
namespace {

TEST(DiagnosisTypes, VerdictsAreTheWordsOfTheReport) {
  EXPECT_EQ(to_string(Verdict::NoDiscrepancy), "no-discrepancy");
  EXPECT_EQ(to_string(Verdict::CoefficientsOnly), "coefficients-only");
  EXPECT_EQ(to_string(Verdict::Explained), "explained");
  EXPECT_EQ(to_string(Verdict::PartlyExplained), "partly-explained");
  EXPECT_EQ(to_string(Verdict::UnnamedStructure), "unnamed-structure");
  EXPECT_EQ(to_string(Verdict::Undetermined), "undetermined");
  EXPECT_EQ(to_string(Verdict::Incomplete), "incomplete");
}

TEST(DiagnosisTypes, AnIntervalHasTheWidthOfANormalDistribution) {
  const CoefficientChange change{0, "q", 1.0, 2.0, 0.5, 2.0};
  EXPECT_NEAR(change.ci95()[0], 2.0 - 1.959964 * 0.5, 1e-6);
  EXPECT_NEAR(change.ci95()[1], 2.0 + 1.959964 * 0.5, 1e-6);
}

}  // namespace
}  // namespace lacuna
