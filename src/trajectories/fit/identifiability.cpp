// SPDX-License-Identifier: MIT
#include "identifiability.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/text.hpp"
#include "core/numerics/singular_values.hpp"

namespace lacuna {
namespace {

/// Entries of a direction below this fraction of its largest are rounding: what the derivatives
/// of a path by numbers are known to, which are numerical.
constexpr double kNothing = 0.02;

/// Size by which a change of each number is measured: its own, or the error that it would have
/// if all others were known, with the sign of the number: a fraction of it is one of its size.
Vector sizes_of(const DeterminedBy& problem) {
  Vector sizes = problem.values;
  for (Index j = 0; j < sizes.size(); ++j)
    if (const double norm = problem.triangle.col(j).norm(); norm > 0.0)
      sizes[j] = std::copysign(std::max(std::abs(sizes[j]), 1.0 / norm), sizes[j]);
  return sizes;
}

/// Reduced so that each column has a 1 where the others have 0.
Matrix reduced_columns(Matrix basis) {
  std::vector<bool> used(static_cast<std::size_t>(basis.rows()), false);
  for (Index j = 0; j < basis.cols(); ++j) {
    Index pivot = -1;
    for (Index i = 0; i < basis.rows(); ++i)
      if (!used[static_cast<std::size_t>(i)] &&
          (pivot < 0 || std::abs(basis(i, j)) > std::abs(basis(pivot, j))))
        pivot = i;
    used[static_cast<std::size_t>(pivot)] = true;
    basis.col(j) /= basis(pivot, j);
    for (Index other = 0; other < basis.cols(); ++other)
      if (other != j) basis.col(other) -= (basis(pivot, other) * basis.col(j)).eval();
  }
  return basis;
}

std::vector<Index> members_of(const Vector& direction) {
  std::vector<Index> members;
  const double largest = direction.cwiseAbs().maxCoeff();
  for (Index i = 0; i < direction.size(); ++i)
    if (std::abs(direction[i]) > kNothing * largest) members.push_back(i);
  return members;
}

/// Numbers of a direction that would be known to a fifth of their size if all others were.
int strong_members(const Matrix& scaled, const Vector& direction) {
  constexpr double kStrong = 5.0;
  int count = 0;
  for (const Index i : members_of(direction)) count += scaled.col(i).norm() > kStrong ? 1 : 0;
  return count;
}

/// "k1*k4", "k1/k4^2": what stays as it is when a and b change by fractions in the ratio 1 :
/// power.
std::string invariant(const std::string& a, const std::string& b, int power) {
  const std::string first =
      std::abs(power) == 1 ? a : a + "^" + std::to_string(std::abs(power));
  return power > 0 ? b + "/" + first : first + "*" + b;
}

/// A name that can stand in a product.
std::string quoted(const std::string& name) {
  return name.find(' ') == std::string::npos ? name : "(" + name + ")";
}

std::string listed(const std::vector<std::string>& names) {
  std::vector<std::string> all(names.begin(), names.end() - 1);
  return join(all, ", ") + " and " + names.back();
}

}  // namespace

Matrix undetermined_directions(const DeterminedBy& problem) {
  constexpr double kRank = 1e-6;
  const Index g = problem.values.size();
  if (g == 0) return Matrix(0, 0);
  const Matrix scaled = problem.triangle * sizes_of(problem).asDiagonal();
  const SingularValues svd = singular_values(scaled);
  const Vector& singular = svd.values;
  Matrix found(g, 0);
  for (Index i = 0; i < g; ++i) {
    const Vector direction = svd.right.col(i);
    const double strength = i < singular.size() ? singular[i] : 0.0;
    const bool is_null = !(strength > kRank * singular[0]);
    const bool is_open = strength < 1.0 && strong_members(scaled, direction) > 1;
    if (!is_null && !is_open) continue;
    found.conservativeResize(Eigen::NoChange, found.cols() + 1);
    found.rightCols(1) = direction;
  }
  return found.cols() > 0 ? reduced_columns(std::move(found)) : found;
}

bool may_be_product(const Vector& direction) {
  constexpr double kWhole = 0.02;
  double least = direction.cwiseAbs().maxCoeff();
  for (const Index i : members_of(direction)) least = std::min(least, std::abs(direction[i]));
  for (const Index i : members_of(direction)) {
    const double power = direction[i] / least;
    if (std::abs(power - std::round(power)) > kWhole || std::abs(power) > 4.5) return false;
  }
  return true;
}

bool may_be_sum(const DeterminedBy& problem, const Vector& direction) {
  constexpr double kEqual = 0.02;
  const std::vector<Index> members = members_of(direction);
  if (members.size() != 2) return false;
  const double a = direction[members[0]] * problem.values[members[0]];
  const double b = direction[members[1]] * problem.values[members[1]];
  return std::abs(std::abs(a) - std::abs(b)) <= kEqual * std::abs(a);
}

FitCombination combination_of(const DeterminedBy& problem, const Vector& direction,
                              bool is_sum) {
  FitCombination found;
  const std::vector<Index> members = members_of(direction);
  for (const Index i : members)
    found.members.push_back(problem.names[static_cast<std::size_t>(i)]);
  if (members.empty()) {  // a direction without a finite entry: rounding, or no finite rows
    found.message = "the records do not determine some parameters";
    return found;
  }
  if (members.size() == 1) {
    found.message = found.members[0] + ": the records do not determine it";
    return found;
  }
  std::vector<std::string> names;
  for (const std::string& name : found.members) names.push_back(quoted(name));
  found.message = listed(names);
  if (is_sum) {
    const double a = direction[members[0]] * problem.values[members[0]];
    const double b = direction[members[1]] * problem.values[members[1]];
    found.message += " only as " + names[0] + (a * b < 0.0 ? " + " : " - ") + names[1];
    return found;
  }
  if (!may_be_product(direction)) {
    found.message += " only in a combination";
    return found;
  }
  std::size_t reference = 0;
  for (std::size_t i = 0; i < members.size(); ++i)
    if (std::abs(direction[members[i]]) < 0.9 * std::abs(direction[members[reference]]))
      reference = i;
  std::vector<std::string> invariants;
  for (std::size_t i = 0; i < members.size(); ++i) {
    if (i == reference) continue;
    const double ratio = direction[members[i]] / direction[members[reference]];
    invariants.push_back(
        invariant(names[reference], names[i], static_cast<int>(std::lround(ratio))));
  }
  found.message += " only as " + join(invariants, " and ");
  return found;
}

}  // namespace lacuna
