// SPDX-License-Identifier: MIT
// Sensors that show the states of other times: no effect of the device is named in their place.
#include "hidden/support/sensor_benches.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "hidden/support/score.hpp"
#include "hidden/whole_vocabulary.hpp"

namespace lacuna::hidden {
namespace {

class ASensorBench : public ::testing::TestWithParam<SensorBench> {};

TEST_P(ASensorBench, IsExplainedByNothingThatIsNotThere) {
  const SensorBench bench = GetParam();
  const BenchCase made = made_bench(bench);
  const Diagnosis found =
      diagnosis_of(made.hidden.nominal, made.records.find, made.records.check);
  const std::vector<std::string>& sensors = names_of_sensors();
  const auto is_right = [&](const NamedEffect& effect) {
    if (std::find(sensors.begin(), sensors.end(), effect.name) != sensors.end()) return true;
    const auto& hidden = made.hidden.effects;
    return std::any_of(hidden.begin(), hidden.end(), [&](const HiddenEffect& one) {
      return std::find(one.names.begin(), one.names.end(), effect.name) != one.names.end();
    });
  };
  const bool all_right = std::all_of(found.effects.begin(), found.effects.end(), is_right);
  EXPECT_TRUE(all_right || found.verdict != Verdict::Explained) << in_one_line(found);
  if (!bench.acts_late) return;
  EXPECT_TRUE(std::any_of(found.effects.begin(), found.effects.end(),
                          [&](const NamedEffect& effect) {
                            return std::find(sensors.begin(), sensors.end(), effect.name) ==
                                       sensors.end() &&
                                   is_right(effect);
                          }))
      << in_one_line(found);
}

/// Inputs that act late, and those that were explained by something that is not there before
/// late sensors were tried (results/sensors.md of the study has all).
std::vector<SensorBench> decisive_benches() {
  const std::set<std::string> misled{
      "slide-right-speed-second-order-null", "store-filter-null", "store-right-filter-null",
      "thrust-differences-null", "slide-differences-of-means-null"};
  std::vector<SensorBench> benches = all_sensor_benches();
  std::erase_if(benches, [&](const SensorBench& bench) {
    return !bench.acts_late && !misled.contains(bench.name);
  });
  return benches;
}

INSTANTIATE_TEST_SUITE_P(All, ASensorBench, ::testing::ValuesIn(decisive_benches()),
                         [](const auto& one) {
                           std::string name = one.param.name;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace lacuna::hidden
