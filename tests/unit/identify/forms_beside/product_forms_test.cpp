// SPDX-License-Identifier: MIT
#include "identify/forms_beside/product_forms.hpp"

#include <gtest/gtest.h>

#include <set>

#include "lacuna/dynamics/test_systems/measurement.hpp"
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

TEST(ProductForms, AreProductsOfMonomialsAndFunctionsOfAmounts) {
  const auto forms = forms_of(scope_with(10.0));
  for (const char* form : {"1/(1+q/a)", "q/(a+q)", "q*v/(a+q)", "v/(1+q^2/a^2)",
                           "q*v/(1+v^4/a^4)", "q^2*v/(a^2+q^2)", "v^3/(a^3+v^3)"})
    EXPECT_EQ(forms.count(form), 1u) << form;
}

TEST(ProductForms, HaveNoPoleWhereAVariableChangesSign) {
  const auto forms = forms_of(scope_with(0.0));
  EXPECT_EQ(forms.count("v/(1+q^2/a^2)"), 1u);
  EXPECT_EQ(forms.count("q*v/(a+q)"), 0u);
  EXPECT_EQ(forms.count("v/(1+q^3/a^3)"), 0u);
}

TEST(MonomialsOf, AreAllUpToTheDegree) {
  std::set<std::string> names;
  for (const Expression& monomial : monomials_of(scope_with(0.0), 2))
    names.insert(monomial.to_string());
  EXPECT_EQ(names, (std::set<std::string>{"1", "q", "v", "q^2", "q*v", "v^2"}));
}

}  // namespace
}  // namespace lacuna
