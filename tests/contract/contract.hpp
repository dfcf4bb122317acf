// SPDX-License-Identifier: MIT
// What the contract suites share: all registered parts and a small good problem.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <ostream>
#include <string>
#include <vector>

#include "cli/configuration/variants.hpp"
#include "core/base/random.hpp"
#include "lacuna/regression/linear/least_squares_system.hpp"

namespace lacuna {

/// Names of parameters in the output of the tests.
inline void PrintTo(const StageVariant& variant, std::ostream* out) { *out << variant.label; }
inline void PrintTo(const RegistryEntry& entry, std::ostream* out) {
  *out << entry.kind << " " << entry.info.name;
}

}  // namespace lacuna

namespace lacuna::contract {

/// Every variant of a kind that this build has.
inline std::vector<StageVariant> available(std::string_view kind) {
  std::vector<StageVariant> all;
  for (StageVariant& variant : variants(default_registry(), kind))
    if (variant.unavailable.empty()) all.push_back(std::move(variant));
  return all;
}

/// "irls_l1_ceres_" from "irls-l1[ceres]".
inline std::string test_name(const testing::TestParamInfo<StageVariant>& info) {
  std::string name = info.param.label;
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return name;
}

/// The stage of a variant as its plug point.
template <class Interface>
Stage<Interface> stage_of(const StageVariant& variant) {
  return Stage<Interface>(std::dynamic_pointer_cast<const Interface>(variant.stage));
}

inline constexpr Index kRows = 400;
inline constexpr Index kTerms = 6;

/// Coefficients of the small good problem: terms 1 and 4 count.
inline Vector true_coefficients() {
  Vector h = Vector::Zero(kTerms);
  h[1] = 2.0;
  h[4] = -0.75;
  return h;
}

/// n x 6 standard normal entries.
inline Matrix good_columns() {
  Random random(7);
  Matrix theta(kRows, kTerms);
  for (Index j = 0; j < kTerms; ++j)
    for (Index i = 0; i < kRows; ++i) theta(i, j) = random.normal();
  return theta;
}

/// A system over the given columns with the target Theta h plus noise.
inline LeastSquaresSystem system_over(const Matrix& theta, double noise = 0.0,
                                      int threads = 1) {
  Random random(11);
  Matrix target = theta.leftCols(kTerms) * true_coefficients();
  for (Index i = 0; i < target.rows(); ++i) target(i, 0) += noise * random.normal();
  std::vector<std::string> names;
  for (Index j = 0; j < theta.cols(); ++j) names.push_back("c" + std::to_string(j));
  RunContext context;
  context.threads = threads;
  return {make_row_source(theta, target), names, {"y"}, context};
}

/// Well-conditioned and without noise.
inline LeastSquaresSystem good_system() { return system_over(good_columns()); }

/// Whether kept and removed are disjoint and together `all`.
template <class Result>
void expect_partition(const Result& result, const TermSet& all) {
  TermSet together = result.kept;
  EXPECT_TRUE(std::is_sorted(together.begin(), together.end()));
  for (const auto& removal : result.removed) {
    together.push_back(removal.term);
    EXPECT_FALSE(removal.quantity.empty());
    EXPECT_GE(removal.step, 1);
  }
  std::sort(together.begin(), together.end());
  EXPECT_EQ(together, all);
}

}  // namespace lacuna::contract
