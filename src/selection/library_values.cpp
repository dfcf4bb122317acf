// SPDX-License-Identifier: MIT
#include "library_values.hpp"

#include <utility>

namespace lacuna {

LibraryValues::LibraryValues(const TermLibrary& library, Choice choice, bool delayed)
    : choice_(std::move(choice)), program_(compile(library, delayed)) {}

/// Delayed variables have their slots in the order in which outputs name them: where there are
/// any, all terms come first, so that slots are those of the whole library.
Program LibraryValues::compile(const TermLibrary& library, bool delayed) {
  std::vector<Expression> outputs;
  if (delayed)
    for (const Term& term : library.terms) outputs.push_back(term.expression());
  first_ = static_cast<Index>(outputs.size());
  for (const Index l : choice_.terms)
    outputs.push_back(library.terms[static_cast<std::size_t>(l)].expression());
  for (const Index l : choice_.moving) {
    const Expression& term = library.terms[static_cast<std::size_t>(l)].expression();
    for (std::size_t j = 0; j < library.variables.states.size(); ++j) {
      Expression partial = differentiate(term, library.variables.states[j]);
      if (partial.operation() == Operation::Number && partial.value() == 0.0) continue;
      partials_.push_back({l, static_cast<Index>(j), static_cast<Index>(outputs.size())});
      outputs.push_back(std::move(partial));
    }
  }
  return Program(outputs, library.variables);
}

void LibraryValues::evaluate(const Eigen::Ref<const Matrix>& slots) {
  values_.resize(slots.rows(), program_.outputs());
  program_.evaluate(slots, values_, workspace_);
  theta_ = values_.middleCols(first_, static_cast<Index>(choice_.terms.size())).transpose();
}

void LibraryValues::jacobians(const Matrix& coefficients, Matrix& jacobians) const {
  const Index m = coefficients.rows();
  jacobians.setZero(m * m, values_.rows());
  for (const Partial& partial : partials_)
    for (Index k = 0; k < m; ++k) {
      const double share = coefficients(k, partial.term);
      if (share == 0.0) continue;
      jacobians.row(k + m * partial.state) += share * values_.col(partial.output).transpose();
    }
}

}  // namespace lacuna
