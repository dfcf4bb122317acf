// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/regression/formulations.hpp"

namespace lacuna {

/// What strong_form() makes.
class StrongForm final : public Configured<Formulation, StrongFormOptions> {
 public:
  explicit StrongForm(Options options)
      : Configured(std::move(options)) {}  ///< the differentiator is given

 private:
  LeastSquaresSystem do_assemble(const Dataset& data, const TermLibrary& library,
                                 const RunContext& context) const override;
  LeastSquaresSystem do_assemble_long(const RecordStream& records, const TermLibrary& library,
                                      const RunContext& context) const override;
  std::optional<Vector> do_target_noise(const Dataset& data,
                                        const Vector& state_noise) const override;
  std::shared_ptr<const Formulation> do_fit(const Dataset& data,
                                            const std::optional<Vector>& noise) const override;
};

}  // namespace lacuna
