// SPDX-License-Identifier: MIT
// Devices that lack nothing, on benches with faults: none gets a name.
#include "hidden/support/null_benches.hpp"

#include <gtest/gtest.h>

#include <set>

#include "hidden/support/score.hpp"
#include "hidden/support/twins.hpp"
#include "lacuna/cli/configuration/registry.hpp"
#include "lacuna/diagnose/journey/diagnose.hpp"

namespace lacuna::hidden {
namespace {

std::set<double> values_of(BenchFault fault) {
  const Vector x = null_bench(fault, 8001).records.find.trajectories.front().states.col(0);
  return {x.begin(), x.end()};
}

TEST(NullBenches, LatticesAreCoarse) {
  EXPECT_LT(values_of(BenchFault::CoarseLattice).size(), 100U);
  EXPECT_LT(values_of(BenchFault::RoundedLattice).size(), 500U);
  EXPECT_GT(values_of(BenchFault::Spikes).size(), 1400U);
}

TEST(NullBenches, AFewSamplesAreOff) {
  const BenchCase bench = null_bench(BenchFault::Spikes, 8001);
  const Dataset plain = make_records(bench.hidden, kBenchNoise, 8001).find;
  const Vector apart = bench.records.find.trajectories.front().states.col(0) -
                       plain.trajectories.front().states.col(0);
  const auto off = (apart.array() != 0.0).count();
  EXPECT_GE(off, 1);
  EXPECT_LE(off, 4);
}

TEST(NullBenches, ASteadyInputDoesNotMove) {
  const Dataset find = null_bench(BenchFault::SteadyInput, 8001).records.find;
  const Vector u = find.trajectories.front().inputs.col(0);
  EXPECT_EQ(u.minCoeff(), u.maxCoeff());
}

TEST(NullBenches, OnlyTheFirstStateIsMeasured) {
  const Dataset find = null_bench(BenchFault::HiddenStates, 8002).records.find;
  ASSERT_EQ(find.state_count(), 2);
  EXPECT_TRUE(find.is_measured(0));
  EXPECT_FALSE(find.is_measured(1));
}

class NullBench : public ::testing::TestWithParam<BenchFault> {};

TEST_P(NullBench, GetsNoName) {
  const BenchCase bench = null_bench(GetParam(), 8004);
  DiagnosisOptions options;
  options.effects = default_registry().make_all<Effect>();
  const Diagnosis found = diagnose(bench.hidden.nominal, bench.records.find,
                                   bench.records.check, options, RunContext{});
  EXPECT_NE(found.verdict, Verdict::Explained) << in_one_line(found);
  const bool sensor = GetParam() == BenchFault::MovingAverage;
  for (const NamedEffect& effect : found.effects)
    EXPECT_TRUE(sensor && (effect.name == "sensor-lag" || effect.name == "channel-skew"))
        << in_one_line(found);
}

INSTANTIATE_TEST_SUITE_P(All, NullBench, ::testing::ValuesIn(all_bench_faults()),
                         [](const auto& one) {
                           std::string name = to_string(one.param);
                           for (char& c : name)
                             if (c == '-') c = '_';
                           return name;
                         });

}  // namespace
}  // namespace lacuna::hidden
