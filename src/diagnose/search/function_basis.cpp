// SPDX-License-Identifier: MIT
#include "function_basis.hpp"

#include <algorithm>

#include "core/base/text.hpp"
#include "core/numerics/qr.hpp"
#include "core/statistics/information.hpp"
#include "diagnose/candidates/candidate_column.hpp"
#include "forms/candidate/tone.hpp"
#include "trajectories/smoother/value_periods.hpp"

namespace lacuna {
namespace {

/// Splines of few and of many pieces; what lies between is found by the one above it.
constexpr int kFewPieces = 8, kManyPieces = 24, kSurfacePieces = 10;
constexpr int kLags = 24, kStretches = 16, kHarmonics = 8;

Expression variable(const VariableRange& x) { return Expression::variable(x.name); }

Expression number(double value) { return Expression::number(value); }

Candidate member(Index equation, const Expression& form, const Expression& argument) {
  Candidate candidate;
  candidate.form = form;
  candidate.argument = argument;
  candidate.equation = equation;
  candidate.starts = {Vector(0)};
  return candidate;
}

/// Uniform cubic B-splines over the range of a variable (de Boor, A Practical Guide to Splines,
/// Ch. IX).
std::vector<Expression> splines(const VariableRange& x, int pieces) {
  static const Expression place = parse_expression("abs((x-middle)/width)");
  static const Expression spline = parse_expression("(max(2-place,0)^3-4*max(1-place,0)^3)/6");
  const double width = (x.high - x.low) / (pieces - 3);
  std::vector<Expression> forms;
  for (int j = 0; width > 0.0 && j < pieces; ++j) {
    const Expression middle = number(x.low + (j - 1) * width);
    const Expression away =
        substitute(place, {{"x", variable(x)}, {"middle", middle}, {"width", number(width)}});
    forms.push_back(substitute(spline, {{"place", away}}));
  }
  return forms;
}

FunctionBasis curve(const VariableRange& x, int pieces, Index equation) {
  FunctionBasis basis{FunctionBasis::Kind::Curve, {x.name}, {}};
  for (const Expression& form : splines(x, pieces))
    basis.members.push_back(member(equation, form, variable(x)));
  return basis;
}

/// What comes again with the value of a variable, teeth, slots, poles: the best period and its
/// harmonics, as far as they are resolved.
FunctionBasis harmonics(const VariableRange& x, const ValuePeriod& period, Index equation) {
  static const Expression angle = parse_expression("2*pi*order*x/period");
  FunctionBasis basis{FunctionBasis::Kind::Curve, {x.name}, {}};
  basis.tried = static_cast<double>(period.tried);
  for (int order = 1; order <= kHarmonics && period.longest >= order * period.shortest; ++order)
    for (const Operation wave : {Operation::Sin, Operation::Cos}) {
      const Expression phase = substitute(
          angle,
          {{"order", number(order)}, {"x", variable(x)}, {"period", number(period.longest)}});
      basis.members.push_back(member(equation, Expression::make(wave, {phase}), variable(x)));
    }
  return basis;
}

FunctionBasis surface(const VariableRange& x, const VariableRange& y, int pieces,
                      Index equation) {
  FunctionBasis basis{FunctionBasis::Kind::Surface, {x.name, y.name}, {}};
  for (const Expression& first : splines(x, pieces))
    for (const Expression& second : splines(y, pieces))
      basis.members.push_back(member(equation, first * second, variable(x) * variable(y)));
  return basis;
}

FunctionBasis varying(const Scope& scope, const VariableRange& x, Index equation) {
  static const Expression stretch = parse_expression("x*(step(t-begin)-step(t-end))");
  FunctionBasis basis{FunctionBasis::Kind::Varying, {x.name, "t"}, {}};
  const double length = scope.duration / kStretches;
  for (int j = 0; j < kStretches; ++j) {
    const double begin = scope.start + j * length;
    const Expression form = substitute(
        stretch,
        {{"x", variable(x)}, {"begin", number(begin)}, {"end", number(begin + length)}});
    basis.members.push_back(member(equation, form, variable(x)));
  }
  return basis;
}

FunctionBasis earlier(const Scope& scope, const VariableRange& x, Index equation) {
  FunctionBasis basis{FunctionBasis::Kind::Memory, {x.name}, {}};
  const double spacing = std::max(0.5 * x.timescale, scope.step);
  for (int lag = 1; lag <= kLags && lag * spacing < 0.25 * scope.duration; ++lag)
    basis.members.push_back(
        member(equation, Expression::delayed(x.name, lag * spacing), variable(x)));
  return basis;
}

FunctionBasis lines(const Scope& scope, Index equation) {
  static const Expression angle = parse_expression("2*pi*frequency*t");
  FunctionBasis basis{FunctionBasis::Kind::Lines, {"t"}, {}};
  for (const SpectralLine& line : scope.lines) {
    if (line.equation != equation || !is_tone(line, scope)) continue;
    for (const Operation wave : {Operation::Sin, Operation::Cos})
      basis.members.push_back(member(
          equation,
          Expression::make(wave, {substitute(angle, {{"frequency", number(line.frequency)}})}),
          Expression::variable("t")));
  }
  return basis;
}

}  // namespace

std::vector<FunctionBasis> curves_of(const VariableRange& x, Index equation) {
  return {curve(x, kFewPieces, equation), curve(x, kManyPieces, equation)};
}

std::vector<FunctionBasis> present_functions(const Assimilation& fit, const Scope& scope,
                                             Index equation) {
  std::vector<FunctionBasis> bases;
  for (std::size_t i = 0; i < scope.variables.size(); ++i) {
    const VariableRange& x = scope.variables[i];
    for (FunctionBasis& basis : curves_of(x, equation)) bases.push_back(std::move(basis));
    bases.push_back(varying(scope, x, equation));
    if (const auto period = best_period(fit, equation, static_cast<Index>(i)))
      bases.push_back(harmonics(x, *period, equation));
    for (std::size_t j = 0; j < i; ++j) {
      bases.push_back(surface(scope.variables[j], x, kFewPieces, equation));
      bases.push_back(surface(scope.variables[j], x, kSurfacePieces, equation));
    }
  }
  return bases;
}

std::vector<FunctionBasis> other_functions(const Scope& scope, Index equation) {
  std::vector<FunctionBasis> bases{lines(scope, equation)};
  for (const VariableRange& x : scope.variables) bases.push_back(earlier(scope, x, equation));
  return bases;
}

FunctionScreening::FunctionScreening(const Assimilation& assimilation)
    : assimilation_(assimilation),
      system_(assimilation),
      fitted_(orthonormal_basis(system_.fitted_columns())) {
  const Vector& all = system_.innovations();
  left_ = all - fitted_ * (fitted_.transpose() * all);
}

std::vector<FittedEffect> ScoredFunction::members() const {
  std::vector<FittedEffect> effects;
  for (const std::size_t place : score.members)
    effects.push_back({basis.members[place], Vector(0), 0.0, 0.0});
  return effects;
}

std::optional<ScoredFunction> FunctionScreening::best_of(std::vector<FunctionBasis> bases,
                                                         const Criterion& criterion) const {
  std::optional<ScoredFunction> best;
  for (FunctionBasis& basis : bases) {
    FunctionScore found = score(basis);
    const double net =
        found.gain -
        criterion.penalty({0.0, static_cast<double>(found.members.size()),
                           static_cast<double>(system_.used()), choice_penalty(basis.tried)});
    if (!found.members.empty() && (!best || net > best->net))
      best = ScoredFunction{std::move(basis), std::move(found), net};
  }
  return best;
}

FunctionScreening::Columns FunctionScreening::columns_of(const FunctionBasis& basis) const {
  std::vector<std::size_t> places;
  Matrix columns(system_.rows(), static_cast<Index>(basis.members.size()));
  for (std::size_t j = 0; j < basis.members.size(); ++j) {
    const auto column = candidate_column(basis.members[j], {}, assimilation_, system_);
    if (!column || !(column->squaredNorm() > 0.0)) continue;
    columns.col(static_cast<Index>(places.size())) = column->normalized();
    places.push_back(j);
  }
  columns.conservativeResize(Eigen::NoChange, static_cast<Index>(places.size()));
  if (!places.empty()) columns -= fitted_ * (fitted_.transpose() * columns);
  return {std::move(columns), std::move(places)};
}

FunctionScore FunctionScreening::score(const FunctionBasis& basis) const {
  // Below this fraction of its length a column is made of the others, up to what noise would
  // show.
  constexpr double kIndependent = 1e-3;
  const auto [columns, places] = columns_of(basis);
  if (places.empty()) return {};
  const PivotedQr factor(columns);
  const Vector inner = factor.transposed_times(left_), pivots = factor.pivots();
  const std::vector<Index> order = factor.order();
  FunctionScore result;
  for (Index j = 0; j < pivots.size() && pivots[j] >= kIndependent; ++j) {
    result.gain += inner[j] * inner[j];
    result.members.push_back(
        places[static_cast<std::size_t>(order[static_cast<std::size_t>(j)])]);
  }
  std::sort(result.members.begin(), result.members.end());
  return result;
}

double FunctionScreening::smaller_half(const FunctionBasis& basis) const {
  const auto [columns, places] = columns_of(basis);
  if (places.empty()) return 0.0;
  const Matrix orthonormal = PivotedQr(columns).basis();
  const Vector rest = left_ - orthonormal * (orthonormal.transpose() * left_);
  const Vector gains = left_.cwiseAbs2() - rest.cwiseAbs2();
  const double whole = gains.sum(), first = gains.head(gains.size() / 2).sum();
  return whole > 0.0 ? std::min(first, whole - first) / whole : 0.0;
}

}  // namespace lacuna
