// SPDX-License-Identifier: MIT
#include "diagnose/hypotheses/channel_forms.hpp"

#include <gtest/gtest.h>

#include "support/diagnosis_scope.hpp"

namespace lacuna {
namespace {

FittedEffect fitted(const Candidate& candidate, double coefficient, double shape = 0.0) {
  Vector shapes(static_cast<Index>(candidate.shapes.size()));
  shapes.setConstant(shape);
  return {candidate, shapes, coefficient, 0.0};
}

/// The form of a channel.
Candidate form_of(const std::string& text, const Scope& scope, Index state = 1) {
  for (const Candidate& form : channel_forms(scope, state))
    if (form.form == parse_expression(text)) return form;
  ADD_FAILURE() << "there is no " << text;
  return {};
}

void expect_name(const Candidate& form, double coefficient, const std::string& name,
                 const std::string& words, double shape = 0.0) {
  const ChannelName said =
      channel_name(fitted(form, coefficient, shape), support::oscillator_scope().model);
  EXPECT_EQ(said.name, name);
  EXPECT_NE(said.sentence.find(words), std::string::npos) << said.sentence;
}

TEST(ChannelForms, HaveNamesAndSentences) {
  const Scope scope = support::oscillator_scope();
  expect_name(form_of("v", scope), 0.03, "sensor-gain", "3 % too much");
  expect_name(form_of("v", scope), -0.03, "sensor-gain", "3 % too little");
  expect_name(form_of("1", scope), 0.2, "sensor-offset", "0.2 m/s too much");
  expect_name(form_of("t", scope), 0.2, "sensor-drift", "0.2 m/s per s");
  expect_name(form_of("behind-v", scope), 1.0, "sensor-lag", "0.07 s", 0.07);
  expect_name(form_of("v^2", scope), -0.1, "sensor-gain",
              "not linear: it reads 0.1*v^2 too little");
  expect_name(form_of("end*tanh(v/end)-v", scope), 1.0, "sensor-gain", "3*tanh(v/3)", 3.0);
  expect_name(form_of("q", scope), 0.05, "sensor-offset", "picks up 0.05*q too much");
  expect_name(form_of("F", scope), 0.05, "sensor-offset", "picks up 0.05*F too much");
}

/// 1/(1 + L s + b (L s)^2) against 1 + c (1/(1 + tau s)^n - 1), both to the second power of s.
TEST(ChannelForms, AreLateByALagOrADelay) {
  const Scope scope = support::oscillator_scope();
  const std::vector<Candidate> late = late_channel_forms(scope, 1);
  ASSERT_EQ(late.size(), 2u);
  for (const Candidate& form : late) EXPECT_TRUE(is_whole(form));
  const auto said = [&](std::size_t filters, double coefficient) {
    return channel_name({late[filters - 1], Vector::Constant(1, 0.07), coefficient, 0.0},
                        scope.model);
  };
  EXPECT_EQ(said(1, 1.0).name, "sensor-lag");
  EXPECT_EQ(said(2, 1.0).name, "sensor-lag");
  EXPECT_NE(said(2, 1.0).sentence.find("0.14 s"), std::string::npos);
  EXPECT_EQ(said(2, 9.0 / 8.0).name, "sensor-lag") << "means";
  EXPECT_EQ(said(1, 1.5).name, "sensor-lag") << "means";
  EXPECT_EQ(said(1, 2.0).name, "channel-skew") << "a delay of 0.14 s";
  EXPECT_NE(said(1, 2.0).sentence.find("0.14 s"), std::string::npos);
  EXPECT_EQ(said(2, 1.5).name, "channel-skew");
}

TEST(ChannelForms, AToneOfTheResidualsMayBeAHum) {
  Scope scope = support::oscillator_scope();
  const std::size_t without = channel_forms(scope, 1).size();
  scope.lines = {{0, 5.0, 0.3}, {1, 0.1, 0.0}};  // the second is longer than half the record
  EXPECT_EQ(channel_forms(scope, 1).size(), without + 1);
  const Candidate hum = form_of("sin(2*pi*frequency*t+phase)", scope);
  EXPECT_EQ(hum.equation, 1) << "wherever the line was seen";
  EXPECT_FALSE(is_whole(hum));
  expect_name(hum, 0.02, "sensor-offset", "a hum of 0.02 m/s, 5 per s", 5.0);
}

}  // namespace
}  // namespace lacuna
