// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/options.hpp"
#include "lacuna/data/derivatives/differentiator.hpp"
#include "lacuna/regression/stages/formulation.hpp"

namespace lacuna {

/// Options of StrongForm.
struct StrongFormOptions {
  static constexpr StageInfo kInfo{
      "strong", "Rows are samples, the target is the derivative at the sample",
      "Karimov et al., Nonlinear Dyn. 111 (2023), Sect. 2.1"};

  Stage<Differentiator> differentiator;  ///< where the record brings no derivatives
  bool smooth_states = true;             ///< Theta from the differentiator's order 0

  void describe(OptionVisitor& v) {
    v.field({"differentiator", "", "Gives dx/dt where the record does not bring it."},
            differentiator);
    v.field({"smooth_states", "",
             "Whether terms are evaluated on the signals as the differentiator smooths them."},
            smooth_states);
  }
};

/// The strong form: for every sample i of every record
///
///   sum_j h_kj tau_j(t_i, x(t_i), u(t_i)) ~ dx_k/dt(t_i),   k = 1..m.
///
/// dx/dt is the record's own where it brings it (the states are then used as they are), else
/// the differentiator's. The states and inputs in Theta then are the differentiator's order 0:
/// the fit in a window gives signal and derivative of one and the same polynomial, and signals
/// that went through unequal filters would bias the coefficients. Finite differences smooth
/// nothing. Samples at the ends of a record, where the differentiator is one-sided, have no row
/// unless the record is shorter than four such ends. Long records are passed over in pieces.
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
