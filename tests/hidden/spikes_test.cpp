// SPDX-License-Identifier: MIT
// A few samples that are off have no name: no effect is named for them, and they take none
// away.
#include "hidden/support/spikes.hpp"

#include <gtest/gtest.h>

#include "hidden/whole_vocabulary.hpp"
#include "lacuna/model/files/ode_text.hpp"

namespace lacuna::hidden {
namespace {

class Spikes : public ::testing::TestWithParam<SpikeCase> {};

TEST_P(Spikes, HaveNoName) {
  const SpikeCase one = GetParam();
  const Diagnosis found = diagnosis_of(spike_model(one.model), spike_record(one, 11), {});
  EXPECT_NE(found.verdict, Verdict::Explained);
  for (const NamedEffect& effect : found.effects)
    ADD_FAILURE() << to_string(found.verdict) << ": " << effect.name << " in "
                  << effect.equation << ", " << effect.sigma << " sigma";
}

INSTANTIATE_TEST_SUITE_P(All, Spikes, ::testing::ValuesIn(spike_cases()), [](const auto& one) {
  std::string name = one.param.name;
  for (char& c : name)
    if (c == ' ' || c == ',') c = '_';
  return name;
});

}  // namespace
}  // namespace lacuna::hidden
