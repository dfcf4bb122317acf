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
