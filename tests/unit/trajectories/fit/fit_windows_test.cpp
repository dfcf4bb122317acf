// SPDX-License-Identifier: MIT
// Records over which errors grow too much for any free run, with all states measured.
#include "trajectories/fit/starts/fit_windows.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/base/random.hpp"
#include "lacuna/dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/model/files/ode_text.hpp"
#include "lacuna/trajectories/fit/fit.hpp"

namespace lacuna {
namespace {

using ::testing::Contains;
using ::testing::EndsWith;
using ::testing::HasSubstr;

constexpr const char* kChaos = "dx/dt = a*y*z\ndy/dt = x - b*y\ndz/dt = c - x*y\n";

/// Sprott's case B (Phys. Rev. E 50:R647, 1994) for 200 units of time: errors grow by e^42.
Dataset chaotic_record(double noise, std::uint64_t seed, Index samples = 2000) {
  constexpr Index kParts = 10;
  const SystemModel truth = parse_ode_system(
      std::string("param a = 1.1\nparam b = 0.9\nparam c = 1.2\n") + kChaos, "truth.ode");
  const Vector fine = sample_times(0.0, 0.1 / kParts, samples * kParts);
  const Solution orbit = simulate(truth.model(), Rk4{}, Vector{{0.5, 0.8, -0.3}}, fine);
  Random random(seed);
  Trajectory record;
  record.source = "made";
  record.time = sample_times(0.0, 0.1, samples);
  record.states.resize(samples, 3);
  for (Index k = 0; k < 3; ++k) {
    for (Index n = 0; n < samples; ++n) record.states(n, k) = orbit.states(n * kParts, k);
    const Vector x = record.states.col(k);
    const double deviation = noise * std::sqrt((x.array() - x.mean()).square().mean());
    for (double& value : record.states.col(k)) value += deviation * random.normal();
  }
  Dataset data;
  data.states = {{"x", ""}, {"y", ""}, {"z", ""}};
  data.trajectories = {record};
  return data;
}

SystemModel chaos_from(const std::string& before) {
  return parse_ode_system(before + kChaos, "m.ode");
}

TEST(FitInWindows, NumbersOfALongChaoticRecord) {
  for (const double noise : {0.02, 0.06}) {
    const Fit found = fit(chaos_from("param a = 1.4\nparam b = 0.65\nparam c = 1.55\n"),
                          chaotic_record(noise, 3), {});
    const double truth[] = {1.1, 0.9, 1.2};
    ASSERT_EQ(found.numbers.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) {
      const FittedParameter& one = found.numbers[i];
      ASSERT_TRUE(one.standard_error && one.ci95) << one.name;
      EXPECT_LT(std::abs(one.value - truth[i]), 4.0 * *one.standard_error) << one.name;
      EXPECT_LT(*one.standard_error, 0.02 * truth[i]) << one.name;
    }
    EXPECT_EQ(found.numbers[1].start, 0.65) << "as given";
    EXPECT_GT(found.records.size(), 3u);
    EXPECT_THAT(found.records, Contains(EndsWith("made, piece 2")));
    EXPECT_EQ(found.initial.size(), found.records.size());
    EXPECT_THAT(found.notes, Contains(HasSubstr("pieces were fitted")));
    EXPECT_TRUE(standing_of(found).open.empty());
  }
}

TEST(FitInWindows, ARecordThatAFreeRunMeetsStaysWhole) {
  const Fit found = fit(chaos_from("param a = 1.4\nparam b = 0.65\nparam c = 1.55\n"),
                        chaotic_record(0.02, 4, 200), {});
  EXPECT_THAT(found.records, ::testing::ElementsAre("made"));
  EXPECT_NEAR(found.numbers[0].value, 1.1, 4.0 * *found.numbers[0].standard_error);
}

TEST(FitInWindows, AModelThatLacksSomethingIsNotCut) {
  const Fit found = fit(
      parse_ode_system("param a = 1\ndx/dt = a*y*z\ndy/dt = x - y\ndz/dt = 1 + 0*x\n", "m.ode"),
      chaotic_record(0.02, 5, 600), {}, {.effort = Thoroughness::Quick});
  EXPECT_EQ(found.records.size(), 1u);
}

TEST(FitInWindows, RecordsAreCutWhereWindowsBegin) {
  Dataset data = chaotic_record(0.0, 1, 10);
  data.trajectories.push_back(data.trajectories[0]);
  const Dataset cut = cut_at(data, {0, 4, 10, 13, 17});
  std::vector<Index> samples;
  for (const Trajectory& record : cut.trajectories) samples.push_back(record.samples());
  EXPECT_THAT(samples, ::testing::ElementsAre(4, 6, 3, 4, 3));
  EXPECT_EQ(cut.trajectories[1].time[0], data.trajectories[0].time[4]);
  EXPECT_EQ(cut.trajectories[4].source, "made, piece 3");
}

}  // namespace
}  // namespace lacuna
