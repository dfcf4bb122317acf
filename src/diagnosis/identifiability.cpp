// SPDX-License-Identifier: MIT
#include "identifiability.hpp"

#include <algorithm>
#include <cmath>

#include "lacuna/core/text.hpp"
#include "lacuna/estimation/hidden_states.hpp"
#include "lacuna/estimation/unseen_changes.hpp"

namespace lacuna {
namespace {

/// Part of a unit vector that counts: what a hint names, and what has no interval. Estimates do
/// not depend on it.
constexpr double kPart = 0.05;

/// The same space by columns with as many zeros as elimination makes: each tells of few
/// coefficients.
Matrix sparse_columns(Matrix columns) {
  std::vector<Index> taken;
  for (Index c = 0; c < columns.cols(); ++c) {
    Index pivot = 0;
    double largest = 0.0;
    for (Index j = 0; j < columns.rows(); ++j)
      if (std::abs(columns(j, c)) > largest &&
          std::find(taken.begin(), taken.end(), j) == taken.end()) {
        pivot = j;
        largest = std::abs(columns(j, c));
      }
    if (!(largest > 1e-6)) continue;
    taken.push_back(pivot);
    columns.col(c) /= columns(pivot, c);
    for (Index other = 0; other < columns.cols(); ++other)
      if (other != c) columns.col(other) -= (columns(pivot, other) * columns.col(c)).eval();
  }
  columns.colwise().normalize();
  return columns;
}

std::string name_of(const OdeModel& model, const CoefficientPlace& place) {
  const auto k = static_cast<std::size_t>(place.equation);
  return model.equations()[k][static_cast<std::size_t>(place.term)].term.name() + " in d" +
         model.states()[k].name + "/dt";
}

/// "only as their product", where the direction says so.
std::string combination(const std::vector<double>& parts) {
  constexpr double kAlike = 1e-3;
  if (parts.size() != 2) return "only together";
  if (std::abs(parts[0] + parts[1]) < kAlike) return "only as their product";
  if (std::abs(parts[0] - parts[1]) < kAlike) return "only as their ratio";
  return "only together";
}

Hint hint_of(const OdeModel& model, const std::vector<CoefficientPlace>& free,
             const Vector& direction) {
  std::vector<std::string> names;
  std::vector<double> parts;
  for (Index j = 0; j < direction.size(); ++j) {
    if (std::abs(direction[j]) < kPart) continue;
    names.push_back(name_of(model, free[static_cast<std::size_t>(j)]));
    parts.push_back(direction[j]);
  }
  const bool single = names.size() == 1;
  return {
      HintKind::NotIdentifiable,
      single ? "the records do not tell the coefficient of " + names.front() +
                   ": it is kept as the model gives it"
             : "the records tell the coefficients of " + join(names, ", ") + " " +
                   combination(parts) + ": they keep the proportion that the model gives",
      "fix one of them (\"fixed\": true, or --tolerance), or measure a state that is hidden"};
}

}  // namespace

bool is_held(const Assimilation& fit, Index j) {
  return j < fit.held.rows() && fit.held.row(j).norm() > kPart;
}

std::vector<Hint> identifiability_hints(const Problem& problem, const Baseline& base,
                                        const Assimilation& fit) {
  const std::vector<bool>& hidden = base.fit_options.hidden;
  std::vector<Hint> hints;
  if (hidden.empty()) return hints;
  const OdeModel& nominal = problem.nominal;
  const Matrix held = sparse_columns(fit.held);
  for (Index c = 0; c < held.cols(); ++c)
    hints.push_back(hint_of(nominal, fit.free, held.col(c)));
  const std::vector<bool> unseen =
      unseen_changes(nominal, base.records->data, hidden, base.fit_options.free,
                     base.fit_options.priors)
          .unseen_states;
  for (std::size_t k = 0; k < unseen.size(); ++k)
    if (unseen[k])
      hints.push_back({HintKind::NotIdentifiable,
                       "the records do not determine the state " + nominal.states()[k].name +
                           ": what was measured does not depend on it",
                       "measure it, or leave it out of the model"});
  return hints;
}

}  // namespace lacuna
