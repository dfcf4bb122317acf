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

TEST(Identifiability, AProductIsCalledSo) {
  const support::Asked asked = support::asked(support::nothing);
  const Baseline base = base_of(asked, {false, true});
  const Vector product{{std::sqrt(0.5), 0.0, -std::sqrt(0.5)}};
  const auto hints = identifiability_hints(asked.problem(), base, holding(base, product));
  ASSERT_FALSE(hints.empty());
  EXPECT_EQ(hints.front().kind, HintKind::NotIdentifiable);
  EXPECT_NE(hints.front().message.find("only as their product"), std::string::npos)
      << hints.front().message;
  EXPECT_NE(hints.front().message.find("F in dv/dt"), std::string::npos);
  EXPECT_EQ(hints.front().message.find("v in dv/dt,"), std::string::npos);
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

TEST(Identifiability, ARowOfTheHeldDirectionsTells) {
  Assimilation fit{support::oscillator()};
  fit.held = Vector{{0.0, 0.9}};
  EXPECT_FALSE(is_held(fit, 0));
  EXPECT_TRUE(is_held(fit, 1));
  EXPECT_FALSE(is_held(fit, 7)) << "what an effect has is not among them";
}

}  // namespace
}  // namespace lacuna
