// SPDX-License-Identifier: MIT
#include "diagnose/search/shared_form.hpp"

#include <gtest/gtest.h>

#include "support/asked.hpp"
#include "support/grey_box.hpp"
#include "support/own_effects.hpp"

namespace lacuna {
namespace {

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
