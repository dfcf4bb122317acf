// SPDX-License-Identifier: MIT
#include "lacuna/regression/formulations/integral_form.hpp"

#include <gtest/gtest.h>

#include "lacuna/regression/linear/subproblem.hpp"
#include "support/oscillation.hpp"

namespace lacuna {
namespace {

TermLibrary terms() {
  TermLibrary library{{{"x", "v"}, {"u"}}, {}};
  for (const char* text : {"x", "v"})
    library.terms.push_back(Term::parse(text, library.variables));
  return library;
}

TEST(IntegralForm, FindsAnOscillatorsCoefficients) {
  const auto system = IntegralForm{{.span = 20}}.assemble(oscillation_data(), terms());
  EXPECT_EQ(system.rows(), 38);
  EXPECT_LT((system.subproblem(1, {0, 1}).solve() - Eigen::Vector2d(-4, 0)).norm(), 1e-6);
}

TEST(IntegralForm, RefusesASpanBeyondTheRecord) {
  EXPECT_THROW(IntegralForm{{.span = 500}}.assemble(oscillation_data(), terms()), DataError);
}

}  // namespace
}  // namespace lacuna
