// SPDX-License-Identifier: MIT
#include "precision.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "core/numerics/symmetric_eigen.hpp"

namespace lacuna {
namespace {

/// An eigenvalue below this fraction of the largest is rounding.
constexpr double kRounding = 1e-12;

/// The information on numbers in units of their sizes, with eigenvalues that are above 0.
struct Scaled {
  Vector eigenvalues;  ///< rising
  Matrix vectors;
  Index open = 0;  ///< directions of which nothing is known: the first ones
};

/// What an experiment adds, in units of sizes, as far as it is more than rounding.
Matrix resolved(const Matrix& added, const Vector& size) {
  // Facts: what paths are integrated to, of a number; rounding of the largest eigenvalue.
  constexpr double kLeastError = 1e-6;
  const double rounding =
      std::numeric_limits<double>::epsilon() * static_cast<double>(added.rows());
  const SymmetricEigen eigen =
      symmetric_eigen(size.asDiagonal() * added * size.asDiagonal());
  Vector values = eigen.values;
  const double least = rounding * values[values.size() - 1];
  for (double& value : values)
    value = value > least ? std::min(value, 1.0 / (kLeastError * kLeastError)) : 0.0;
  return eigen.vectors * values.asDiagonal() * eigen.vectors.transpose();
}

Scaled scaled(const InformationParts& information, const Vector& size) {
  const Matrix own = size.asDiagonal() * information.known * size.asDiagonal() +
                     resolved(information.added, size);
  SymmetricEigen eigen = symmetric_eigen(own);
  Scaled result{std::move(eigen.values), std::move(eigen.vectors)};
  const double least = std::max(kRounding * result.eigenvalues[own.rows() - 1],
                                std::numeric_limits<double>::min());
  for (double& value : result.eigenvalues)
    if (!(value > least)) {
      value = least;
      ++result.open;
    }
  return result;
}

Vector variances(const Scaled& scaled) {
  return scaled.vectors.cwiseAbs2() * scaled.eigenvalues.cwiseInverse();
}

}  // namespace

double precision_of(const InformationParts& information, const Vector& size,
                    PrecisionCriterion criterion, const std::vector<Index>& chosen) {
  if (size.size() == 0) return 0.0;
  const Scaled own = scaled(information, size);
  const Vector& values = own.eigenvalues;
  switch (criterion) {
    case PrecisionCriterion::D:
      return values.array().log().sum();
    case PrecisionCriterion::A:
      return -std::log(values.cwiseInverse().sum());
    case PrecisionCriterion::E:
      return std::log(values[0]);
    case PrecisionCriterion::ModifiedE:
      return std::log(values[0] / values[values.size() - 1]);
    case PrecisionCriterion::Chosen:
      break;
  }
  return -variances(own)(chosen).array().log().sum();
}

Vector sizes_of(const Vector& values) {
  return values.unaryExpr([](double value) { return value == 0.0 ? 1.0 : std::abs(value); });
}

Vector standard_errors(const Matrix& known, const Vector& size) {
  return errors_after({known, Matrix::Zero(known.rows(), known.cols())}, size);
}

Vector errors_after(const InformationParts& information, const Vector& size) {
  if (size.size() == 0) return {};
  const Scaled own = scaled(information, size);
  Vector errors = size.cwiseProduct(variances(own).cwiseSqrt());
  // A number that takes part in an open direction is not determined; what rounding puts into
  // such a direction is small.
  constexpr double kPart = 1e-3;
  for (Index p = 0; p < errors.size(); ++p)
    if (own.open > 0 && own.vectors.row(p).head(own.open).norm() > kPart)
      errors[p] = std::numeric_limits<double>::quiet_NaN();
  return errors;
}

}  // namespace lacuna
