// SPDX-License-Identifier: MIT
#include "lacuna/regression/stages/basis.hpp"

#include <set>

#include "contract/contract.hpp"

namespace lacuna::contract {
namespace {

class EveryBasis : public testing::TestWithParam<StageVariant> {};

/// The library of a basis; nothing for one that has no terms before it is told them and says
/// so.
std::optional<TermLibrary> library_of(const StageVariant& variant, const Variables& variables) {
  try {
    return stage_of<Basis>(variant)->library(variables);
  } catch (const ConfigError& error) {
    EXPECT_FALSE(error.remedy().empty()) << error.what();
    return std::nullopt;
  }
}

TEST_P(EveryBasis, MakesDistinctTermsThatCanBeReadBack) {
  const Variables variables{{"x", "y"}, {"u"}};
  const auto library = library_of(GetParam(), variables);
  if (!library) return;
  std::set<std::string> names;
  for (const Term& term : library->terms) {
    EXPECT_TRUE(names.insert(term.name()).second) << term.name() << " twice";
    EXPECT_EQ(Term::parse(term.name(), variables), term);
  }
  EXPECT_EQ(library->variables, variables);
  EXPECT_EQ(library->compile().outputs(), library->size());
}

TEST_P(EveryBasis, ContainsTheStatesThemselves) {
  const auto library = library_of(GetParam(), {{"x", "y"}, {}});
  if (!library) return;
  const std::vector<std::string> names = library->names();
  for (const std::string state : {"x", "y"})
    EXPECT_EQ(std::count(names.begin(), names.end(), state), 1) << state;
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryBasis, testing::ValuesIn(available(Basis::kKind)),
                         test_name);

}  // namespace
}  // namespace lacuna::contract
