// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/base/options.hpp"
#include "lacuna/model/equations/term.hpp"

namespace lacuna {

/// Plug point: makes the candidate terms for given variables. It knows no data.
class Basis : public StageInterface {
 public:
  static constexpr std::string_view kKind = "basis";

  /// The candidate terms, distinct, in the order in which they are tried.
  /// @throws ConfigError when an option names an unknown variable or when no term is left.
  TermLibrary library(const Variables& variables) const;

 private:
  virtual std::vector<Term> do_terms(const Variables& variables) const = 0;
};

}  // namespace lacuna
