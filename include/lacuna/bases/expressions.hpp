// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/core/base/options.hpp"
#include "lacuna/regression/stages/basis.hpp"

namespace lacuna {

/// Options of Expressions.
struct ExpressionsOptions {
  static constexpr StageInfo kInfo{"expressions", "The candidate terms that are written out",
                                   ""};

  std::vector<std::string> terms = {};  ///< expressions in states, inputs and t

  void describe(OptionVisitor& v) {
    v.field({"terms", "", "The terms, e.g. sign(v), 1, u, delay(x,0.5)."}, terms);
  }
};

/// The terms that the user writes, in the order given.
class Expressions final : public Configured<Basis, ExpressionsOptions> {
 public:
  using Configured::Configured;

 private:
  /// @throws ModelError naming the entry and the column that cannot be read.
  std::vector<Term> do_terms(const Variables& variables) const override;
};

}  // namespace lacuna
