// SPDX-License-Identifier: MIT
// A record whose right-hand side is no polynomial, identified by the default without a word
// about its functions.
#include <gtest/gtest.h>

#include <set>
#include <string>

#include "hidden/support/cases.hpp"
#include "hidden/support/records.hpp"
#include "identify/forms_beside/identify_with_forms.hpp"
#include "lacuna/cli/configuration/registry.hpp"
#include "lacuna/identify/pipeline/presets.hpp"

namespace lacuna::hidden {
namespace {

std::set<std::string> terms_of(const OdeModel& model, std::size_t state) {
  std::set<std::string> names;
  for (const WeightedTerm& summand : model.equations()[state])
    names.insert(summand.term.name());
  return names;
}

class Identified : public testing::TestWithParam<double> {};

TEST_P(Identified, APendulumWithDryFriction) {
  const Dataset record = make_records(case_named("pendulum-dry-friction"), GetParam(), 1).find;
  const auto effects = default_registry().make_all<Effect>();
  const OdeModel found = identify_with_forms(record, algorithm1(), effects).model;
  EXPECT_EQ(terms_of(found, 0), std::set<std::string>{"w"});
  EXPECT_EQ(terms_of(found, 1), (std::set<std::string>{"sin(th)", "w", "sign(w)", "u"}));
  EXPECT_NEAR(found.coefficient(1, "sign(w)"), -0.8, 0.05);
}

INSTANTIATE_TEST_SUITE_P(AtNoise, Identified, testing::Values(0.001, 0.01));

}  // namespace
}  // namespace lacuna::hidden
