// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/options.hpp"
#include "lacuna/regression/stages/basis.hpp"

namespace lacuna {

/// Options of Fourier.
struct FourierOptions {
  static constexpr StageInfo kInfo{"fourier", "Sines and cosines of multiples of the variables",
                                   ""};

  int harmonics = 2;         ///< highest multiple
  double wave_number = 1.0;  ///< w of the first multiple
  bool with_linear = true;   ///< 1 and the variables themselves come first
  bool with_inputs = false;  ///< inputs are variables too

  void describe(OptionVisitor& v) {
    v.field({"harmonics", "", "Highest multiple K of the wave number.", 1.0, 100.0}, harmonics);
    v.field(
        {"wave_number", "rad per unit of the variable", "Wave number w of the first multiple."},
        wave_number);
    v.field({"with_linear", "", "Whether 1 and the variables themselves are terms."},
            with_linear);
    v.field({"with_inputs", "", "Whether inputs are variables too."}, with_inputs);
  }
};

/// For every variable v: sin(k w v), cos(k w v), k = 1..K, after 1 and the variables
/// themselves.
class Fourier final : public Configured<Basis, FourierOptions> {
 public:
  using Configured::Configured;

 private:
  /// @throws ConfigError when the wave number is 0.
  std::vector<Term> do_terms(const Variables& variables) const override;
};

}  // namespace lacuna
