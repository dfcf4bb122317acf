// SPDX-License-Identifier: MIT
#include "hypotheses/banks.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "lacuna/candidates/candidate_column.hpp"

namespace lacuna {
namespace {

/// Splines of few and of many pieces; what lies between is found by the one above it.
constexpr int kFewPieces = 8, kManyPieces = 24, kSurfacePieces = 10;
constexpr int kLags = 24, kStretches = 16, kHarmonics = 24;

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

Bank curve(const VariableRange& x, int pieces, Index equation) {
  Bank bank{Bank::Kind::Curve, {x.name}, {}};
  for (const Expression& form : splines(x, pieces))
    bank.members.push_back(member(equation, form, variable(x)));
  return bank;
}

/// What comes again with the angle: teeth, slots, poles.
Bank harmonics(const VariableRange& angle, Index equation) {
  Bank bank{Bank::Kind::Curve, {angle.name}, {}};
  for (int order = 1; order <= kHarmonics; ++order)
    for (const Operation wave : {Operation::Sin, Operation::Cos})
      bank.members.push_back(member(equation,
                                    Expression::make(wave, {number(order) * variable(angle)}),
                                    variable(angle)));
  return bank;
}

Bank surface(const VariableRange& x, const VariableRange& y, int pieces, Index equation) {
  Bank bank{Bank::Kind::Surface, {x.name, y.name}, {}};
  for (const Expression& first : splines(x, pieces))
    for (const Expression& second : splines(y, pieces))
      bank.members.push_back(member(equation, first * second, variable(x) * variable(y)));
  return bank;
}

Bank varying(const Scope& scope, const VariableRange& x, Index equation) {
  static const Expression stretch = parse_expression("x*(step(t-begin)-step(t-end))");
  Bank bank{Bank::Kind::Varying, {x.name, "t"}, {}};
  const double length = scope.duration / kStretches;
  for (int j = 0; j < kStretches; ++j) {
    const double begin = scope.start + j * length;
    const Expression form = substitute(
        stretch,
        {{"x", variable(x)}, {"begin", number(begin)}, {"end", number(begin + length)}});
    bank.members.push_back(member(equation, form, variable(x)));
  }
  return bank;
}

Bank earlier(const Scope& scope, const VariableRange& x, Index equation) {
  Bank bank{Bank::Kind::Memory, {x.name}, {}};
  const double spacing = std::max(0.5 * x.timescale, scope.step);
  for (int lag = 1; lag <= kLags && lag * spacing < 0.25 * scope.duration; ++lag)
    bank.members.push_back(
        member(equation, Expression::delayed(x.name, lag * spacing), variable(x)));
  return bank;
}

Bank lines(const Scope& scope, Index equation) {
  static const Expression angle = parse_expression("2*pi*frequency*t");
  Bank bank{Bank::Kind::Lines, {"t"}, {}};
  for (const SpectralLine& line : scope.lines) {
    if (line.equation != equation) continue;
    for (const Operation wave : {Operation::Sin, Operation::Cos})
      bank.members.push_back(member(
          equation,
          Expression::make(wave, {substitute(angle, {{"frequency", number(line.frequency)}})}),
          Expression::variable("t")));
  }
  return bank;
}

Matrix orthonormal(const Matrix& columns) {
  if (columns.cols() == 0) return Matrix(columns.rows(), 0);
  const Vector scale = columns.colwise().norm().cwiseMax(1e-300).cwiseInverse().transpose();
  const Eigen::ColPivHouseholderQR<Matrix> factor(columns * scale.asDiagonal());
  return factor.householderQ() * Matrix::Identity(columns.rows(), factor.rank());
}

}  // namespace

std::vector<Bank> present_banks(const Scope& scope, Index equation) {
  std::vector<Bank> banks;
  for (std::size_t i = 0; i < scope.variables.size(); ++i) {
    const VariableRange& x = scope.variables[i];
    banks.push_back(curve(x, kFewPieces, equation));
    banks.push_back(curve(x, kManyPieces, equation));
    banks.push_back(varying(scope, x, equation));
    if (x.unit == "rad") banks.push_back(harmonics(x, equation));
    for (std::size_t j = 0; j < i; ++j) {
      banks.push_back(surface(scope.variables[j], x, kFewPieces, equation));
      banks.push_back(surface(scope.variables[j], x, kSurfacePieces, equation));
    }
  }
  return banks;
}

std::vector<Bank> other_banks(const Scope& scope, Index equation) {
  std::vector<Bank> banks{lines(scope, equation)};
  for (const VariableRange& x : scope.variables) banks.push_back(earlier(scope, x, equation));
  return banks;
}

BankScreening::BankScreening(const Assimilation& assimilation)
    : assimilation_(assimilation),
      system_(assimilation),
      fitted_(orthonormal(system_.fitted_columns())) {
  const Vector& all = system_.innovations();
  left_ = all - fitted_ * (fitted_.transpose() * all);
}

double BankScreening::log_samples() const {
  return std::log(static_cast<double>(system_.used()));
}

BankScore BankScreening::score(const Bank& bank) const {
  // Below this share of its length a column is made of the others, up to what noise would tell.
  constexpr double kIndependent = 1e-3;
  std::vector<std::size_t> places;
  Matrix columns(system_.rows(), static_cast<Index>(bank.members.size()));
  for (std::size_t j = 0; j < bank.members.size(); ++j) {
    const auto column = candidate_column(bank.members[j], {}, assimilation_, system_);
    if (!column || !(column->squaredNorm() > 0.0)) continue;
    columns.col(static_cast<Index>(places.size())) = column->normalized();
    places.push_back(j);
  }
  columns.conservativeResize(Eigen::NoChange, static_cast<Index>(places.size()));
  if (places.empty()) return {};
  columns -= fitted_ * (fitted_.transpose() * columns);
  Eigen::ColPivHouseholderQR<Matrix> factor(columns.rows(), columns.cols());
  factor.compute(columns);
  BankScore result;
  const Vector inner = factor.householderQ().adjoint() * left_;
  for (Index j = 0; j < std::min(columns.cols(), columns.rows()); ++j) {
    if (std::abs(factor.matrixR()(j, j)) < kIndependent) break;
    result.gain += inner[j] * inner[j];
    const auto column = static_cast<std::size_t>(factor.colsPermutation().indices()[j]);
    result.members.push_back(places[column]);
  }
  std::sort(result.members.begin(), result.members.end());
  return result;
}

}  // namespace lacuna
