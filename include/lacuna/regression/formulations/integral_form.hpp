// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/options.hpp"
#include "lacuna/regression/stages/formulation.hpp"

namespace lacuna {

/// Options of IntegralForm.
struct IntegralFormOptions {
  static constexpr StageInfo kInfo{"integral",
                                   "Rows are intervals, the target is the change of the state",
                                   "Schaeffer & McCalla, Phys. Rev. E 96 (2017) 023302"};

  int span = 10;

  void describe(OptionVisitor& v) {
    v.field({"span", "samples", "Length of an interval.", 1, 100000}, span);
  }
};

/// The integral form: for overlapping intervals of `span` samples
///
///   sum_j h_kj int_a^b tau_j(t, x, u) dt ~ x_k(b) - x_k(a),   k = 1..m,
///
/// whitened like the weak form. Intervals start every half span.
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
