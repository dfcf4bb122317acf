// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "lacuna/dynamics/integration/integrators.hpp"

namespace lacuna {

/// What cvode() makes.
class Cvode final : public Configured<Integrator, CvodeOptions> {
 public:
  using Configured::Configured;

  /// Why it cannot be used: "" or "built without SUNDIALS".
  static std::string unavailable();

  int order() const override { return 5; }

  /// @throws ConfigError when built without SUNDIALS; ArgumentError for no state or more than
  ///   the dense Jacobian has room for.
  std::unique_ptr<Stepper> make_stepper(Index dimension) const override;
};

}  // namespace lacuna
