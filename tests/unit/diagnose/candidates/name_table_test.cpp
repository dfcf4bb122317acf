// SPDX-License-Identifier: MIT
#include "diagnose/candidates/name_table.hpp"

#include <gtest/gtest.h>

#include "lacuna/effects/families.hpp"
#include "support/effect_forms.hpp"

namespace lacuna {
namespace {

/// Two bends between an arm and its drive, of which the nominal model has the slope 60.
struct Bends {
  Scope scope = support::scope_of(support::model_of_lines(
      {{"q", {{"v", 1.0}}}, {"v", {{"q", -60.0}, {"u", 60.0}}}}, {"u"}));
  NamingOptions options;

  std::vector<std::string> names(double coefficient,
                                 const std::vector<Stage<Effect>>& effects) const {
    const FittedEffect fitted{
        support::candidate_of<kPiecewiseLinear>(scope, 1, "clip(q-u,-edge,edge)"),
        Vector::Constant(1, 0.3), coefficient, 0.1};
    std::vector<std::string> result;
    for (const Name& name : NameTable{effects, scope, options}.names_of(fitted, scope.model))
      result.push_back(name.name);
    return result;
  }
};

TEST(NameTable, NamesFollowFromTheFittedNumbers) {
  const Bends bends;
  const std::vector<Stage<Effect>> effects{FamilyEffect<kDeadZone>(),
                                           FamilyEffect<kPiecewiseLinear>()};
  EXPECT_EQ(bends.names(30.0, effects), std::vector<std::string>{"piecewise-linear"});
  EXPECT_EQ(bends.names(60.0, effects), std::vector<std::string>{"dead-zone"});
}

}  // namespace
}  // namespace lacuna
