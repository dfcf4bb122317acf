// SPDX-License-Identifier: MIT
#include "cli/configuration/identification_configuration.hpp"

#include <gtest/gtest.h>

#include "cli/configuration/description.hpp"
#include "cli/configuration/diagnosis_configuration.hpp"
#include "diagnose/criterion/extended_bic.hpp"
#include "lacuna/cli/configuration/registry.hpp"
#include "support/expect_error.hpp"

namespace lacuna {
namespace {

using testing::expect_error;

Configuration with(const std::vector<std::string>& assignments) {
  Configuration configuration;
  for (const std::string& assignment : assignments) configuration.set(assignment);
  return configuration;
}

IdentificationOptions rules_with(const std::vector<std::string>& assignments) {
  return identification_options(with(assignments), default_registry());
}

TEST(IdentificationConfiguration, SetsOptionsByTheirPath) {
  const IdentificationOptions options =
      rules_with({"forms.same=0.2", "validation.resolution=1e-5", "relations.strength=5",
                  "advice.most_forms=1", "map.errors=5", "sync.above_noise=3"});
  EXPECT_EQ(options.forms.same, 0.2);
  EXPECT_EQ(options.forms.most_forms, FormOptions{}.most_forms) << "others stay";
  EXPECT_EQ(options.validation.resolution, 1e-5);
  EXPECT_EQ(options.relations.strength, 5.0);
  EXPECT_EQ(options.advice.most_forms, 1);
  EXPECT_EQ(options.map.errors, 5.0);
  EXPECT_EQ(options.sync.above_noise, 3.0);
  EXPECT_EQ(options.advice.search.same, 0.2) << "advice seeks as forms are sought";
}

TEST(IdentificationConfiguration, TheyDoNotMakeAnotherPipeline) {
  EXPECT_FALSE(with({}).says_pipeline());
  EXPECT_FALSE(with({"forms.same=0.2", "validation.scatter=3"}).says_pipeline());
  EXPECT_TRUE(with({"forms.same=0.2", "regressor=stlsq"}).says_pipeline());
  EXPECT_NO_THROW(with({"relations.most_terms=3"}).build(default_registry()));
}

TEST(IdentificationConfiguration, MistakesNameThePathAndTheNearest) {
  expect_error<ConfigError>([] { rules_with({"forms.sam=0.2"}); }, "$.forms.sam", "sam",
                            "same");
  expect_error<ConfigError>([] { rules_with({"validation.blocks=0"}); }, "$.validation.blocks",
                            "out of range", "at least 1");
  expect_error<ConfigError>([] { with({"form.same=1"}).build(default_registry()); }, "$.form",
                            "no key 'form'", "forms");
}

TEST(IdentificationConfiguration, EveryOptionHasASentenceAndARange) {
  for (const char* name : {"forms", "validation", "relations", "advice", "map", "sync"}) {
    const auto options = describe_options(default_registry().find(name, name));
    EXPECT_GE(options.size(), 3u) << name;
    for (const OptionDescription& option : options) {
      EXPECT_GT(option.text.size(), 20u) << option.name;
      EXPECT_FALSE(option.range.empty()) << option.name;
    }
  }
}

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
