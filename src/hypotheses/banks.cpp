// SPDX-License-Identifier: MIT
#include "hypotheses/banks.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "lacuna/core/text.hpp"
#include "lacuna/candidates/candidate_column.hpp"

namespace lacuna {
namespace {

/// Splines of few and of many pieces; what lies between is found by the one above it.
constexpr int kFewPieces = 8, kManyPieces = 24, kSurfacePieces = 10;
constexpr int kLags = 24, kStretches = 16, kHarmonics = 24;

Candidate member(Index equation, const std::string& form, const std::string& argument,
                 const std::string& description) {
  Candidate candidate;
  candidate.effect = "stop-gap";
  candidate.form = form;
  candidate.argument = argument;
  candidate.description = description;
  candidate.equation = equation;
  candidate.starts = {Vector(0)};
  return candidate;
}

/// Uniform cubic B-splines over the range of a variable (de Boor, A Practical Guide to Splines,
/// Ch. IX).
std::vector<std::string> splines(const VariableRange& x, int pieces) {
  const double width = (x.high - x.low) / (pieces - 3);
  std::vector<std::string> forms;
  for (int j = 0; width > 0.0 && j < pieces; ++j) {
    const std::string place = "abs((" + x.name + "-(" + format_number(x.low + (j - 1) * width) +
                              "))/" + format_number(width) + ")";
    forms.push_back("(max(2-" + place + ",0)^3-4*max(1-" + place + ",0)^3)/6");
  }
  return forms;
}

Bank curve(const VariableRange& x, int pieces, Index equation) {
  Bank bank{Bank::Kind::Curve, {x.name}, {}};
  for (const std::string& form : splines(x, pieces))
    bank.members.push_back(member(equation, form, x.name, "spline of " + x.name));
  return bank;
}

/// What comes again with the angle: teeth, slots, poles.
Bank harmonics(const VariableRange& angle, Index equation) {
  Bank bank{Bank::Kind::Curve, {angle.name}, {}};
  for (int order = 1; order <= kHarmonics; ++order)
    for (const char* wave : {"sin", "cos"})
      bank.members.push_back(member(
          equation, std::string(wave) + "(" + std::to_string(order) + "*" + angle.name + ")",
          angle.name, "harmonic of " + angle.name));
  return bank;
}

Bank surface(const VariableRange& x, const VariableRange& y, int pieces, Index equation) {
  Bank bank{Bank::Kind::Surface, {x.name, y.name}, {}};
  for (const std::string& first : splines(x, pieces))
    for (const std::string& second : splines(y, pieces))
      bank.members.push_back(member(equation, "(" + first + ")*(" + second + ")",
                                    x.name + "," + y.name,
                                    "spline of " + x.name + " and " + y.name));
  return bank;
}

Bank varying(const Scope& scope, const VariableRange& x, Index equation) {
  Bank bank{Bank::Kind::Varying, {x.name, "t"}, {}};
  const double length = scope.duration / kStretches;
  for (int j = 0; j < kStretches; ++j) {
    const double begin = scope.start + j * length;
    bank.members.push_back(member(equation,
                                  x.name + "*(step(t-(" + format_number(begin) + "))-step(t-(" +
                                      format_number(begin + length) + ")))",
                                  x.name, "coefficient of " + x.name + " that varies"));
  }
  return bank;
}

Bank earlier(const Scope& scope, const VariableRange& x, Index equation) {
  Bank bank{Bank::Kind::Memory, {x.name}, {}};
  const double spacing = std::max(0.5 * x.timescale, scope.step);
  for (int lag = 1; lag <= kLags && lag * spacing < 0.25 * scope.duration; ++lag)
    bank.members.push_back(member(equation,
                                  "delay(" + x.name + "," + format_number(lag * spacing) + ")",
                                  x.name, "earlier values of " + x.name));
  return bank;
}

Bank lines(const Scope& scope, Index equation) {
  Bank bank{Bank::Kind::Lines, {"t"}, {}};
  for (const SpectralLine& line : scope.lines) {
    if (line.equation != equation) continue;
    const std::string angle = "(2*pi*" + format_number(line.frequency) + "*t)";
    bank.members.push_back(member(equation, "sin" + angle, "t", "tone"));
    bank.members.push_back(member(equation, "cos" + angle, "t", "tone"));
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
