// SPDX-License-Identifier: MIT
// Devices that lack nothing, on benches with faults: none gets a name.
#include "hidden/support/null_benches.hpp"

#include <gtest/gtest.h>

#include "hidden/support/score.hpp"
#include "hidden/support/twins.hpp"
#include "hidden/whole_vocabulary.hpp"

namespace lacuna::hidden {
namespace {

class NullBench : public ::testing::TestWithParam<BenchFault> {};

TEST_P(NullBench, GetsNoName) {
  const BenchCase bench = null_bench(GetParam(), 8004);
  const Diagnosis found =
      diagnosis_of(bench.hidden.nominal, bench.records.find, bench.records.check);
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
