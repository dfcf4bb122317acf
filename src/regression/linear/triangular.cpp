// SPDX-License-Identifier: MIT
#include "regression/linear/triangular.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/base/check.hpp"

namespace lacuna {
namespace {

struct Rotation {
  double cosine = 1.0;
  double sine = 0.0;

  void apply(double& upper, double& lower) const {
    const double mixed = cosine * upper + sine * lower;
    lower = cosine * lower - sine * upper;
    upper = mixed;
  }
};

// The rotation that makes the lower of two entries zero.
Rotation rotation_for(double upper, double lower) {
  const double length = std::sqrt(upper * upper + lower * lower);
  return length > 0.0 ? Rotation{upper / length, lower / length} : Rotation{};
}

// Zeroes column j below row j (down to its height) and applies the reflection to what follows.
void reflect_column(Matrix& columns, Vector& target, Index j, Index height) {
  const Index tail = height - j;
  if (tail == 0) return;
  const double below = columns.col(j).segment(j + 1, tail).squaredNorm();
  if (below == 0.0) return;
  const double pivot = columns(j, j);
  const double length = std::sqrt(pivot * pivot + below);
  const double image = pivot > 0.0 ? -length : length;
  columns(j, j) = pivot - image;
  const auto direction = columns.col(j).segment(j, tail + 1);
  const double scale = -image * (pivot - image);
  for (Index k = j + 1; k < columns.cols(); ++k) {
    auto column = columns.col(k).segment(j, tail + 1);
    column -= (direction.dot(column) / scale) * direction;
  }
  auto entries = target.segment(j, tail + 1);
  entries -= (direction.dot(entries) / scale) * direction;
  columns(j, j) = image;
}

void check_heights(const TermSet& heights, Index rows, Index columns) {
  bool rise = static_cast<Index>(heights.size()) == columns;
  Index last = -1;
  for (const Index height : heights) {
    rise = rise && height > last && height < rows;
    last = height;
  }
  check_argument(rise, "retriangularise",
                 "the heights do not increase below the number of rows",
                 "give one for each column");
}

double largest_diagonal(const Matrix& triangle) {
  return triangle.size() == 0 ? 0.0 : triangle.diagonal().cwiseAbs().maxCoeff();
}

}  // namespace

TriangularProblem retriangularise(Matrix columns, Vector target, const TermSet& heights) {
  const Index size = columns.cols();
  check_heights(heights, columns.rows(), size);
  check_argument(target.size() == columns.rows(), "retriangularise",
                 "the target has not as many rows as the columns");
  for (Index j = 0; j < size; ++j) {
    reflect_column(columns, target, j, heights[static_cast<std::size_t>(j)]);
  }
  return {columns.topRows(size).triangularView<Eigen::Upper>(), target.head(size),
          target.tail(target.size() - size).norm()};
}

void remove_column(TriangularProblem& problem, Index position) {
  Matrix& r = problem.triangle;
  const Index size = r.cols();
  check_argument(r.rows() == size && problem.target.size() == size, "remove_column",
                 "triangle and target have different sizes");
  check_number(position, size, "remove_column", "column");
  std::vector<Rotation> rotations(static_cast<std::size_t>(size));
  for (Index j = position + 1; j < size; ++j) {
    double* column = r.col(j).data();
    for (Index i = position; i + 1 < j; ++i) {
      rotations[static_cast<std::size_t>(i)].apply(column[i], column[i + 1]);
    }
    Rotation& last = rotations[static_cast<std::size_t>(j - 1)];
    last = rotation_for(column[j - 1], column[j]);
    last.apply(column[j - 1], column[j]);
    last.apply(problem.target[j - 1], problem.target[j]);
    r.col(j - 1).head(j) = r.col(j).head(j);
    r.col(j - 1).tail(size - j).setZero();
  }
  problem.residual = std::hypot(problem.residual, problem.target[size - 1]);
  r.conservativeResize(size - 1, size - 1);
  problem.target.conservativeResize(size - 1);
}

double rank_tolerance(Index columns, Index rows) {
  check_argument(columns >= 0 && rows >= 0, "rank_tolerance", "a number of rows is negative");
  const double growth = static_cast<double>(columns) + std::sqrt(static_cast<double>(rows));
  return 8.0 * std::numeric_limits<double>::epsilon() * growth;
}

bool is_rank_deficient(const Matrix& triangle, double tolerance) {
  if (triangle.size() == 0) return false;
  const double smallest = triangle.diagonal().cwiseAbs().minCoeff();
  return smallest <= tolerance * largest_diagonal(triangle);
}

TermSet remove_dependent_columns(TriangularProblem& problem, double tolerance) {
  TermSet removed;
  const double threshold = tolerance * largest_diagonal(problem.triangle);
  for (Index i = 0; i < problem.triangle.cols();) {
    if (std::abs(problem.triangle(i, i)) > threshold) {
      ++i;
      continue;
    }
    remove_column(problem, i);
    removed.push_back(i + static_cast<Index>(removed.size()));
  }
  return removed;
}

double inverse_norm_estimate(const Matrix& triangle) {
  check_argument(triangle.rows() == triangle.cols(), "inverse_norm_estimate",
                 "the triangle is not square");
  if (triangle.size() == 0) return 0.0;
  if ((triangle.diagonal().array() == 0.0).any())
    return std::numeric_limits<double>::infinity();
  // Higham (1988): the estimate is mostly exact after two.
  constexpr int kMaxSteps = 5;
  const auto upper = triangle.triangularView<Eigen::Upper>();
  Vector x = Vector::Constant(triangle.cols(), 1.0 / static_cast<double>(triangle.cols()));
  double estimate = 0.0;
  for (int step = 0; step < kMaxSteps; ++step) {
    const Vector y = upper.solve(x);
    estimate = std::max(estimate, y.lpNorm<1>());
    const Vector signs = y.unaryExpr([](double v) { return v < 0.0 ? -1.0 : 1.0; });
    const Vector z = upper.transpose().solve(signs);
    Index largest = 0;
    const double slope = z.cwiseAbs().maxCoeff(&largest);
    if (!(slope > z.dot(x))) break;
    x.setZero();
    x[largest] = 1.0;
  }
  return estimate;
}

double condition_estimate(const Matrix& triangle) {
  const double inverse = inverse_norm_estimate(triangle);
  if (triangle.size() == 0) return 1.0;
  if (std::isinf(inverse)) return inverse;
  return triangle.cwiseAbs().colwise().sum().maxCoeff() * inverse;
}

}  // namespace lacuna
