// SPDX-License-Identifier: MIT
#include "hypotheses/channel_forms.hpp"

#include <gtest/gtest.h>

#include "support/diagnosis_scope.hpp"

namespace lacuna {
namespace {

FittedEffect fitted(const Candidate& candidate, double coefficient, double shape = 0.0) {
  Vector shapes(static_cast<Index>(candidate.shapes.size()));
  shapes.setConstant(shape);
  return {candidate, shapes, coefficient, 0.0};
}

TEST(ChannelForms, AreGainOffsetDriftAndLag) {
  const Scope scope = support::oscillator_scope();
  const std::vector<Candidate> forms = channel_forms(scope, 1);
  ASSERT_EQ(forms.size(), 4u);
  for (const Candidate& form : forms) {
    EXPECT_EQ(form.place, Place::Channel);
    EXPECT_EQ(form.equation, 1);
    EXPECT_FALSE(form.starts.empty());
  }
  const OdeModel& model = scope.model;
  EXPECT_EQ(channel_name(fitted(forms[0], 0.03), model).name, "sensor-gain");
  EXPECT_NE(channel_name(fitted(forms[0], -0.03), model).sentence.find("3 % too little"),
            std::string::npos);
  EXPECT_EQ(channel_name(fitted(forms[1], 0.2), model).name, "sensor-offset");
  EXPECT_NE(channel_name(fitted(forms[1], 0.2), model).sentence.find("too much"),
            std::string::npos);
  EXPECT_EQ(channel_name(fitted(forms[2], 0.2), model).name, "sensor-drift");
  const ChannelName lag = channel_name(fitted(forms[3], 1.0, 0.07), model);
  EXPECT_EQ(lag.name, "sensor-lag");
  EXPECT_NE(lag.sentence.find("0.07"), std::string::npos);
}

TEST(ChannelForms, ADriftBeginsWithTheRecord) {
  Scope scope = support::oscillator_scope();
  scope.start = 100.0;
  EXPECT_EQ(channel_forms(scope, 0)[2].form.to_string(), "t-100");
}

TEST(ChannelForms, AFilterShowsWhatIsBehindIt) {
  const Scope scope = support::oscillator_scope();
  const Candidate lag = channel_forms(scope, 0).back();
  ASSERT_EQ(lag.memory.size(), 1u);
  EXPECT_EQ(lag.memory[0].start.to_string(), scope.state(0).name);
  EXPECT_LE(lag.shapes[0].low, 0.34 * scope.step);
  EXPECT_EQ(lag.shapes[0].high, scope.state(0).timescale);
}

}  // namespace
}  // namespace lacuna
