// SPDX-License-Identifier: MIT
#include "trajectories/sensitivities/library_rates.hpp"

#include <utility>

namespace lacuna {

LibraryRates::LibraryRates(const TermLibrary& library, Choice choice, bool delayed)
    : choice_(std::move(choice)), program_(compile(library, delayed)) {}

/// Delayed variables have their slots in the order in which outputs name them: where there are
/// any, all terms come first, so that slots are those of the whole library.
Program LibraryRates::compile(const TermLibrary& library, bool delayed) {
  ExpressionList outputs;
  if (delayed)
    for (const Term& term : library.terms) outputs.append(term.expression());
  first_ = static_cast<Index>(outputs.list().size());
  const auto term = [&](Index l) {
    return library.terms[static_cast<std::size_t>(l)].expression();
  };
  for (const Index l : choice_.terms) outputs.append(term(l));
  const auto states = static_cast<Index>(library.variables.states.size());
  RateForm form(library.variables.states.size());
  for (Index k = 0; k < states; ++k)
    for (const Index l : choice_.moving)
      form[static_cast<std::size_t>(k)].push_back({term(l), 0.0, k + states * l});
  for (Index j = 0; j < states; ++j)
    add_derivatives(form, library.variables.states[static_cast<std::size_t>(j)], j, outputs,
                    jacobian_);
  return Program(outputs.list(), library.variables);
}

void LibraryRates::evaluate(const Eigen::Ref<const Matrix>& slots) {
  values_.resize(slots.rows(), program_.outputs());
  program_.evaluate(slots, values_, workspace_);
  theta_ = values_.middleCols(first_, static_cast<Index>(choice_.terms.size())).transpose();
}

void LibraryRates::jacobians(const Matrix& coefficients, Matrix& jacobians) {
  const Index m = coefficients.rows();
  jacobian_.sums.set(coefficients.reshaped());
  entries_.resize(values_.rows(), jacobian_.sums.size());
  jacobian_.sums.apply(values_, entries_);
  jacobians.resize(m * m, values_.rows());
  jacobians.setZero();
  for (std::size_t i = 0; i < jacobian_.places.size(); ++i)
    jacobians.row(jacobian_.places[i].row + m * jacobian_.places[i].column) =
        entries_.col(static_cast<Index>(i)).transpose();
}

}  // namespace lacuna
