// SPDX-License-Identifier: MIT
#include "identify/forms_beside/product_forms.hpp"

#include <gtest/gtest.h>

#include <set>

#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "support/noisy_records.hpp"

namespace lacuna {
namespace {

Scope scope_with(double offset) {
  Dataset data = noisy_record("van-der-pol", 400, 0.01, 1);
  for (Trajectory& record : data.trajectories) record.states.array() += offset;
  return make_scope(test_system("van-der-pol").model, data, Eigen::Vector2d(0.02, 0.02));
}

std::multiset<std::string> forms_of(const Scope& scope) {
  std::multiset<std::string> forms;
  for (const Candidate& candidate : product_forms(scope))
    forms.insert(candidate.form.to_string());
  return forms;
}

TEST(ProductForms, HaveNoPoleWhereAVariableChangesSign) {
  const auto forms = forms_of(scope_with(0.0));
  EXPECT_EQ(forms.count("v/(1+q^2/a^2)"), 1u);
  EXPECT_EQ(forms.count("q*v/(a+q)"), 0u);
  EXPECT_EQ(forms.count("v/(1+q^3/a^3)"), 0u);
}

}  // namespace
}  // namespace lacuna
