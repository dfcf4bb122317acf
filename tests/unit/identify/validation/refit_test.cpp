// SPDX-License-Identifier: MIT
#include "identify/validation/refit.hpp"

#include <gtest/gtest.h>

#include <string>

#include "lacuna/dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/test_systems/measurement.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/identify/pipeline/presets.hpp"

namespace lacuna {
namespace {

Dataset lorenz_samples(double noise, Index samples) {
  const TestSystem& lorenz = test_system("lorenz");
  Dataset data = record_of(lorenz.model, Dopri87{}, lorenz.start, 0.01, samples);
  if (noise > 0.0) return add_relative_noise(data, noise, 3);
  data.trajectories[0].derivatives.resize(0, 0);
  return data;
}

/// The model with all its coefficients off by a fraction.
OdeModel disturbed(const OdeModel& model, double fraction) {
  std::vector<Equation> equations = model.equations();
  for (Equation& equation : equations)
    for (WeightedTerm& summand : equation) summand.coefficient *= 1.0 + fraction;
  return model.with_equations(std::move(equations));
}

TEST(Refit, FindsCoefficientsAgain) {
  const OdeModel& truth = test_system("lorenz").model;
  for (const double noise : {0.0, 0.01}) {
    const auto found = refitted_on(lorenz_samples(noise, 3000), disturbed(truth, 0.05),
                                   preset("algorithm1"), {});
    ASSERT_TRUE(found.has_value()) << noise;
    for (Index k = 0; k < 3; ++k)
      for (const WeightedTerm& summand : truth.equations()[static_cast<std::size_t>(k)])
        EXPECT_NEAR(found->coefficient(k, summand.term.name()), summand.coefficient,
                    0.02 * std::abs(summand.coefficient) + 0.02)
            << noise;
  }
}

TEST(Refit, KeepsTermsThatAreWorthNothing) {
  const OdeModel& truth = test_system("lorenz").model;
  const OdeModel more = truth.with_term(0, {Term::parse("z", truth.variables()), 0.01});
  for (const double noise : {0.0, 0.01}) {
    const auto found = refitted_on(lorenz_samples(noise, 2000), more, preset("algorithm1"), {});
    ASSERT_TRUE(found.has_value()) << noise;
    EXPECT_EQ(found->equations()[0].size(), 3U);
    EXPECT_NEAR(found->coefficient(0, "z"), 0.0, 0.05);
  }
}

TEST(Refit, FitsWindowsAndNoMore) {
  // Of what does not fit to the noise multiple shooting would fit the coefficients again, which
  // predictions do not notice.
  const OdeModel& truth = test_system("lorenz").model;
  std::vector<Equation> equations = truth.equations();
  equations[1].pop_back();
  int fitted = 0, refined = 0;
  RunContext context;
  context.progress = [&](const Progress& progress) {
    const std::string activity(progress.activity);
    fitted += activity == "searching the structure";
    refined += activity == "refining";
  };
  ASSERT_TRUE(refitted_on(lorenz_samples(0.01, 2000), truth.with_equations(equations),
                          preset("algorithm1"), context)
                  .has_value());
  EXPECT_GT(fitted, 0);
  EXPECT_EQ(refined, 0);
}

TEST(Refit, IsNotPossibleWithoutTermsOrWithoutSamples) {
  const OdeModel& truth = test_system("lorenz").model;
  std::vector<Equation> equations = truth.equations();
  equations[1].clear();
  EXPECT_FALSE(refitted_on(lorenz_samples(0.0, 500), truth.with_equations(equations),
                           preset("algorithm1"), {})
                   .has_value());
  EXPECT_FALSE(
      refitted_on(lorenz_samples(0.0, 3), truth, preset("algorithm1"), {}).has_value());
}

}  // namespace
}  // namespace lacuna
