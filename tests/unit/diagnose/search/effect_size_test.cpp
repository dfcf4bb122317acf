// SPDX-License-Identifier: MIT
#include "diagnose/search/effect_size.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/asked.hpp"
#include "support/assimilated_oscillator.hpp"

namespace lacuna {
namespace {

bool counts(const EffectSize& size, const Explanation& explanation, const Explanation& after) {
  Extended before{explanation};
  return !size.shortfall(before, after);
}

std::string quantity(const EffectSize& size, const Explanation& explanation,
                     const Explanation& after) {
  Extended before{explanation};
  const auto shortfall = size.shortfall(before, after);
  return shortfall && shortfall->value < shortfall->threshold ? shortfall->quantity : "none";
}

class EffectSizes : public testing::Test {
 protected:
  /// The baseline with another fraction of the variance of its disturbance.
  Explanation leaving(double fraction) const {
    Explanation made{{{candidate_, Vector(0), 1.0, 0.1}}, base_->fitted};
    made.fit.noise.disturbance[1] *= std::sqrt(fraction);
    return made;
  }
  /// What the records are made of, brought onto them: nothing lasts in its windows.
  Assimilation complete() const {
    return explain_on(problem_, *base_, base_->fitted,
                      {{support::plain_candidate("sin(6*q)"), Vector(0), 0.0, 0.0}})
        .fit;
  }

  support::Asked asked_ = support::asked(support::ripple);
  std::shared_ptr<const Baseline> base_ = asked_.baseline();
  const Problem problem_ = asked_.problem();
  Candidate candidate_ = support::plain_candidate("q^3");
};

TEST_F(EffectSizes, IsOneForTheNominalModel) {
  const EffectSize size(problem_, *base_);
  EXPECT_DOUBLE_EQ(size.disturbance(base_->fitted, candidate_), 1.0);
  EXPECT_DOUBLE_EQ(size.gap(base_->fitted), 1.0);
  EXPECT_NEAR(size.disturbance(leaving(0.3).fit, candidate_), 0.3, 1e-12);
  Candidate measured = candidate_;
  measured.place = Place::Channel;
  measured.equation = 0;
  EXPECT_NEAR(size.disturbance(leaving(0.3).fit, measured), 0.3, 1e-12)
      << "of the only equation that is disturbed";
}

TEST_F(EffectSizes, CountsByTheFractionsThatAreAsked) {
  const EffectSize size(problem_, *base_);
  EXPECT_TRUE(counts(size, leaving(1.0), leaving(0.4))) << "most goes";
  EXPECT_EQ(quantity(size, leaving(1.0), leaving(0.95)), "fraction of the residual that goes");
  EXPECT_EQ(quantity(size, leaving(1.0), leaving(0.7)),
            "fraction of the nominal model's squared gap that goes");
  EXPECT_EQ(quantity(size, leaving(0.04), leaving(0.032)),
            "fraction of the nominal model's disturbance that goes");
  Explanation lasting = leaving(0.26);
  lasting.fit = complete();
  const Vector noise = base_->fitted.noise.disturbance;
  lasting.fit.noise.disturbance = std::sqrt(0.26) * noise;
  EXPECT_FALSE(counts(size, leaving(0.3), lasting)) << "0.04 of the disturbance are negligible";
  lasting.fit.noise.disturbance = std::sqrt(0.24) * noise;
  EXPECT_TRUE(counts(size, leaving(0.3), lasting)) << "most of what lasts goes";
  asked_.options.decision.major = 0.25;
  EXPECT_TRUE(counts(size, leaving(1.0), leaving(0.7))) << "most, if a quarter is most";
  asked_.options.decision = {.minor = 0.7};
  EXPECT_FALSE(counts(size, leaving(1.0), leaving(0.4))) << "0.6 are a minor part then";
}

TEST_F(EffectSizes, IsNearWhereNeitherDisturbanceNorGapIsNoticeablyMore) {
  const EffectSize size(problem_, *base_);
  EXPECT_TRUE(size.is_near(leaving(0.54).fit, leaving(0.5).fit, candidate_));
  EXPECT_FALSE(size.is_near(leaving(0.56).fit, leaving(0.5).fit, candidate_));
  Assimilation best = complete();
  best.noise.disturbance = base_->fitted.noise.disturbance;
  EXPECT_FALSE(size.is_near(base_->fitted, best, candidate_)) << "the gap is larger";
  EXPECT_TRUE(size.is_near(best, base_->fitted, candidate_));
}

}  // namespace
}  // namespace lacuna
