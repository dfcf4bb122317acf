// SPDX-License-Identifier: MIT
#include <set>
#include <string>
#include <vector>

#include "core/numerics/singular_values.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {
namespace {

std::set<std::string> terms_of(const Equation& equation) {
  std::set<std::string> names;
  for (const WeightedTerm& summand : equation) names.insert(summand.term.name());
  return names;
}

std::set<std::string> terms_of(const OdeModel& model) {
  std::set<std::string> names;
  for (const Equation& equation : model.equations()) names.merge(terms_of(equation));
  return names;
}

/// Xi: one row per state, one column per term.
Matrix coefficient_matrix(const OdeModel& model, const std::set<std::string>& terms) {
  Matrix xi(model.dimension(), static_cast<Index>(terms.size()));
  for (Index k = 0; k < xi.rows(); ++k) {
    Index column = 0;
    for (const std::string& term : terms) xi(k, column++) = model.coefficient(k, term);
  }
  return xi;
}

double spectral_norm(const Matrix& matrix) {
  return singular_values(matrix).values[0];
}

}  // namespace

ModelAccuracy compare_models(const OdeModel& found, const OdeModel& truth) {
  if (found.dimension() != truth.dimension())
    throw ArgumentError("compare_models", "the models have different numbers of states",
                        "compare models of the same system");
  std::set<std::string> terms = terms_of(truth);
  terms.merge(terms_of(found));
  const Matrix expected = coefficient_matrix(truth, terms);
  const Matrix error = coefficient_matrix(found, terms) - expected;

  ModelAccuracy accuracy{true, error.cwiseAbs().maxCoeff() / expected.cwiseAbs().maxCoeff(),
                         spectral_norm(error) / spectral_norm(expected)};
  for (std::size_t k = 0; k < truth.equations().size(); ++k)
    if (terms_of(found.equations()[k]) != terms_of(truth.equations()[k]))
      accuracy.exact_structure = false;
  return accuracy;
}

}  // namespace lacuna
