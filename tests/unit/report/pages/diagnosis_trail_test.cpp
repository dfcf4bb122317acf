// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "lacuna/report/pages/diagnosis_report.hpp"
#include "support/driven_oscillator.hpp"

namespace lacuna {
namespace {

Diagnosis with_rivals(std::vector<Rival> rivals) {
  const OdeModel model = support::oscillator();
  Diagnosis diagnosis{Verdict::Explained, model, {}, {}, {}, {}, {}, model, {}, {}, {}, {}};
  diagnosis.rivals = std::move(rivals);
  return diagnosis;
}

TEST(DiagnosisTrail, EachCompositeHasItsNumberOrItsRule) {
  const std::string text = format_trail(with_rivals(
      {{"named-effects", "dry in dv/dt: sign(v)", 790.0, true, "significance", 12.5, 3.0},
       {"coloured-noise", "noise with a memory", 812.25, false, "extended-bic", 812.25, 790.0},
       {"unmeasured-input", "nothing is missing", {}, true, "criterion", 1.0, 2.0, "a rule"}}));
  EXPECT_EQ(text,
            "Composite models of the records, in the order in which they were judged:\n"
            "  + named-effects     dry in dv/dt: sign(v)\n"
            "      significance 12.5 against 3\n"
            "  - coloured-noise    noise with a memory\n"
            "      extended-bic 812.25 against 790\n"
            "  + unmeasured-input  nothing is missing\n"
            "      a rule\n"
            "(+ taken over what was best before, - not taken)\n");
}

}  // namespace
}  // namespace lacuna
