// SPDX-License-Identifier: MIT
#include "lacuna/identify/forms_beside/form_options.hpp"

#include <gtest/gtest.h>

#include "identify/forms_beside/identify_with_forms.hpp"
#include "lacuna/cli/configuration/registry.hpp"
#include "lacuna/dynamics/integration/runge_kutta.hpp"
#include "lacuna/dynamics/test_systems/measurement.hpp"
#include "lacuna/identify/pipeline/presets.hpp"
#include "lacuna/model/files/ode_text.hpp"

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
