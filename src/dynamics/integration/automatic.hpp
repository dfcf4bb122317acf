// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "lacuna/dynamics/integration/integrators.hpp"

namespace lacuna {

/// What automatic() makes.
class Automatic final : public Configured<Integrator, AutomaticOptions> {
 public:
  using Configured::Configured;
  int order() const override { return 5; }
  std::unique_ptr<Stepper> make_stepper(Index dimension) const override;
};

}  // namespace lacuna
