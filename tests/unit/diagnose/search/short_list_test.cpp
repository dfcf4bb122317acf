// SPDX-License-Identifier: MIT
#include "diagnose/search/short_list.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "cli/configuration/diagnosis_configuration.hpp"
#include "lacuna/cli/configuration/registry.hpp"
#include "support/assimilated_oscillator.hpp"

namespace lacuna {
namespace {

/// A record with dry friction that is sought among all effects.
class ShortLists : public testing::Test {
 protected:
  Explanation bare() const { return {{}, base_.fitted}; }

  Explanation with(const std::string& form) const {
    Candidate candidate = support::plain_candidate(form);
    candidate.argument = parse_expression("v");
    return explain_on(problem_, base_, base_.fitted, {{candidate, Vector(0), 0.0, 0.0}});
  }

  static bool has(const ShortList& list, const std::string& form) {
    const Expression expected = parse_expression(form);
    return std::any_of(list.candidates.begin(), list.candidates.end(), [&](const Listed& one) {
      return one.screened.candidate.form == expected;
    });
  }

  const OdeModel nominal_ = support::oscillator();
  const BoundRecords records_ = observed(support::hidden_record(support::dry_friction, 0.01));
  const DiagnosisOptions options_ = diagnosis_options({}, default_registry());
  const RunContext context_ = {};
  const Problem problem_{nominal_, records_, options_, context_};
  const Baseline base_ = plain_baseline(problem_);
  EffectSearch search_{problem_, base_, options_.effects};
};

TEST_F(ShortLists, HaveTheBestOfEachFamilyAndNoPathOfTheirOwn) {
  const ShortList list = short_list(search_, bare());
  ASSERT_FALSE(list.candidates.empty());
  EXPECT_LE(list.candidates.size(), 10u);
  EXPECT_TRUE(has(list, "sign(v)"));
  EXPECT_GT(list.screened, static_cast<Index>(list.candidates.size()));
  EXPECT_GE(list.tried, list.screened);
  EXPECT_TRUE(std::none_of(list.candidates.begin(), list.candidates.end(),
                           [](const Listed& one) { return one.start != nullptr; }));
}

TEST_F(ShortLists, AlongAPathHaveAllFunctionsOfItsArgument) {
  const Explanation wrong = with("v^3");
  search_.along = &wrong;
  const ShortList list = short_list(search_, bare());
  EXPECT_TRUE(has(list, "sign(v)"));
  EXPECT_TRUE(has(list, "v*abs(v)"));
  EXPECT_TRUE(has(list, "v^3"));
  EXPECT_EQ(list.screened,
            short_list(EffectSearch{problem_, base_, options_.effects}, bare()).screened)
      << "the argument was chosen among all";
  for (const Listed& one : list.candidates) {
    const Candidate& candidate = one.screened.candidate;
    EXPECT_EQ(candidate.argument.to_string(), "v");
    EXPECT_EQ(candidate.equation, 1);
    EXPECT_TRUE(candidate.memory.empty());
    EXPECT_FALSE(contains(candidate.form, Operation::Delay));
    ASSERT_TRUE(one.start);
    EXPECT_EQ(one.start->records[0].path, wrong.fit.records[0].path);
  }
}

/// Positions that come late contradict dx/dt = v, which stays what v means.
TEST_F(ShortLists, OfAnIdentityHaveAnOffsetOfItsSensorsOnly) {
  Dataset late = support::hidden_record(support::dry_friction, 0.01);
  for (Trajectory& record : late.trajectories) {
    const Index kept = record.samples() - 5;
    const Vector positions = record.states.col(0).head(kept);
    record.states.col(0).tail(kept) = positions;
  }
  const BoundRecords records = observed(std::move(late));
  const Problem problem{nominal_, records, options_, context_};
  const Baseline base = plain_baseline(problem);
  AssimilationOptions loose;
  loose.disturbed = {true, true};
  const Assimilation fit = assimilate(nominal_, records, loose, context_);
  ASSERT_GT(fit.noise.disturbance[0], 0.0);
  const ShortList list = short_list({problem, base, options_.effects}, {{}, fit});
  ASSERT_FALSE(list.candidates.empty());
  for (const Listed& one : list.candidates) {
    const Candidate& candidate = one.screened.candidate;
    if (candidate.equation != 0 || candidate.place != Place::Rate) continue;
    EXPECT_EQ(candidate.form.to_string(), "1");
  }
}

}  // namespace
}  // namespace lacuna
