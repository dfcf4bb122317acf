// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "core/base/check.hpp"
#include "lacuna/regression/linear/least_squares_system.hpp"
#include "regression/linear/triangular.hpp"

namespace lacuna {
namespace {

// Fraction of a unit column in another from which on they are taken to depend on each other.
constexpr double kDependent = 1e-6;

[[noreturn]] void refuse(const std::string& problem, const std::string& remedy) {
  throw ArgumentError("Subproblem", problem, remedy);
}

void check_arguments(const Factor& factor, Index target, const TermSet& active) {
  if (target < 0 || target >= factor.target_norms.size()) {
    refuse("target " + std::to_string(target) + " does not exist", "count targets from 0");
  }
  Index previous = -1;
  for (const Index term : active) {
    if (term < 0 || term >= factor.terms()) {
      refuse("term " + std::to_string(term) + " does not exist", "count terms from 0");
    }
    if (term <= previous) refuse("terms are not in increasing order", "sort them, each once");
    previous = term;
  }
}

// Positions 0..size-1 without some.
TermSet complement(Index size, const TermSet& excluded) {
  TermSet kept;
  auto next = excluded.begin();
  for (Index i = 0; i < size; ++i) {
    if (next != excluded.end() && *next == i) {
      ++next;
    } else {
      kept.push_back(i);
    }
  }
  return kept;
}

// Coefficients that make column `column` of a triangle from the columns `kept`.
Vector fractions_of(const Matrix& triangle, Index column, const TermSet& kept) {
  const TriangularProblem problem =
      retriangularise(triangle(Eigen::all, kept), triangle.col(column), kept);
  return problem.triangle.triangularView<Eigen::Upper>().solve(problem.target);
}

// Squared norms of the rows of R^-1.
Vector inverse_row_squares(const Matrix& triangle) {
  const Matrix identity = Matrix::Identity(triangle.rows(), triangle.cols());
  return triangle.triangularView<Eigen::Upper>().solve(identity).rowwise().squaredNorm();
}

}  // namespace

Subproblem::Subproblem(const Factor& factor, Index target, TermSet active)
    : active_(std::move(active)), target_(target), rows_(factor.rows) {
  check_arguments(factor, target, active_);
  target_norm_ = factor.target_norms[target];
  column_norms_ = factor.column_norms(active_);
  const Index height = factor.terms() + target + 1;
  const Vector column = factor.triangle.col(factor.terms() + target).head(height);
  const Matrix columns = factor.triangle(Eigen::seqN(0, height), active_);
  set_problem(retriangularise(columns, column, active_));
}

void Subproblem::set_problem(TriangularProblem problem) {
  triangle_ = std::move(problem.triangle);
  projected_target_ = std::move(problem.target);
  remainder_ = problem.residual;
}

bool Subproblem::is_rank_deficient() const {
  return lacuna::is_rank_deficient(triangle_, rank_tolerance(size(), rows_));
}

std::pair<TriangularProblem, TermSet> Subproblem::determined_part() const {
  TriangularProblem problem{triangle_, projected_target_, remainder_};
  TermSet dependent;
  if (is_rank_deficient()) {
    dependent = remove_dependent_columns(problem, rank_tolerance(size(), rows_));
  }
  return {std::move(problem), complement(size(), dependent)};
}

Vector Subproblem::solve() const {
  if (!is_rank_deficient()) {
    const Vector scaled = triangle_.triangularView<Eigen::Upper>().solve(projected_target_);
    return scaled.cwiseQuotient(column_norms_);
  }
  const auto [problem, kept] = determined_part();
  const Vector scaled = problem.triangle.triangularView<Eigen::Upper>().solve(problem.target);
  Vector coefficients = Vector::Zero(size());
  coefficients(kept) = scaled.cwiseQuotient(column_norms_(kept));
  return coefficients;
}

Vector Subproblem::solve_normal(const Vector& gradient) const {
  check_argument(gradient.size() == size(), "Subproblem::solve_normal",
                 "the gradient has not one entry per active term");
  const auto [problem, kept] = determined_part();
  const auto upper = problem.triangle.triangularView<Eigen::Upper>();
  const Vector norms = column_norms_(kept);
  const Vector scaled_gradient = gradient(kept).cwiseQuotient(norms);
  const Vector scaled = upper.solve(upper.transpose().solve(scaled_gradient));
  Vector change = Vector::Zero(size());
  change(kept) = scaled.cwiseQuotient(norms);
  return change;
}

double Subproblem::residual_norm() const {
  return is_rank_deficient() ? determined_part().first.residual : remainder_;
}

double Subproblem::residual_norm(const Vector& h) const {
  check_argument(h.size() == size(), "Subproblem::residual_norm",
                 "there is not one coefficient per active term");
  const Vector scaled = h.cwiseProduct(column_norms_);
  const Vector fitted = triangle_.triangularView<Eigen::Upper>() * scaled;
  return std::hypot(remainder_, (projected_target_ - fitted).norm());
}

void Subproblem::remove(Index position) {
  if (position < 0 || position >= size()) {
    refuse("there is no term at position " + std::to_string(position),
           "positions are those of active()");
  }
  TriangularProblem problem{std::move(triangle_), std::move(projected_target_), remainder_};
  remove_column(problem, position);
  active_.erase(active_.begin() + position);
  const Index after = size() - position;
  column_norms_.segment(position, after) = column_norms_.tail(after).eval();
  column_norms_.conservativeResize(size());
  set_problem(std::move(problem));
}

Subproblem Subproblem::renumbered(Index target, TermSet active) const {
  check_argument(static_cast<Index>(active.size()) == size(), "Subproblem::renumbered",
                 "there is not one number per active term");
  Subproblem result = *this;
  result.target_ = target;
  result.active_ = std::move(active);
  return result;
}

double Subproblem::condition() const { return condition_estimate(triangle_); }

Vector Subproblem::inverse_gram_diagonal() const {
  const double infinity = std::numeric_limits<double>::infinity();
  const auto [problem, kept] = determined_part();
  Vector diagonal = Vector::Constant(size(), infinity);
  diagonal(kept) =
      inverse_row_squares(problem.triangle).cwiseQuotient(column_norms_(kept).cwiseAbs2());
  for (const Index column : complement(size(), kept)) {
    const Vector fractions = fractions_of(triangle_, column, kept);
    for (std::size_t j = 0; j < kept.size(); ++j) {
      if (std::abs(fractions[static_cast<Index>(j)]) > kDependent) diagonal[kept[j]] = infinity;
    }
  }
  return diagonal;
}

}  // namespace lacuna
