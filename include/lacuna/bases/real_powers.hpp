// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/core/base/options.hpp"
#include "lacuna/regression/stages/basis.hpp"

namespace lacuna {

/// Options of RealPowers.
struct RealPowersOptions {
  static constexpr StageInfo kInfo{"real-powers", "Powers of each variable with real exponents",
                                   "M. A. Savageau, J. Theor. Biol. 25 (1969) 365-369"};

  std::vector<std::string> exponents = {"0.5", "1.5"};
  bool signed_powers = true;
  bool with_inputs = false;

  void describe(OptionVisitor& v) {
    v.field({"exponents", "", "Exponents p, any numbers but 0 and 1."}, exponents);
    v.field({"signed_powers", "",
             "Whether a power is sign(v)*abs(v)^p, which all v have, instead of v^p, which only "
             "positive ones have."},
            signed_powers);
    v.field({"with_inputs", "", "Whether inputs are variables too."}, with_inputs);
  }
};

/// For every variable v after 1 and the variables themselves: sign(v) |v|^p or v^p.
class RealPowers final : public Configured<Basis, RealPowersOptions> {
 public:
  using Configured::Configured;

 private:
  /// @throws ConfigError for an exponent that is no number, 0 or 1.
  std::vector<Term> do_terms(const Variables& variables) const override;
};

}  // namespace lacuna
