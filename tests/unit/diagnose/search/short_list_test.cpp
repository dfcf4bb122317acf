// SPDX-License-Identifier: MIT
#include "diagnose/search/short_list.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "cli/configuration/diagnosis_configuration.hpp"
#include "diagnose/search/shared_form.hpp"
#include "diagnose/search/window_refit.hpp"
#include "lacuna/cli/configuration/registry.hpp"
#include "support/asked.hpp"
#include "support/assimilated_oscillator.hpp"
#include "support/grey_box.hpp"
#include "support/own_effects.hpp"
#include "trajectories/windows/window_gap.hpp"

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

/// Dry friction, and quick forces that go along with the state.
double friction_and_more(double t, double q, double v) {
  return support::dry_friction(t, q, v) + 0.15 * std::sin(25.0 * q) * std::sin(9.0 * t + v);
}

class WindowRefit : public testing::Test {
 protected:
  Explanation with(const Candidate& candidate) const {
    return explain_on(asked_.problem(), *base_, base_->fitted,
                      {{candidate, candidate.starts.front(), 0.0, 0.0}});
  }
  std::optional<Explanation> refitted(const Explanation& explanation) const {
    return refit_over_windows(asked_.problem(), *base_, explanation);
  }

  WindowRefit() { asked_.options.decision.long_window = 3; }
  support::Asked asked_ = support::asked(friction_and_more);
  std::shared_ptr<const Baseline> base_ = asked_.baseline();
};

TEST_F(WindowRefit, CoefficientsAreThoseThatHoldOverWindows) {
  const Explanation friction = with(support::plain_candidate("sign(v)"));
  const auto found = refitted(friction);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->fit.model.coefficient(1, "q"), -4.0, 0.1);
  EXPECT_NEAR(found->fit.model.coefficient(1, "F"), 1.0, 0.05);
  EXPECT_NEAR(found->effects[0].coefficient, -0.3, 0.04);
  EXPECT_EQ(found->effects[0].coefficient, found->fit.model.coefficient(1, "sign(v)"));
  EXPECT_GT(found->effects[0].deviation, 0.0);
  EXPECT_LT(window_gap(found->fit), 1.05 * window_gap(friction.fit));
}

TEST_F(WindowRefit, IsNotForMemoryDelaysOrTheMeasurement) {
  Candidate lag = support::plain_candidate("z");
  lag.memory = {{"z", parse_expression("q-z"), parse_expression("0"), false}};
  Candidate skew = support::plain_candidate("v");
  skew.place = Place::Channel;
  for (const Candidate& other : {lag, skew, support::plain_candidate("delay(v,0.3)")})
    EXPECT_FALSE(refitted(with(other))) << other.form.to_string();
}

inline constexpr StageInfo kSmall{"small", "A bound for tests", ""};

/// Two bodies and a spring; what is hidden acts between them.
std::string bodies(const std::string& on_first, const std::string& on_second) {
  return "time s\ninput u\nstate d\nstate w1\nstate w2\ndd/dt = w1-w2\n"
         "dw1/dt = -6*d-0.3*w1+u" +
         on_first + "\ndw2/dt = 4*d-0.3*w2" + on_second + "\n";
}

/// 800 samples of 40 s with white noise, a fraction of each channel's standard deviation.
Dataset record_of(const OdeModel& truth, double noise) {
  const Vector time = sample_times(0.0, 0.05, 800);
  const Matrix force = 2.0 * (support::grey_box_inputs(time, 1).array() - 1.0);
  RecordInput signal(time, force, Interpolation::Linear);
  const Solution orbit = simulate(DrivenModel{truth, signal, signal.breaks()}, Rk4{},
                                  Vector::Constant(3, 0.05), time);
  Dataset data;
  data.time_unit = "s";
  data.states = truth.states();
  data.inputs = truth.inputs();
  Random random(5);
  Matrix states = orbit.states;
  for (auto column : states.colwise()) {
    const double deviation =
        noise * std::sqrt((column.array() - column.mean()).square().mean());
    for (double& value : column) value += deviation * random.normal();
  }
  data.trajectories = {{"record", time, std::move(states), force, Matrix()}};
  return data;
}

class SharedForm : public testing::Test {
 protected:
  SharedForm() {
    asked_.options.effects = {support::FormEffect<support::kDry>("sign(d)"),
                              support::FormEffect<kSmall>("clip(d,-0.1,0.1)")};
    asked_.nominal = parse_ode(bodies("", ""), "bodies");
  }

  /// Both forms, the first in the first body and the other in the second, and what they agree
  /// on.
  std::vector<std::string> agreed(const std::string& truth_first,
                                  const std::string& truth_second, double noise) {
    asked_.records =
        observed(record_of(parse_ode(bodies(truth_first, truth_second), "truth"), noise));
    base_ = asked_.baseline();
    const Problem problem = asked_.problem();
    const EffectSearch search{problem, *base_, asked_.options.effects};
    FoundEffects found{{{}, base_->fitted}};
    std::vector<FittedEffect> effects;
    for (Index k = 0; k < 2; ++k) {
      const auto& effect = asked_.options.effects[static_cast<std::size_t>(k)];
      effects.push_back({effect->candidates(base_->scope, k + 1).front(), Vector(), 0.0, 0.0});
      effects.back().candidate.equation = k + 1;
      effects.back().candidate.argument = parse_expression("d");
      found.named.push_back({.equation = k + 1, .name = k == 0 ? "dry" : "small"});
    }
    found.explanation = explain_on(problem, *base_, base_->fitted, effects);
    is_changed_ = agree_on_forms(search, found);
    return {found.named[0].name, found.named[1].name};
  }

  support::Asked asked_{.records = {}};
  std::shared_ptr<const Baseline> base_;
  bool is_changed_ = false;
};

TEST_F(SharedForm, OneFormActsInBothWhereNoiseHidesWhichItIs) {
  EXPECT_EQ(agreed("+4*clip(d,-0.1,0.1)", "-3*clip(d,-0.1,0.1)", 0.2),
            (std::vector<std::string>{"small", "small"}));
  EXPECT_TRUE(is_changed_);
}

TEST_F(SharedForm, DifferentFormsStayWhereTheRecordsTellThemApart) {
  EXPECT_EQ(agreed("+sign(d)", "-8*clip(d,-0.1,0.1)", 0.002),
            (std::vector<std::string>{"dry", "small"}));
  EXPECT_FALSE(is_changed_);
}

}  // namespace
}  // namespace lacuna
