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

}  // namespace
}  // namespace lacuna
