// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "lacuna/core/base/options.hpp"
#include "lacuna/dynamics/integration/integrator.hpp"

namespace lacuna {

/// Options of Cvode. The local error estimate of a step, divided per state by
/// absolute + relative * |x|, has a root mean square of at most 1.
struct CvodeOptions {
  static constexpr StageInfo kInfo{
      "cvode", "CVODE of SUNDIALS: implicit, for stiff models, order 1 to 5, adaptive step.",
      "Hindmarsh et al., ACM Trans. Math. Softw. 31 (2005) 363"};
  double relative_tolerance = 1e-11;
  double absolute_tolerance = 1e-12;    ///< in the units of the states
  std::optional<double> max_step = {};  ///< time units
  int max_steps = 100000;               ///< per sampling interval; more is StepTooSmall

  void describe(OptionVisitor& visitor);
};

/// Backward differentiation formulas with Newton's method; the Jacobian is dense and made by
/// differences. The integrator for models with time scales far apart (a gate with ns and ms, a
/// reaction near its equilibrium), of which explicit methods take the shortest everywhere.
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
