// SPDX-License-Identifier: MIT
#include "diagnose/search/effect_names.hpp"

#include <gtest/gtest.h>

#include "support/assimilated_oscillator.hpp"

namespace lacuna {
namespace {

RankedEffect ranked(const Candidate& candidate, const std::vector<std::string>& names,
                    double probability, double sigma = 5.0) {
  RankedEffect effect{
      {{{candidate, candidate.starts.front(), -1.0, 0.1}}, {.model = support::oscillator()}}};
  for (const std::string& name : names)
    effect.names.push_back({name, "sentence of " + name, "cause of " + name});
  effect.sigma = sigma;
  effect.contribution = 0.1;
  effect.probability = probability;
  return effect;
}

Ranking three_forms() {
  RankedEffect stop = ranked(support::stop_candidate(0.25), {"stop", "bend"}, 0.7);
  stop.names.front().parameters = {"gap"};
  return {{stop, ranked(support::plain_candidate("sign(v)"), {"friction"}, 0.2),
           ranked(support::plain_candidate("q^3"), {"hardening"}, 0.05)},
          0.05,
          12};
}

TEST(EffectNames, AlternativesAreOtherNamesThenOtherForms) {
  const Ranking ranking = three_forms();
  const NamedEffect named = name_effect(ranking.effects[0], ranking);
  ASSERT_EQ(named.alternatives.size(), 3u);
  EXPECT_EQ(named.alternatives[0].name, "bend");
  EXPECT_EQ(named.alternatives[0].term, "min(q-0.25,0)") << "the same form";
  EXPECT_EQ(named.alternatives[1].name, "friction");
  EXPECT_EQ(named.alternatives[1].term, "sign(v)");
  EXPECT_EQ(named.alternatives[1].probability, 0.2);
  EXPECT_EQ(named.alternatives[2].name, "hardening");
}

TEST(EffectNames, PlainerFormsAreThoseWithFewerShapesThenShallowerOnes) {
  const Ranking ranking = three_forms();
  const auto plainer = plainer_forms(ranking.effects[0], ranking, {});
  ASSERT_EQ(plainer.size(), 2u);
  EXPECT_EQ(plainer[0].named.name, "friction") << "sign(v) and q^3 have no shape: as ranked";
  EXPECT_EQ(plainer[1].named.name, "hardening");
  EXPECT_TRUE(plainer_forms(ranking.effects[1], ranking, {}).empty());
}

TEST(EffectNames, ThresholdsDecideWhichPlainerFormsCount) {
  Ranking ranking = three_forms();
  ranking.effects[1].sigma = 2.9;
  EXPECT_EQ(plainer_forms(ranking.effects[0], ranking, {}).size(), 1u);
  EXPECT_EQ(plainer_forms(ranking.effects[0], ranking, {.significance = 2.5}).size(), 2u);
  EXPECT_TRUE(plainer_forms(ranking.effects[0], ranking, {.effect_size = 0.2}).empty());
}

TEST(EffectNames, FormsElsewhereStandInAnotherPlaceAndDoAsWell) {
  Ranking ranking = three_forms();
  EXPECT_TRUE(forms_elsewhere(ranking.effects[0], ranking, {}).empty()) << "all in one place";
  ranking.effects[1].explanation.effects[0].candidate.equation = 0;
  ranking.effects[2].explanation.effects[0].candidate.place = Place::Channel;
  ranking.effects[2].criterion = 9.0;
  const auto elsewhere = forms_elsewhere(ranking.effects[0], ranking, {});
  ASSERT_EQ(elsewhere.size(), 2u);
  EXPECT_EQ(elsewhere[0].named.name, "friction");
  EXPECT_EQ(elsewhere[1].named.name, "hardening");
  EXPECT_EQ(forms_elsewhere(ranking.effects[0], ranking, {.undecided = 8.0}).size(), 1u);
}

TEST(EffectNames, FrictionThatIsWrittenAsASlopeIsToldByItsForce) {
  Candidate clip = support::plain_candidate("clip(v,-a,a)");
  clip.argument = parse_expression("v");
  clip.shapes = {{"a", "m/s", 0.001, 1.0, true}};
  const Explanation explanation{{{clip, Vector::Constant(1, 0.05), -16.0, 0.1}},
                                {.model = support::oscillator()}};
  NamedEffect friction;
  friction.name = "coulomb-friction";
  friction.parameters = {{"width", "m/s", 0.0, {}}};
  std::vector<NamedEffect> named{friction};
  for (int again = 0; again < 2; ++again) update_numbers(explanation, named);
  ASSERT_EQ(named[0].parameters.size(), 2u);
  EXPECT_EQ(named[0].parameters[1].name, "force");
  EXPECT_DOUBLE_EQ(named[0].parameters[1].value, 0.8);
  named[0].name = "piecewise-linear";
  update_numbers(explanation, named);
  EXPECT_EQ(named[0].parameters.size(), 1u) << "a slope is what it is";
}

}  // namespace
}  // namespace lacuna
