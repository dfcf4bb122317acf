// SPDX-License-Identifier: MIT
#include "diagnose/journey/coefficient_changes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "diagnose/journey/identifiability.hpp"
#include "support/asked.hpp"
#include "support/assimilated_oscillator.hpp"

namespace lacuna {
namespace {

/// The oscillator with the coefficient of v in dv/dt 0.1 lower and that of q 0.5 higher, on the
/// record q = sin 2t, v = 2 cos 2t, F = sin(3t) / 2.
Assimilation changed() {
  const OdeModel nominal = support::oscillator();
  std::vector<Equation> equations = nominal.equations();
  equations[1][0].coefficient += 0.5;
  equations[1][1].coefficient -= 0.1;
  const Trajectory record = support::oscillator_record().trajectories.front();
  const OdeModel model(nominal.states(), nominal.inputs(), equations, nominal.time_unit());
  Assimilation fit{.model = model,
                   .records = {linearise(model, record, record.states, Vector::Zero(2))},
                   .free = {{1, 0}, {1, 1}, {1, 2}}};
  fit.covariance = Vector{{0.04, 0.0004, 0.0}}.asDiagonal();
  return fit;
}

TEST(CoefficientChanges, MostSignificantFirst) {
  const auto changes = coefficient_changes(support::oscillator(), changed(), 3);
  ASSERT_EQ(changes.size(), 3u);
  EXPECT_EQ(changes[0].term, "v");
  EXPECT_NEAR(changes[0].sigma, 0.1 / 0.02, 1e-9);
  EXPECT_EQ(changes[1].term, "q");
  EXPECT_NEAR(changes[1].sigma, 0.5 / 0.2, 1e-9);
  EXPECT_EQ(changes[1].nominal, -4.0);
  EXPECT_EQ(changes[1].estimated, -3.5);
  EXPECT_EQ(changes[2].term, "F");
  EXPECT_EQ(changes[2].sigma, 0.0) << "no standard error is no significance";
}

TEST(CoefficientChanges, TwoThatTheRecordsDoNotDistinguishAreOffTogether) {
  Assimilation fit = changed();  // q by 0.5, v by -0.1
  fit.covariance.setZero();
  fit.covariance.diagonal() << 0.25, 0.01, 1.0;  // one deviation each
  EXPECT_FALSE(combined_change(support::oscillator(), fit, 3, 3.0)) << "two of chi squared 2";
  // Nearly -1 correlated: q + 5 v is determined and has not moved, q - 5 v is not determined.
  fit.covariance(0, 1) = fit.covariance(1, 0) = -0.999 * 0.5 * 0.1;
  EXPECT_FALSE(combined_change(support::oscillator(), fit, 3, 3.0));
  // Nearly 1 correlated: q - 5 v is determined, and has moved by 1.
  fit.covariance(0, 1) = fit.covariance(1, 0) = 0.999 * 0.5 * 0.1;
  const auto found = combined_change(support::oscillator(), fit, 3, 3.0);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->first, "q");
  EXPECT_EQ(found->second, "v");
  EXPECT_NEAR(found->weight, -5.0, 1e-9);
  EXPECT_NEAR(found->nominal, -4.0 - 5.0 * -0.2, 1e-9);
  EXPECT_NEAR(found->estimated, found->nominal + 1.0, 1e-9);
  EXPECT_NEAR(found->deviation, std::sqrt(0.25 + 0.25 - 2.0 * 0.999 * 0.25), 1e-9);
  EXPECT_GT(found->sigma, 10.0);
  fit.covariance(2, 2) = 0.0;
  EXPECT_TRUE(combined_change(support::oscillator(), fit, 3, 3.0)) << "no error of the third";
  fit.covariance(1, 1) = 1e-6;
  fit.covariance(0, 1) = fit.covariance(1, 0) = 0.0;
  EXPECT_FALSE(combined_change(support::oscillator(), fit, 3, 3.0)) << "v is off by itself";
}

TEST(CoefficientChanges, WhatWasHeldHasNoError) {
  Assimilation fit = changed();
  fit.held = Matrix::Zero(3, 1);
  fit.held(1, 0) = 1.0;
  const auto changes = coefficient_changes(support::oscillator(), fit, 3);
  EXPECT_EQ(changes[0].term, "q") << "of v nothing is known";
  for (const CoefficientChange& change : changes) {
    EXPECT_EQ(change.determined, change.term != "v");
    EXPECT_EQ(change.deviation == 0.0, change.term != "q");
  }
  EXPECT_FALSE(with_intervals(fit).equations()[1][1].ci95.has_value());
  EXPECT_TRUE(with_intervals(fit).equations()[1][0].ci95.has_value());
}

TEST(CoefficientChanges, TheLargestIsTheRateThatMoves) {
  const Assimilation fit = changed();
  // 0.5 q - 0.1 v along q = sin 2t over the rate of v = 2 cos 2t, both by their integrals.
  double change = 0.0, rate = 0.0;
  for (int i = 0; i < 100000; ++i) {
    const double t = 1e-4 * (i + 0.5), q = std::sin(2.0 * t), v = 2.0 * std::cos(2.0 * t);
    change += std::pow(0.5 * q - 0.1 * v, 2);
    rate += std::pow(4.0 * q, 2);
  }
  const double found = largest_rate_change(support::oscillator(), fit);
  const Vector rates = rate_rms(fit);
  EXPECT_NEAR(found * rates[1], std::sqrt(change / 100000.0), 2e-3);
  EXPECT_NEAR(rates[1], std::sqrt(rate / 100000.0), 2e-2);
  EXPECT_GT(found, 0.0);
  EXPECT_EQ(largest_rate_change(fit.model, fit), 0.0) << "nothing moved";
}

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
