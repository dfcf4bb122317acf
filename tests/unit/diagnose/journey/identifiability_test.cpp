// SPDX-License-Identifier: MIT
#include "diagnose/journey/identifiability.hpp"

#include <gtest/gtest.h>

#include "support/asked.hpp"

namespace lacuna {
namespace {

/// A baseline of the oscillator, with hidden states as it may be.
Baseline base_of(const support::Asked& asked, std::vector<bool> hidden) {
  Baseline base = *asked.baseline();
  base.fit_options.hidden = std::move(hidden);
  return base;
}

Assimilation holding(const Baseline& base, const Vector& direction) {
  Assimilation fit = base.fitted;
  fit.held = direction;
  return fit;
}

TEST(Identifiability, AUnitIsKept) {
  const support::Asked asked = support::asked(support::nothing);
  const Baseline base = base_of(asked, {false, true});
  Assimilation fit = holding(base, Vector{{std::sqrt(0.5), 0.0, -std::sqrt(0.5)}});
  for (const Index unit : {0, 2}) {
    fit.units = {unit};
    const auto hints = identifiability_hints(asked.problem(), base, fit);
    ASSERT_FALSE(hints.empty());
    const CoefficientPlace& place = fit.free[static_cast<std::size_t>(unit)];
    const std::string kept =
        fit.model.equations()[1][static_cast<std::size_t>(place.term)].term.name() +
        " in dv/dt is kept as the model gives it";
    EXPECT_NE(hints.front().message.find("only as their product: " + kept), std::string::npos)
        << hints.front().message;
  }
}

}  // namespace
}  // namespace lacuna
