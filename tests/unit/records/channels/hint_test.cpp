// SPDX-License-Identifier: MIT
#include "lacuna/records/channels/hint.hpp"

#include <gtest/gtest.h>

namespace lacuna {
namespace {

TEST(Hint, TheMostThatOneWithholdsIsWhatAllDo) {
  EXPECT_EQ(withheld_by({}), Withheld::Nothing);
  EXPECT_EQ(withheld_by({{HintKind::Sampling, "m", "r"},
                         {HintKind::Sign, "m", "r", Withheld::Names},
                         {HintKind::Excitation, "m", "r", Withheld::Claims}}),
            Withheld::Claims);
}

TEST(Hint, KindsHaveTheNamesOfTheFormat) {
  EXPECT_EQ(to_string(HintKind::TimeUnit), "time-unit");
  EXPECT_EQ(to_string(HintKind::NotIdentifiable), "not-identifiable");
  EXPECT_EQ(to_string(HintKind::DiscreteMap), "discrete-map");
}

}  // namespace
}  // namespace lacuna
