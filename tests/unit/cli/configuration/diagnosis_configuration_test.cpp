// SPDX-License-Identifier: MIT
#include "cli/configuration/diagnosis_configuration.hpp"

#include "lacuna/cli/configuration/registry.hpp"
#include "lacuna/diagnose/criterion/extended_bic.hpp"
#include "support/expect_error.hpp"

namespace lacuna {
namespace {

using testing::expect_error;

DiagnosisOptions read(const std::vector<std::string>& assignments) {
  Configuration configuration;
  for (const std::string& assignment : assignments) configuration.set(assignment);
  return diagnosis_options(configuration, default_registry());
}

template <class Interface>
std::vector<std::string> names_of(const std::vector<Stage<Interface>>& stages) {
  std::vector<std::string> names;
  for (const Stage<Interface>& stage : stages) names.emplace_back(stage->info().name);
  return names;
}

TEST(DiagnosisConfiguration, EmptyIsAllThatIsRegisteredWithTheDefaults) {
  const DiagnosisOptions options = read({});
  EXPECT_EQ(names_of(options.effects), default_registry().names(Effect::kKind));
  EXPECT_EQ(names_of(options.hypotheses), default_registry().names(Hypothesis::kKind));
  EXPECT_EQ(options.criterion->info().name, "extended-bic");
  EXPECT_EQ(options.decision.significance, DecisionOptions{}.significance);
  EXPECT_FALSE(options.fill_gap);
}

TEST(DiagnosisConfiguration, SetsThresholdsCriterionAndWhatIsTried) {
  const DiagnosisOptions options =
      read({"decision.significance=4.5", "decision.rim=0.7", "criterion.choice=0",
            "effects=[\"quadratic-drag\",\"coulomb-friction\"]",
            "hypotheses=[\"named-effects\"]", "fill_gap=true"});
  EXPECT_EQ(options.decision.significance, 4.5);
  EXPECT_EQ(options.decision.naming.rim, 0.7);
  EXPECT_EQ(options.decision.undecided, DecisionOptions{}.undecided) << "others stay";
  EXPECT_EQ(dynamic_cast<const ExtendedBic&>(*options.criterion).options().choice, 0.0);
  EXPECT_EQ(names_of(options.effects),
            (std::vector<std::string>{"quadratic-drag", "coulomb-friction"}));
  EXPECT_EQ(names_of(options.hypotheses), std::vector<std::string>{"named-effects"});
  EXPECT_TRUE(options.fill_gap);
}

TEST(DiagnosisConfiguration, NoEffectAtAllIsALegalChoice) {
  EXPECT_TRUE(read({"effects=[]"}).effects.empty());
}

TEST(DiagnosisConfiguration, MistakesNameThePathAndTheNearest) {
  expect_error<ConfigError>([] { read({"efects=[]"}); }, "$.efects", "no key 'efects'",
                            "effects");
  expect_error<ConfigError>([] { read({"decision.signifcance=2"}); }, "$.decision.signifcance",
                            "signifcance", "significance");
  expect_error<ConfigError>([] { read({"effects=3"}); }, "$.effects", "not a list of names",
                            "give a list");
  expect_error<ConfigError>([] { read({"effects=[1]"}); }, "$.effects", "not a list of names",
                            "give a list");
  expect_error<ConfigError>([] { read({"fill_gap=3"}); }, "$.fill_gap", "not true or false",
                            "true or false");
  EXPECT_THROW(read({"effects=[\"coulomb-frixion\"]"}), Error);
  EXPECT_THROW(read({"decision.significance=-1"}), ConfigError);
  EXPECT_THROW(read({"criterion=aic"}), ConfigError);
}

}  // namespace
}  // namespace lacuna
