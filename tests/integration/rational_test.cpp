// SPDX-License-Identifier: MIT
// Rational and logistic right-hand sides, found without a word about them: a smaller version of
// study_rational.
#include <gtest/gtest.h>

#include "benchmarks/studies/rational/systems.hpp"
#include "identify/forms_beside/identify_with_forms.hpp"
#include "lacuna/cli/configuration/registry.hpp"
#include "lacuna/model/files/model_file.hpp"

namespace lacuna::benchmarks {
namespace {

OdeModel found_in(const RationalSystem& system, double noise) {
  static const auto effects = default_registry().make_all<Effect>();
  return identify_with_forms(records_of(system, noise, 1), pipeline_for(system), effects).model;
}

TEST(Rational, IsFoundExactlyInCleanRecordsAndCanBeSimulated) {
  for (const char* name :
       {"Michaelis-Menten", "Hill, n = 2", "gene switch, Hill", "gene switch, logistic",
        "x/(1+x^2) oscillator", "prey and predator, Holling II"}) {
    const RationalSystem& system = rational_system(name);
    const OdeModel model = found_in(system, 0.0);
    EXPECT_TRUE(has_structure(model, system.model)) << name << '\n' << to_text(model);
    EXPECT_LT(rate_error(model, system), 1e-6) << name;
    EXPECT_GT(determination(model, system), 0.9999) << name;
    // As files hold it, it is the same model.
    for (const char* file : {"model.json", "model.ode"}) {
      const std::string text = format_model_for(file, model);
      const OdeModel read =
          file == std::string("model.json") ? parse_model(text, file) : parse_ode(text, file);
      EXPECT_LT(rate_error(read, system), 1e-6) << text;
      EXPECT_TRUE(has_structure(read, system.model)) << text;
    }
  }
}

class NoisyRational : public ::testing::TestWithParam<const char*> {};

TEST_P(NoisyRational, IsFoundAtOnePerCentNoise) {
  const RationalSystem& system = rational_system(GetParam());
  const OdeModel model = found_in(system, 0.01);
  EXPECT_TRUE(has_structure(model, system.model)) << to_text(model);
  EXPECT_LT(rate_error(model, system), 0.02);
}

INSTANTIATE_TEST_SUITE_P(Of, NoisyRational,
                         ::testing::Values("Michaelis-Menten", "gene switch, Hill",
                                           "prey and predator, Beddington-DeAngelis",
                                           "yeast glycolysis, rate law in the library"));

}  // namespace
}  // namespace lacuna::benchmarks
