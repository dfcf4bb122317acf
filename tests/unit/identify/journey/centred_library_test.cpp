// SPDX-License-Identifier: MIT
#include "identify/journey/centred_library.hpp"

#include <gmock/gmock.h>

#include "lacuna/bases/expressions.hpp"
#include "lacuna/bases/monomials.hpp"
#include "lacuna/identify/journey/identify_records.hpp"
#include "lacuna/identify/pipeline/presets.hpp"
#include "lacuna/model/files/ode_text.hpp"
#include "unit/identify/pipeline/records.hpp"

namespace lacuna {
namespace {

using ::testing::HasSubstr;

/// Prey and predator, shifted; noise of a thousandth of each deviation.
Dataset shifted_record(double prey, double predator) {
  const OdeModel model =
      parse_ode("dx/dt = 0.7*x - 0.5*x*y\ndy/dt = -0.6*y + 0.4*x*y\n", "prey");
  Dataset data =
      add_relative_noise(testing::without_derivatives(
                             record_of(model, Dopri87{}, Eigen::Vector2d(1.0, 1.0), 0.05, 600)),
                         1e-3, 5);
  data.trajectories[0].states.col(0).array() += prey;
  data.trajectories[0].states.col(1).array() += predator;
  return data;
}

Pipeline of_degree(int degree) {
  Pipeline pipeline = algorithm1();
  pipeline.basis = Monomials{{.max_degree = degree}};
  return pipeline;
}

TEST(CentredLibrary, WhatAShiftDoesNotLeaveAsItIsStays) {
  const Dataset data = shifted_record(1000.0, 0.0);
  const auto stays = [&](const Pipeline& pipeline) {
    std::vector<std::string> warnings;
    const Pipeline centred = with_centred_library(pipeline, data, warnings);
    return warnings.empty() && centred.basis->library({{"x", "y"}, {}}).names() ==
                                   pipeline.basis->library({{"x", "y"}, {}}).names();
  };
  EXPECT_FALSE(stays(of_degree(2)));
  EXPECT_TRUE(stays(of_degree(1))) << "a line is a line from anywhere";
  Pipeline given = of_degree(2);
  for (const std::vector<std::string>& terms : {std::vector<std::string>{"1", "x^2"},
                                                {"1", "x", "x^2", "sin(x)"},
                                                {"x", "x^2", "1/x"}}) {
    given.basis = Expressions{{.terms = terms}};
    EXPECT_TRUE(stays(given));
  }
  given.basis = Expressions{{.terms = {"1", "x", "x^2", "y^3"}}};
  EXPECT_FALSE(stays(given)) << "y is where it was";
  given = of_degree(2);
  given.equations = {{"x", {"x", "x*y"}}};
  EXPECT_TRUE(stays(given));
  given = of_degree(2);
  given.energy_preserving = true;
  EXPECT_TRUE(stays(given));
}

TEST(CentredLibrary, AnOffsetChangesNothingButWhereTheStateIsCountedFrom) {
  const auto equations = [](double prey) {
    IdentificationTask task;
    task.pipeline = of_degree(2);
    return identify_records(shifted_record(prey, 0.0), task).result;
  };
  const IdentificationResult near = equations(0.0);
  ASSERT_EQ(near.model.equations()[0].size(), 2u);
  for (const double prey : {1e3, -1e5, 1e7}) {
    const IdentificationResult far = equations(prey);
    CompiledModel model = far.model.compile();
    const Eigen::Vector2d place(2.0 + prey, 0.5);
    Eigen::Vector2d rate;
    model.evaluate(0.0, place.data(), nullptr, nullptr, rate.data());
    EXPECT_NEAR(rate[0], 0.7 * 2.0 - 0.5, 0.02) << prey;
    EXPECT_NEAR(rate[1], -0.3 + 0.4, 0.02) << prey;
    EXPECT_LE(far.model.equations()[0].size(), 4u) << "1, x - c, y, (x - c) y";
    EXPECT_THAT(far.warnings, ::testing::Contains(HasSubstr("terms are powers of x")));
    EXPECT_EQ(far.adequacy.fits, near.adequacy.fits);
  }
}

}  // namespace
}  // namespace lacuna
