// SPDX-License-Identifier: MIT
#include "identify/forms_beside/function_forms.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "lacuna/cli/configuration/registry.hpp"
#include "lacuna/dynamics/test_systems/measurement.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "support/noisy_records.hpp"

namespace lacuna {
namespace {

std::set<std::string> forms_of(const std::vector<Candidate>& candidates) {
  std::set<std::string> forms;
  for (const Candidate& candidate : candidates) forms.insert(candidate.form.to_string());
  return forms;
}

Scope scope_of(double offset) {
  Dataset data = noisy_record("van-der-pol", 400, 0.01, 1);
  for (Trajectory& record : data.trajectories) record.states.array() += offset;
  return make_scope(test_system("van-der-pol").model, data, Eigen::Vector2d(0.02, 0.02));
}

TEST(FunctionForms, OfVariablesThatTakeBothSigns) {
  const auto forms = forms_of(function_forms(scope_of(0.0), {}, 1));
  for (const char* form : {"sin(q)", "sin(q/a)", "sign(v)", "v*abs(v)", "q/(1+q^2/a^2)"})
    EXPECT_TRUE(forms.contains(form)) << form;
  EXPECT_FALSE(forms.contains("log(q)"));
  EXPECT_FALSE(forms.contains("q/(a+q)"));
}

TEST(FunctionForms, OfAmounts) {
  const auto forms = forms_of(function_forms(scope_of(10.0), {}, 1));
  for (const char* form : {"log(q)", "sqrt(v)", "q/(a+q)", "q^power"})
    EXPECT_TRUE(forms.contains(form)) << form;
}

TEST(FunctionForms, TakeOverWhatEffectsProposeThatActsAtOnce) {
  const auto effects = default_registry().make_all<Effect>();
  const auto candidates = function_forms(scope_of(0.0), effects, 1);
  for (const Candidate& candidate : candidates) {
    EXPECT_EQ(candidate.equation, 1);
    EXPECT_TRUE(candidate.memory.empty());
    EXPECT_EQ(candidate.place, Place::Rate);
    EXPECT_FALSE(candidate.form.variables().contains("t"));
    EXPECT_EQ(candidate.form.to_string().find("delay"), std::string::npos);
    EXPECT_FALSE(candidate.starts.empty());
  }
  EXPECT_TRUE(std::any_of(candidates.begin(), candidates.end(), [](const Candidate& candidate) {
    return std::count(candidate.families.begin(), candidate.families.end(), "saturation") > 0;
  }));
  // Each form once.
  for (std::size_t i = 0; i < candidates.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_FALSE(are_one_form(candidates[i], candidates[j]));
}

}  // namespace
}  // namespace lacuna
