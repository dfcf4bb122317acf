// SPDX-License-Identifier: MIT
// Runs of one device one behind the other in a file, as if they were one: what comes of the seams
// is no property of the device. The list was written before anything that it tests was changed.
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "hidden/support/null_benches.hpp"
#include "hidden/support/score.hpp"
#include "hidden/support/twins.hpp"
#include "hidden/whole_vocabulary.hpp"

namespace lacuna::hidden {
namespace {

/// Runs of so many samples each one behind the other, the times go on but for `missing` steps.
Dataset in_one_file(HiddenCase& device, int runs, Index samples, Index missing) {
  Dataset all;
  for (int run = 0; run < runs; ++run) {
    // Starts are drawn: each run begins where the one before did not end.
    Dataset one = make_records(device, kBenchNoise, 9300U + static_cast<unsigned>(run)).find;
    Trajectory part = rows_of(one.trajectories.front(), 40, samples);
    if (run == 0) {
      all = one;
      all.trajectories = {part};
      continue;
    }
    Trajectory& whole = all.trajectories.front();
    const Index before = whole.samples();
    const double step = whole.time[1] - whole.time[0];
    part.time.array() += whole.time[before - 1] - part.time[0] +
                         step * static_cast<double>(1 + missing);
    const auto append = [](auto& above, const auto& below) {
      std::decay_t<decltype(above)> rows(above.rows() + below.rows(), above.cols());
      rows << above, below;
      above = rows;
    };
    append(whole.time, part.time);
    append(whole.states, part.states);
    append(whole.inputs, part.inputs);
  }
  return all;
}

std::set<std::string> names_on(HiddenCase device, int runs, Index samples, Index missing) {
  device.noise = NoiseKind::White;
  const Dataset all = in_one_file(device, runs, samples, missing);
  const Diagnosis found = diagnosis_of(device.nominal, all, {});
  std::set<std::string> names;
  for (const NamedEffect& effect : found.effects) names.insert(effect.name);
  EXPECT_NE(found.verdict, Verdict::UnnamedStructure) << in_one_line(found);
  return names;
}

TEST(Seams, OfADeviceThatLacksNothingAreNoName) {
  const HiddenCase pendulum = complete_twin(Twin::LaggedThrust, 9201),
                   slide = complete_twin(Twin::LatticeFriction, 9202);
  EXPECT_EQ(names_on(pendulum, 2, 800, 0), std::set<std::string>{});
  EXPECT_EQ(names_on(slide, 2, 900, 1), std::set<std::string>{});
  for (const HiddenCase& device : {pendulum, slide})
    EXPECT_EQ(names_on(device, 3, 700, 0), std::set<std::string>{}) << device.name;
}

TEST(Seams, LeaveTheNameOfWhatIsMissing) {
  EXPECT_EQ(names_on(twin(Twin::LatticeFriction, 9203), 2, 1000, 0),
            std::set<std::string>{"coulomb-friction"});
}

}  // namespace
}  // namespace lacuna::hidden
