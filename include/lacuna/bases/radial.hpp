// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/options.hpp"
#include "lacuna/regression/stages/basis.hpp"

namespace lacuna {

/// Options of RadialFunctions.
struct RadialFunctionsOptions {
  static constexpr StageInfo kInfo{"radial", "Gaussians around places on each variable",
                                   "Broomhead & Lowe, Complex Systems 2 (1988) 321-355"};

  int count = 5;
  double low = -1.0, high = 1.0;
  bool with_inputs = false;

  void describe(OptionVisitor& v) {
    v.field({"count", "", "Places on each variable, with equal spacing.", 1.0, 1000.0}, count);
    v.field({"low", "unit of the variables", "The first of them."}, low);
    v.field({"high", "unit of the variables", "The last of them."}, high);
    v.field({"with_inputs", "", "Whether inputs are variables too."}, with_inputs);
  }
};

/// For every variable v after 1 and the variables themselves: exp(-((v - c_i) / d)^2 / 2) for
/// `count` centres c_i from low to high and their spacing d (half the range where there is one
/// centre).
class RadialFunctions final : public Configured<Basis, RadialFunctionsOptions> {
 public:
  using Configured::Configured;

 private:
  /// @throws ConfigError when high is not above low.
  std::vector<Term> do_terms(const Variables& variables) const override;
};

}  // namespace lacuna
