// SPDX-License-Identifier: MIT
#include "lacuna/identify/validation/advice.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lacuna/cli/configuration/registry.hpp"
#include "lacuna/regression/pruners/keep_all.hpp"
#include "lacuna/solvers/stlsq.hpp"
#include "lacuna/trajectories/refiners/no_refiner.hpp"
#include "unit/identify/validation/systems.hpp"

namespace lacuna {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<std::string> advice_on(const Dataset& data, const Pipeline& pipeline) {
  const IdentificationResult found = identify(data, pipeline);
  const std::vector<Stage<Effect>> effects = default_registry().make_all<Effect>();
  return advice_for({found, data, pipeline, effects});
}

TEST(Advice, NamesTheFormThatTheResidualAsksFor) {
  const Dataset pendulum = testing::record_of_text("dth/dt = w\ndw/dt = -9*sin(th) - 0.1*w\n",
                                                   Eigen::Vector2d(2.9, 0.0), 0.01, 3000);
  const std::vector<std::string> advice =
      advice_on(pendulum, testing::with_terms({"1", "th", "w"}));
  EXPECT_THAT(advice, ElementsAre(::testing::AllOf(HasSubstr("dw/dt"), HasSubstr("sin(th"),
                                                   HasSubstr("--add"))));
}

/// Coefficients below 0.1 are thresholded away: to add such a term is no advice.
TEST(Advice, WhatThePipelineWouldTakeOutAgainIsNotAdvised) {
  Pipeline pipeline = testing::with_terms({"1", "x", "v"});
  pipeline.regressor = Stlsq{{.threshold = 0.1}};
  pipeline.pruner = KeepAll{};
  pipeline.refiner = NoRefiner{};
  const auto advice_with = [&](const std::string& size) {
    return advice_on(testing::record_of_text("dx/dt = v\ndv/dt = -x + " + size + "*sin(4*x)\n",
                                             Eigen::Vector2d(2.0, 0.0), 0.01, 3000),
                     pipeline);
  };
  EXPECT_THAT(advice_with("0.5"), ElementsAre(HasSubstr("--add \"sin(x/0.25)\"")));
  EXPECT_THAT(advice_with("0.05"), ElementsAre(HasSubstr("lacuna diagnose")));
}

TEST(Advice, PointsToADiagnosisWhereNoFunctionHelps) {
  // A force that is not in the record.
  const Dataset driven =
      testing::record_of_text("dx/dt = v\ndv/dt = -x - 0.2*v + 3*sin(2.3*t)*cos(0.31*t)\n",
                              Eigen::Vector2d(1.0, 0.0), 0.05, 2000);
  const std::vector<std::string> advice =
      advice_on(driven, testing::with_terms({"1", "x", "v"}));
  ASSERT_FALSE(advice.empty());
  EXPECT_THAT(advice.back(), HasSubstr("lacuna diagnose"));
}

}  // namespace
}  // namespace lacuna
