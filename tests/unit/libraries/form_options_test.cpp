// SPDX-License-Identifier: MIT
#include "lacuna/libraries/form_options.hpp"

#include <gtest/gtest.h>

#include "lacuna/config/registry.hpp"
#include "lacuna/dynamics/runge_kutta.hpp"
#include "lacuna/libraries/identify_with_forms.hpp"
#include "lacuna/model/ode_text.hpp"
#include "lacuna/pipeline/presets.hpp"
#include "lacuna/systems/measurement.hpp"

namespace lacuna {
namespace {

/// A pendulum, identified with options.
IdentificationResult pendulum(const FormOptions& options) {
  const Dataset data = record_of(parse_ode("dx/dt = y\ndy/dt = -0.9*sin(x)", "pendulum"),
                                 Dopri87{}, Eigen::Vector2d(-1.9, 0.0), 0.02, 512);
  return identify_with_forms(data, algorithm1(), default_registry().make_all<Effect>(),
                             options);
}

TEST(FormOptions, WhatIsNotWorthAskingGetsNoForm) {
  EXPECT_TRUE(pendulum({}).library_alone);
  EXPECT_FALSE(pendulum({.worth_asking = 1.0}).library_alone);
}

TEST(FormOptions, StayInTheirRanges) {
  FormOptions options;
  EXPECT_NO_THROW(checked(options));
  options.alike = 1.5;
  EXPECT_THROW(checked(options), ConfigError);
  options = {.most_forms = -1};
  EXPECT_THROW(checked(options), ConfigError);
}

}  // namespace
}  // namespace lacuna
