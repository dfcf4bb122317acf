// SPDX-License-Identifier: MIT
#include "lacuna/shooting/score_system.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "lacuna/core/error.hpp"
#include "shooting_fit.hpp"

namespace lacuna {
namespace {

/// Part of a column beyond the parameters that is not rounding.
constexpr double kRounding = 1e-10;

using TermNames = std::set<std::pair<Index, std::string>>;

TermNames free_terms(const ParametrisedModel& model) {
  TermNames names;
  for (const FreeCoefficient& c : model.coefficients())
    names.insert({c.equation, model.symbolic()
                                  .equations()[static_cast<std::size_t>(c.equation)]
                                              [static_cast<std::size_t>(c.summand)]
                                  .term.name()});
  return names;
}

void check_candidates(const ParametrisedModel& model,
                      const std::vector<CandidateTerm>& candidates) {
  TermNames names = free_terms(model);
  for (const CandidateTerm& candidate : candidates) {
    if (candidate.equation < 0 || candidate.equation >= model.symbolic().dimension())
      throw ArgumentError("ScoreSystem",
                          "there is no equation " + std::to_string(candidate.equation),
                          "count equations from 0");
    if (!names.insert({candidate.equation, candidate.term.name()}).second)
      throw ArgumentError("ScoreSystem",
                          "'" + candidate.term.name() + "' stands twice in equation " +
                              std::to_string(candidate.equation),
                          "leave out terms that the model has");
  }
}

/// @throws ArgumentError as check_candidates().
std::vector<std::string> column_names(const ParametrisedModel& model,
                                      const std::vector<CandidateTerm>& candidates) {
  check_candidates(model, candidates);
  std::vector<std::string> names = model.names();
  for (const CandidateTerm& candidate : candidates)
    names.push_back(
        model.symbolic().states()[static_cast<std::size_t>(candidate.equation)].name + ": " +
        candidate.term.name());
  return names;
}

std::vector<CandidateColumn> columns_of(const std::vector<CandidateTerm>& candidates) {
  std::vector<CandidateColumn> columns;
  for (const CandidateTerm& candidate : candidates)
    columns.push_back({candidate.equation, candidate.term.expression()});
  return columns;
}

/// R of [columns | change | absolute] as a factor with columns of unit norm.
Factor scaled_factor(const Matrix& reduced, const Vector& parameters, Index rows) {
  const Index terms = reduced.cols() - 1;
  Factor factor;
  factor.triangle = Matrix::Zero(terms + 2, terms + 2);
  factor.triangle.topLeftCorner(terms + 1, terms + 1) = reduced;
  factor.triangle.col(terms + 1).head(terms + 1) =
      reduced.col(terms) + reduced.leftCols(parameters.size()) * parameters;
  factor.column_norms = factor.triangle.leftCols(terms).colwise().norm();
  factor.target_norms = factor.triangle.rightCols(2).colwise().norm();
  for (Index j = 0; j < terms; ++j)
    if (factor.column_norms[j] > 0.0) factor.triangle.col(j) /= factor.column_norms[j];
  factor.rows = rows;
  factor.folding = Folding::Orthogonal;
  return factor;
}

}  // namespace

ScoreSystem::ScoreSystem(const Refinement& model, const Dataset& record,
                         const std::vector<CandidateTerm>& candidates,
                         const RefineOptions& options)
    : names_(column_names(model.model, candidates)), parameters_(model.model.size()) {
  ShootingProblem problem(model.model, record, options.huber, columns_of(candidates));
  problem.set_sigma(model.sigma);
  ShootingPoint point{model.model.values(), starts_of(model.windows, model.states)};
  problem.set_scheme(accurate_scheme(problem, model.windows, point, model.sigma));
  problem.evaluate(model.windows, point);
  const ShootingLinearisation linear = problem.linearise(model.windows, point);
  const auto initial = static_cast<Index>(model.windows.size()) * model.states.cols();
  factor_ = scaled_factor(linear.reduced, point.parameters,
                          std::max<Index>(1, problem.record().values.size() - initial));
}

std::vector<CandidateScore> ScoreSystem::scores() const {
  const Index p = parameters_, c = candidates();
  const Vector residual = factor_.triangle.col(p + c).segment(p, c);
  std::vector<CandidateScore> scores;
  for (Index j = 0; j < c; ++j) {
    const Vector column = factor_.triangle.col(p + j).segment(p, c);
    const double size = column.norm(), unit = factor_.column_norms[p + j];
    if (!(size > kRounding) || !(unit > 0.0)) {
      scores.push_back({0.0, std::numeric_limits<double>::infinity(), 0.0});
      continue;
    }
    const double share = column.dot(residual) / size;
    scores.push_back({share / (size * unit), 1.0 / (size * unit), share * share});
  }
  return scores;
}

std::vector<CandidateTerm> candidates_from(const TermLibrary& library,
                                           const ParametrisedModel& model,
                                           const std::vector<bool>& exact) {
  const TermNames present = free_terms(model);
  std::vector<CandidateTerm> candidates;
  for (Index k = 0; k < model.symbolic().dimension(); ++k) {
    if (static_cast<std::size_t>(k) < exact.size() && exact[static_cast<std::size_t>(k)])
      continue;
    for (const Term& term : library.terms)
      if (!present.contains({k, term.name()})) candidates.push_back({k, term});
  }
  return candidates;
}

}  // namespace lacuna
