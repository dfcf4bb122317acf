// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lacuna/model/expressions/expression.hpp"
#include "lacuna/model/expressions/program.hpp"

namespace lacuna {

/// A candidate term tau(t, x, u): a value with a canonical name.
///
/// A monomial is recognised in whatever way it was written (`y*x*x`, `x^2*y`) and gets its name
/// from the order of the variables: "x^2*y"; "1" is the constant. Other terms keep what was
/// written, in canonical text.
class Term {
 public:
  /// @throws ModelError when the expression uses a name that is not in `variables`.
  Term(const Expression& expression, const Variables& variables);

  /// The same; many terms of the same variables share what finds them.
  Term(const Expression& expression, const VariableIndex& variables);

  /// Reads a term. @throws ModelError naming the column.
  static Term parse(std::string_view text, const Variables& variables);

  /// The monomial with one entry per variable, its exponent, in slot order (time last).
  /// @throws ArgumentError when the number of exponents is not variables.count().
  static Term monomial(const std::vector<int>& exponents, const Variables& variables);

  const std::string& name() const noexcept { return name_; }             ///< "x^2*y"
  const Expression& expression() const noexcept { return expression_; }  ///< its formula

  /// One entry per variable (slot order), its exponent, when the term is a monomial.
  std::optional<std::vector<int>> exponents() const;

  /// The slot of the variable that the term is, where it is one alone.
  std::optional<Index> variable() const noexcept;

  friend bool operator==(const Term& a, const Term& b) { return a.name_ == b.name_; }

 private:
  Expression expression_;
  std::string name_;
  /// Of a monomial: exponents that are not 0, by slot. A model of many states has many terms
  /// of few variables.
  std::optional<std::map<Index, int>> powers_;
  Index slots_ = 0;
};

/// Candidate terms over given variables, in the order in which they are tried.
struct TermLibrary {
  Variables variables;
  std::vector<Term> terms;  ///< L, distinct

  Index size() const noexcept { return static_cast<Index>(terms.size()); }  ///< L
  std::vector<std::string> names() const;                                   ///< of the terms, L

  /// All L terms in one program.
  Program compile() const;
};

}  // namespace lacuna
