// SPDX-License-Identifier: MIT
// A new form is one value and one line on a copy of the registry.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "lacuna/cli/configuration/registry.hpp"
#include "lacuna/diagnose/journey/diagnose.hpp"
#include "lacuna/effects/effect_family.hpp"
#include "lacuna/effects/forms.hpp"
#include "lacuna/effects/patterns.hpp"
#include "lacuna/effects/terms.hpp"
#include "support/driven_oscillator.hpp"

namespace lacuna {
namespace {

constexpr const char* kPower = "sign(x)*abs(x)^1.5";

std::vector<Candidate> forms(const Scope& scope, Index) {
  std::vector<Candidate> result;
  for (const Expression& x : all_variables(scope))
    result.push_back(plain_candidate(formula(scope, kPower, {{"x", x}}), x));
  return result;
}

std::optional<Reading> reading(const FittedForm& fitted) {
  if (!has_form(fitted.candidate, kPower)) return std::nullopt;
  return Reading{"power 3/2 of " + fitted.candidate.argument.to_string()};
}

const EffectFamily kThreeHalves{{"three-halves", "A term in the power 3/2", ""},
                                "a sphere that is pressed",
                                forms,
                                reading};

double hidden(double, double q, double) {
  return -1.5 * std::copysign(std::pow(std::abs(q), 1.5), q);
}

TEST(OwnForm, IsFoundAndNamedAmongAllOthers) {
  Registry registry = default_registry();
  registry.add<FamilyEffect<kThreeHalves>>();
  DiagnosisOptions options;
  options.effects = registry.make_all<Effect>();
  const Diagnosis diagnosis =
      diagnose(support::oscillator(), support::hidden_record(hidden, 0.001, 3),
               support::hidden_record(hidden, 0.001, 4, -0.7), options, RunContext{});
  EXPECT_EQ(diagnosis.verdict, Verdict::Explained);
  ASSERT_EQ(diagnosis.effects.size(), 1u);
  EXPECT_EQ(diagnosis.effects[0].name, "three-halves");
  EXPECT_EQ(diagnosis.effects[0].description, "power 3/2 of q");
  EXPECT_EQ(diagnosis.effects[0].cause, "a sphere that is pressed");
  EXPECT_NEAR(diagnosis.effects[0].coefficient, -1.5, 0.02);
}

}  // namespace
}  // namespace lacuna
