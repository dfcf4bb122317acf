// SPDX-License-Identifier: MIT
#include "hidden/support/ordinary.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "cli/configuration/diagnosis_configuration.hpp"
#include "hidden/support/cases.hpp"
#include "hidden/support/records.hpp"
#include "lacuna/diagnose/journey/diagnose.hpp"

namespace lacuna::hidden {
namespace {

HiddenCase pendulum(Ordinary ordinary) {
  return made(case_named("pendulum-dry-friction"), ordinary);
}

/// One of each kind with nothing missing, and with dry friction: no false name, the right one.
class OrdinaryRecords : public testing::TestWithParam<Ordinary> {
 protected:
  Diagnosis answer(const HiddenCase& hidden) const {
    const Records records = make_records(hidden, 0.005, 4);
    return diagnose(hidden.nominal, records.find, records.check,
                    diagnosis_options({}, default_registry()), {});
  }
};

TEST_P(OrdinaryRecords, HaveNoNameWhereNothingIsMissing) {
  const Diagnosis diagnosis = answer(made(case_named("motor-null"), GetParam()));
  EXPECT_TRUE(diagnosis.effects.empty()) << diagnosis.effects.front().term;
  EXPECT_EQ(diagnosis.verdict, Verdict::NoDiscrepancy);
}

TEST_P(OrdinaryRecords, ShowDryFriction) {
  const Diagnosis diagnosis = answer(pendulum(GetParam()));
  ASSERT_EQ(diagnosis.effects.size(), 1U);
  EXPECT_EQ(diagnosis.effects.front().equation, 1);
  EXPECT_TRUE(std::set<std::string>({"coulomb-friction", "stribeck-friction"})
                  .contains(diagnosis.effects.front().name))
      << diagnosis.effects.front().name;
}

INSTANTIATE_TEST_SUITE_P(All, OrdinaryRecords, testing::ValuesIn(all_ordinary()),
                         [](const auto& kind) {
                           std::string name = to_string(kind.param);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace lacuna::hidden
