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

TEST(NameTable, ParametersHaveTheNamesOfTheEffect) {
  const Bends bends;
  const FittedEffect fitted{
      support::candidate_of<kPiecewiseLinear>(bends.scope, 1, "clip(q-u,-edge,edge)"),
      Vector::Constant(1, 0.3), 60.0, 0.1};
  const std::vector<Stage<Effect>> effects{FamilyEffect<kBacklash>()};
  const NameTable table{effects, bends.scope, bends.options};
  const Name name = table.names_of(fitted, bends.scope.model).at(0);
  EXPECT_EQ(name.parameters, std::vector<std::string>{"gap"});
  EXPECT_EQ(name.sentence, "play in q-u");
  EXPECT_EQ(name.cause, "worn gears, couplings, linkages, screws");
}

}  // namespace
}  // namespace lacuna
