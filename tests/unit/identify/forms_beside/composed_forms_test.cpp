// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "identify/forms_beside/product_forms.hpp"
#include "lacuna/dynamics/test_systems/measurement.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "support/noisy_records.hpp"

namespace lacuna {
namespace {

Scope composable_scope(double offset) {
  Dataset data = noisy_record("van-der-pol", 400, 0.01, 1);
  for (Trajectory& record : data.trajectories) record.states.array() += offset;
  return make_scope(test_system("van-der-pol").model, data, Eigen::Vector2d(0.02, 0.02));
}

std::multiset<std::string> compositions_of(const Scope& scope) {
  std::multiset<std::string> forms;
  for (const Candidate& candidate : composed_forms(scope, 1))
    forms.insert(candidate.form.to_string());
  return forms;
}

TEST(ComposedForms, AreMonomialsTimesAFunctionOfOneVariable) {
  const auto forms = compositions_of(composable_scope(0.0));
  for (const char* form : {"q*exp(q/a)", "q*cos(q)", "v*sin(q/a)", "q*v*exp(-v/a)", "sin(q-v)"})
    EXPECT_EQ(forms.count(form), 1u) << form;
  EXPECT_EQ(forms.count("exp(q/a)"), 0u) << "that one is no product";
}

TEST(ComposedForms, OnlyPositiveVariablesAreDenominatorsAndHavePowers) {
  const auto both = compositions_of(composable_scope(0.0)),
             positive = compositions_of(composable_scope(10.0));
  for (const char* form : {"1/q", "v/q^2", "v^2/q", "v*q^power"}) {
    EXPECT_EQ(both.count(form), 0u) << form;
    EXPECT_EQ(positive.count(form), 1u) << form;
  }
  EXPECT_EQ(positive.count("q/q"), 0u);
}

TEST(ComposedForms, BelongToTheEquationAndHaveStarts) {
  const std::vector<Candidate> all = composed_forms(composable_scope(10.0), 1);
  ASSERT_FALSE(all.empty());
  for (const Candidate& candidate : all) {
    EXPECT_EQ(candidate.equation, 1);
    ASSERT_FALSE(candidate.starts.empty()) << candidate.form.to_string();
    EXPECT_EQ(static_cast<std::size_t>(candidate.starts[0].size()), candidate.shapes.size());
  }
}

}  // namespace
}  // namespace lacuna
