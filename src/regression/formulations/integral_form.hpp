// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/regression/formulations.hpp"

namespace lacuna {

/// What integral_form() makes.
class IntegralForm final : public Configured<Formulation, IntegralFormOptions> {
 public:
  using Configured::Configured;

 private:
  LeastSquaresSystem do_assemble(const Dataset& data, const TermLibrary& library,
                                 const RunContext& context) const override;
  std::optional<Vector> do_target_noise(const Dataset& data,
                                        const Vector& state_noise) const override;
};

}  // namespace lacuna
