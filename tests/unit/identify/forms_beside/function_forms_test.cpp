// SPDX-License-Identifier: MIT
#include "identify/forms_beside/function_forms.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "lacuna/cli/configuration/registry.hpp"
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

TEST(FunctionForms, OfAmountsAloneTheSizeIsTheValueItself) {
  const auto effects = default_registry().make_all<Effect>();
  const auto has_drag = [&](double offset, const std::string& form) {
    const auto candidates = function_forms(scope_of(offset), effects, 1);
    return std::any_of(candidates.begin(), candidates.end(), [&](const Candidate& one) {
      return one.form.to_string() == form &&
             std::count(one.families.begin(), one.families.end(), "quadratic-drag") > 0;
    });
  };
  EXPECT_TRUE(has_drag(0.0, "v*abs(v)"));
  EXPECT_FALSE(has_drag(10.0, "v*abs(v)"));
  for (const std::string& form : forms_of(function_forms(scope_of(10.0), effects, 1)))
    for (const char* size : {"abs(q)", "abs(v)"})
      EXPECT_EQ(form.find(size), std::string::npos) << form;
}

}  // namespace
}  // namespace lacuna
