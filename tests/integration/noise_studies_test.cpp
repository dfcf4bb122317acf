// SPDX-License-Identifier: MIT
// The studies of noisy records in small: what they count, on a few seeded records.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "benchmarks/studies/chaos70/systems.hpp"
#include "lacuna/identify/pipeline/presets.hpp"
#include "support/noisy_records.hpp"

namespace lacuna {
namespace {

/// Every tenth of the 70 chaotic flows at 1 % noise, thresholds from the noisy data alone.
TEST(NoiseStudies, ChaoticFlowsToOnePercent) {
  const char* folder = std::getenv("LACUNA_DATA");
  if (folder == nullptr) GTEST_SKIP() << "LACUNA_DATA is not set";
  const auto systems = chaos70::read_systems(std::string(folder) + "/chaos70");
  Pipeline pipeline = robust();
  pipeline.basis = Monomials{{.max_degree = 4}};
  int good = 0;
  for (std::size_t i = 0; i < systems.size(); i += 10) {
    const OdeModel found = identify(chaos70::noisy_records(systems[i], 1.0, 1), pipeline).model;
    good += chaos70::coefficient_error(systems[i].model, found) < 0.01;
  }
  EXPECT_GE(good, 6);
}

/// Ten draws of Lorenz, 1000 samples, 10 % noise.
TEST(NoiseStudies, LorenzInTenPercentNoise) {
  Pipeline pipeline = robust();
  pipeline.basis = Monomials{{.max_degree = 2}};
  const Structure truth = structure_of(test_system("lorenz").model);
  int exact = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
    exact += structure_of(identify(noisy_record("lorenz", 1000, 0.1, seed), pipeline).model) ==
             truth;
  EXPECT_GE(exact, 9);
}

}  // namespace
}  // namespace lacuna
