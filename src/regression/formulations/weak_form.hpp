// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "lacuna/regression/formulations.hpp"

namespace lacuna {

/// What weak_form() makes.
class WeakForm final : public Configured<Formulation, WeakFormOptions> {
 public:
  using Configured::Configured;

 private:
  LeastSquaresSystem do_assemble(const Dataset& data, const TermLibrary& library,
                                 const RunContext& context) const override;
  std::optional<Vector> do_target_noise(const Dataset& data,
                                        const Vector& state_noise) const override;
};

}  // namespace lacuna
