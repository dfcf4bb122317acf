// SPDX-License-Identifier: MIT
#include "library_values.hpp"

namespace lacuna {

LibraryValues::LibraryValues(const TermLibrary& library)
    : terms_(library.size()),
      dimension_(static_cast<Index>(library.variables.states.size())),
      program_(compile(library, partials_)) {}

Program LibraryValues::compile(const TermLibrary& library, std::vector<Partial>& partials) {
  std::vector<Expression> outputs;
  for (const Term& term : library.terms) outputs.push_back(term.expression());
  for (Index l = 0; l < library.size(); ++l) {
    const Expression& term = library.terms[static_cast<std::size_t>(l)].expression();
    for (std::size_t j = 0; j < library.variables.states.size(); ++j) {
      Expression partial = differentiate(term, library.variables.states[j]);
      if (partial.operation() == Operation::Number && partial.value() == 0.0) continue;
      partials.push_back({l, static_cast<Index>(j), static_cast<Index>(outputs.size())});
      outputs.push_back(std::move(partial));
    }
  }
  return Program(outputs, library.variables);
}

void LibraryValues::evaluate(const Eigen::Ref<const Matrix>& slots) {
  rows_.resize(slots.rows(), program_.outputs());
  program_.evaluate(slots, rows_, workspace_);
  values_ = rows_.transpose();
}

void LibraryValues::jacobian(Index point, const Matrix& coefficients, Matrix& jacobian) const {
  jacobian.setZero(dimension_, dimension_);
  for (const Partial& partial : partials_)
    jacobian.col(partial.state) +=
        coefficients.col(partial.term) * values_(partial.output, point);
}

}  // namespace lacuna
