// SPDX-License-Identifier: MIT
#include "lacuna/diagnose/criterion/criterion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "lacuna/core/base/options.hpp"

namespace lacuna {
namespace {

inline constexpr StageInfo kTwo{"two", "Two a parameter, for tests", ""};

struct TwoOptions {
  static constexpr const StageInfo& kInfo = kTwo;
  void describe(OptionVisitor&) {}
};

class Two final : public Configured<Criterion, TwoOptions> {
  double do_penalty(const Evidence& evidence) const override {
    return 2.0 * evidence.parameters;
  }
};

TEST(Criterion, IsTheDevianceAndThePenalty) {
  EXPECT_DOUBLE_EQ(Two{}.value({10.0, 3.0, 100.0, 0.0}), 16.0);
  EXPECT_DOUBLE_EQ(Two{}.penalty({10.0, 3.0, 100.0, 0.0}), 6.0);
}

TEST(Criterion, AFitThatFailedIsTheWorst) {
  for (const double deviance :
       {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    EXPECT_EQ(Two{}.value({deviance, 1.0, 10.0, 0.0}), std::numeric_limits<double>::infinity());
}

TEST(Criterion, RefusesCountsThatAreNone) {
  EXPECT_THROW(Two{}.value({0.0, -1.0, 10.0, 0.0}), ArgumentError);
  EXPECT_THROW(Two{}.value({0.0, 1.0, std::nan(""), 0.0}), ArgumentError);
  EXPECT_THROW(Two{}.penalty({0.0, 1.0, 10.0, -0.1}), ArgumentError);
}

}  // namespace
}  // namespace lacuna
