// SPDX-License-Identifier: MIT
#include "diagnose/search/short_list.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

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

TEST_F(ShortLists, HaveNoFormWithMoreParametersThanMayCount) {
  Problem bounded = problem_;
  bounded.most_parameters = 2;
  const EffectSearch search{bounded, base_, options_.effects};
  const auto most_shapes = [&](const Explanation& current) {
    std::size_t most = 0;
    for (const Listed& one : short_list(search, current).candidates)
      most = std::max(most, one.screened.candidate.shapes.size());
    return most;
  };
  EXPECT_EQ(most_shapes(bare()), 1u);
  EXPECT_EQ(most_shapes(with("v^3")), 0u) << "beside an effect with one parameter";
}

TEST_F(ShortLists, StartWhereAnEffectOfTheSameFormIsInAnotherEquation) {
  const ShortList list = short_list(search_, bare());
  const auto shaped = std::find_if(
      list.candidates.begin(), list.candidates.end(),
      [](const Listed& one) { return one.screened.candidate.shapes.size() == 1; });
  ASSERT_NE(shaped, list.candidates.end());
  FittedEffect effect{shaped->screened.candidate, Vector(1), 0.0, 0.0};
  const ShapeParameter range = effect.candidate.shapes.front();
  effect.shapes[0] = 0.123 * range.low + 0.877 * range.high;
  effect.candidate.equation = 1 - effect.candidate.equation;
  const ShortList beside = short_list(search_, {{effect}, base_.fitted});
  const auto same = std::find_if(
      beside.candidates.begin(), beside.candidates.end(), [&](const Listed& one) {
        return are_one_form(one.screened.candidate, shaped->screened.candidate);
      });
  ASSERT_NE(same, beside.candidates.end());
  EXPECT_EQ(same->screened.candidate.starts.size(),
            shaped->screened.candidate.starts.size() + 1);
  EXPECT_EQ(same->screened.candidate.starts.back(), effect.shapes);
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

TEST(WorthFitting, AreThePossibleOnesAndAtLeastSoMany) {
  std::vector<ScreenedCandidate> screened;
  const double gains[] = {100.0, 40.0, 3.0, 1.0, 0.5};
  for (int i = 0; i < 5; ++i) {
    Candidate candidate = support::plain_candidate("v^" + std::to_string(i + 2));
    candidate.families = {"family " + std::to_string(i)};
    screened.push_back({candidate, Vector(0), 1.0, gains[i], 1});
  }
  const DecisionOptions decision;
  EXPECT_EQ(worth_fitting(screened, decision, 0).size(), 2u);
  EXPECT_EQ(worth_fitting(screened, decision, 1).size(), 2u);
  const auto four = worth_fitting(screened, decision, 4);
  ASSERT_EQ(four.size(), 4u);
  EXPECT_EQ(four.back().gain, 1.0) << "in their order";
  screened[1].candidate.families = screened[0].candidate.families;
  EXPECT_EQ(worth_fitting(screened, decision, 4).size(), 4u)
      << "a family has one for an argument";
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

TEST_F(ShortLists, BesideAnEffectAreScreenedAgain) {
  const Explanation found = with("sign(v)");
  search_.along = &found;
  const ShortList list = short_list(search_, found);
  EXPECT_FALSE(has(list, "sign(v)")) << "it is there";
  EXPECT_GT(list.screened, static_cast<Index>(list.candidates.size()));
}

}  // namespace
}  // namespace lacuna
