// SPDX-License-Identifier: MIT
#include "identifiability.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/base/text.hpp"
#include "trajectories/smoother/hidden_states.hpp"
#include "trajectories/smoother/unseen_changes.hpp"

namespace lacuna {
namespace {

/// Part of a unit vector that counts: what a hint names, and what has no interval. Estimates do
/// not depend on it.
constexpr double kPart = 0.05;

/// A direction of coefficients that the records do not determine, and the one that is kept for
/// it; none: all of them keep their proportion.
struct Direction {
  Vector parts;
  std::optional<Index> unit;
};

/// The same space by directions with as many zeros as elimination makes, so that each is about
/// few coefficients; first those of the units, in which no other unit has a part.
std::vector<Direction> sparse_directions(Matrix columns, const std::vector<Index>& units) {
  constexpr double kNothing = 1e-6;  // rounding of orthonormal columns after elimination
  std::vector<Direction> result;
  std::vector<bool> done(static_cast<std::size_t>(columns.cols()), false);
  const auto eliminate = [&](Index pivot, Index c) {
    columns.col(c) /= columns(pivot, c);
    for (Index other = 0; other < columns.cols(); ++other)
      if (other != c) columns.col(other) -= (columns(pivot, other) * columns.col(c)).eval();
    done[static_cast<std::size_t>(c)] = true;
  };
  std::vector<std::pair<Index, std::optional<Index>>> order;
  for (const Index unit : units) {
    Index c = -1;
    for (Index other = 0; other < columns.cols(); ++other)
      if (!done[static_cast<std::size_t>(other)] &&
          (c < 0 || std::abs(columns(unit, other)) > std::abs(columns(unit, c))))
        c = other;
    if (c < 0 || !(std::abs(columns(unit, c)) > kNothing)) continue;
    eliminate(unit, c);
    order.emplace_back(c, unit);
  }
  for (Index c = 0; c < columns.cols(); ++c) {
    if (done[static_cast<std::size_t>(c)]) continue;
    Index pivot = 0;
    if (!(columns.col(c).cwiseAbs().maxCoeff(&pivot) > kNothing)) continue;
    eliminate(pivot, c);
    order.emplace_back(c, std::nullopt);
  }
  for (const auto& [c, unit] : order) result.push_back({columns.col(c).normalized(), unit});
  return result;
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
             const Direction& direction) {
  std::vector<std::string> names;
  std::vector<double> parts;
  for (Index j = 0; j < direction.parts.size(); ++j) {
    if (std::abs(direction.parts[j]) < kPart) continue;
    names.push_back(name_of(model, free[static_cast<std::size_t>(j)]));
    parts.push_back(direction.parts[j]);
  }
  const std::string kept =
      direction.unit ? name_of(model, free[static_cast<std::size_t>(*direction.unit)]) +
                           " is kept as the model gives it"
                     : "they keep the proportion that the model gives";
  return {
      HintKind::NotIdentifiable,
      names.size() == 1 ? "the records do not determine the coefficient of " + names.front() +
                              ": it is kept as the model gives it"
                        : "the records determine the coefficients of " + join(names, ", ") +
                              " " + combination(parts) + ": " + kept,
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
  for (const Direction& direction : sparse_directions(fit.held, fit.units))
    hints.push_back(hint_of(nominal, fit.free, direction));
  const std::vector<bool> unseen =
      unseen_changes(nominal, base.records->data, hidden, {base.fit_options.free})
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
