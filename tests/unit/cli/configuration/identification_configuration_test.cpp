// SPDX-License-Identifier: MIT
#include "cli/configuration/identification_configuration.hpp"

#include <gtest/gtest.h>

#include "cli/configuration/description.hpp"
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

}  // namespace
}  // namespace lacuna
