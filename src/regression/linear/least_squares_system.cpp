// SPDX-License-Identifier: MIT
#include "lacuna/regression/linear/least_squares_system.hpp"

#include <numeric>
#include <string>
#include <utility>

#include "core/base/parts.hpp"
#include "regression/linear/factorise.hpp"
#include "regression/linear/row_pass.hpp"
#include "regression/linear/weighted_rows.hpp"

namespace lacuna {
namespace {

[[noreturn]] void reject(const std::string& problem, const std::string& remedy) {
  throw ArgumentError("LeastSquaresSystem", problem, remedy);
}

void check_names(std::size_t names, Index columns, const std::string& what) {
  if (static_cast<Index>(names) == columns) return;
  throw ArgumentError(
      "LeastSquaresSystem",
      std::to_string(names) + " names for " + std::to_string(columns) + " " + what,
      "give one name per column");
}

// An equation of a system with so many terms and targets.
void check_equation(const FittedEquation& equation, Index terms, Index targets) {
  const auto size = static_cast<Index>(equation.active.size());
  if (equation.coefficients.size() != size) {
    reject(std::to_string(equation.coefficients.size()) + " coefficients for " +
               std::to_string(size) + " active terms",
           "give one coefficient per active term");
  }
  if (equation.target < 0 || equation.target >= targets) {
    reject("target " + std::to_string(equation.target) + " does not exist",
           "count targets from 0");
  }
  for (const Index term : equation.active) {
    if (term >= 0 && term < terms) continue;
    reject("term " + std::to_string(term) + " does not exist", "count terms from 0");
  }
}

std::string column_name(const std::vector<std::string>& terms,
                        const std::vector<std::string>& targets, Index column) {
  const auto number = static_cast<std::size_t>(column);
  return number < terms.size() ? "term '" + terms[number] + "'"
                               : "target '" + targets[number - terms.size()] + "'";
}

// gradient_j += theta_j' r for the active terms.
void add_gradient(const FittedEquation& equation, Tile& tile, Vector& gradient) {
  const auto theta = tile.theta();
  Vector residuals(tile.rows());
  equation_residuals(equation, theta, tile.targets(), residuals);
  for (std::size_t j = 0; j < equation.active.size(); ++j) {
    gradient[static_cast<Index>(j)] += theta.col(equation.active[j]).dot(residuals);
  }
}

}  // namespace

LeastSquaresSystem::LeastSquaresSystem(std::shared_ptr<const RowSource> rows,
                                       std::vector<std::string> term_names,
                                       std::vector<std::string> target_names,
                                       const RunContext& context, Folding folding)
    : source_(std::move(rows)), folding_(folding) {
  check_names(term_names.size(), source_->terms(), "terms");
  check_names(target_names.size(), source_->targets(), "targets");
  const auto name = [&](Index column) { return column_name(term_names, target_names, column); };
  factor_ = std::make_shared<const Factor>(factorise(*source_, folding, name, context));
  term_names_ = std::make_shared<const std::vector<std::string>>(std::move(term_names));
  target_names_ = std::make_shared<const std::vector<std::string>>(std::move(target_names));
}

LeastSquaresSystem LeastSquaresSystem::with_target_error(Vector error) const {
  if (error.size() != targets() || !error.allFinite() || (error.array() < 0.0).any())
    throw ArgumentError("least-squares system", "the systematic errors do not fit the targets",
                        "give one finite number that is not negative per target");
  LeastSquaresSystem system = *this;
  system.target_error_ = std::move(error);
  return system;
}

TermSet LeastSquaresSystem::all_terms() const {
  TermSet all(static_cast<std::size_t>(terms()));
  std::iota(all.begin(), all.end(), Index{0});
  return all;
}

Subproblem LeastSquaresSystem::subproblem(Index target, TermSet active) const {
  return Subproblem(*factor_, target, std::move(active));
}

Subproblem LeastSquaresSystem::reweighted(const Subproblem& problem, const Vector& h,
                                          const WeightFunction& weights,
                                          const RunContext& context) const {
  FittedEquation equation{problem.target(), problem.active(), h};
  check_equation(equation, terms(), targets());
  const auto name = [&](Index column) {
    const bool is_target = column == problem.size();
    const Index all = is_target ? terms() + problem.target()
                                : problem.active()[static_cast<std::size_t>(column)];
    return column_name(*term_names_, *target_names_, all) + " times its weight";
  };
  const auto rows = make_weighted_rows(*source_, std::move(equation), weights);
  const bool orthogonal = factor_->folding == Folding::Orthogonal;
  const Folding folding = orthogonal ? Folding::Orthogonal : folding_;
  const Factor factor = factorise(*rows, folding, name, context);
  TermSet all(problem.active().size());
  std::iota(all.begin(), all.end(), Index{0});
  return Subproblem(factor, 0, std::move(all)).renumbered(problem.target(), problem.active());
}

Vector LeastSquaresSystem::refined(const Subproblem& problem, const Vector& h,
                                   const RunContext& context) const {
  const FittedEquation equation{problem.target(), problem.active(), h};
  check_equation(equation, terms(), targets());
  // The others leave nothing to refine but the last digits of exact targets and what is far
  // below the noise of others, which are not worth a pass over very many rows.
  if (factor_->folding != Folding::Gram && rows() >= kManyRows) return h;
  std::vector<Vector> slots(row_slots(rows()).size(), Vector::Zero(h.size()));
  for_each_tile(*source_, context, "refining coefficients", [&](Index slot, Tile& tile) {
    add_gradient(equation, tile, slots[static_cast<std::size_t>(slot)]);
  });
  exchange_parts(slots.size(), context,
                 [&](std::size_t slot) { return numbers_of(slots[slot]); });
  Vector gradient = Vector::Zero(h.size());
  for (const Vector& slot : slots) gradient += slot;
  return h + problem.solve_normal(gradient);
}

Vector LeastSquaresSystem::residuals(Index target, const TermSet& active, const Vector& h,
                                     const RunContext& context) const {
  const FittedEquation equation{target, active, h};
  check_equation(equation, terms(), targets());
  Vector result(rows());
  for_each_tile(*source_, context, "computing residuals", [&](Index, Tile& tile) {
    equation_residuals(equation, tile.theta(), tile.targets(),
                       result.segment(tile.first(), tile.rows()));
  });
  const std::vector<RowRange> slots = row_slots(rows());
  exchange_parts(slots.size(), context, [&](std::size_t slot) {
    const auto count = static_cast<std::size_t>(slots[slot].count);
    return std::span<double>(result.data() + slots[slot].first, count);
  });
  return result;
}

}  // namespace lacuna
