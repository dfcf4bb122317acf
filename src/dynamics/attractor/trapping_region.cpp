// SPDX-License-Identifier: MIT
#include "lacuna/dynamics/attractor/trapping_region.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <vector>

#include "core/numerics/constrained_least_squares.hpp"
#include "core/numerics/least_squares.hpp"
#include "core/numerics/symmetric_eigen.hpp"

namespace lacuna {
namespace {

/// x' = c + L x + Q(x): Q_i = x' quadratic[i] x, with symmetric matrices.
struct QuadraticFlow {
  Vector constant;
  Matrix linear;
  std::vector<Matrix> quadratic;

  Index size() const { return constant.size(); }
};

/// Slots of the factors of a monomial of degree 2 at most.
std::optional<std::vector<Index>> factors_of(const Term& term, Index states) {
  const std::optional<std::vector<int>> exponents = term.exponents();
  if (!exponents) return std::nullopt;
  std::vector<Index> factors;
  for (std::size_t slot = 0; slot < exponents->size(); ++slot) {
    const int power = (*exponents)[slot];
    if (power == 0) continue;
    if (power > 2 || static_cast<Index>(slot) >= states) return std::nullopt;
    factors.insert(factors.end(), static_cast<std::size_t>(power), static_cast<Index>(slot));
  }
  return factors.size() <= 2 ? std::optional(factors) : std::nullopt;
}

std::optional<QuadraticFlow> quadratic_flow(const OdeModel& model) {
  const Index n = model.dimension();
  if (n == 0 || model.is_map()) return std::nullopt;
  QuadraticFlow flow{Vector::Zero(n), Matrix::Zero(n, n),
                     std::vector<Matrix>(static_cast<std::size_t>(n), Matrix::Zero(n, n))};
  for (Index i = 0; i < n; ++i)
    for (const WeightedTerm& summand : model.equations()[static_cast<std::size_t>(i)]) {
      const std::optional<std::vector<Index>> factors = factors_of(summand.term, n);
      if (!factors || !std::isfinite(summand.coefficient)) return std::nullopt;
      const double a = summand.coefficient;
      Matrix& q = flow.quadratic[static_cast<std::size_t>(i)];
      if (factors->empty()) {
        flow.constant[i] += a;
      } else if (factors->size() == 1) {
        flow.linear(i, (*factors)[0]) += a;
      } else {
        q((*factors)[0], (*factors)[1]) += 0.5 * a;
        q((*factors)[1], (*factors)[0]) += 0.5 * a;
      }
    }
  return flow;
}

/// Of every monomial of degree 3, what each state's weight adds to its coefficient in
/// sum_k w_k x_k Q_k(x); cubic monomials x n.
Matrix energy_of_quadratics(const QuadraticFlow& flow) {
  std::map<std::array<Index, 3>, Eigen::RowVectorXd> rows;
  const Index n = flow.size();
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j)
      for (Index k = 0; k < n; ++k) {
        const double q = flow.quadratic[static_cast<std::size_t>(i)](j, k);
        if (q == 0.0) continue;
        std::array<Index, 3> monomial{i, j, k};
        std::sort(monomial.begin(), monomial.end());
        rows.try_emplace(monomial, Eigen::RowVectorXd::Zero(n)).first->second[i] += q;
      }
  Matrix result(static_cast<Index>(rows.size()), n);
  Index r = 0;
  for (const auto& [monomial, row] : rows) result.row(r++) = row;
  return result;
}

/// The weights nearest to 1 with which quadratic terms keep the energy, of mean 1.
std::optional<Vector> energy_weights(const QuadraticFlow& flow) {
  // Facts of the method: with less weight, a ball is so long in that state that it says nothing
  // of it; and rounding.
  constexpr double kLeastWeight = 1e-3, kRounding = 1e-9;
  const Index n = flow.size();
  Matrix energy = energy_of_quadratics(flow);
  for (Index r = 0; r < energy.rows(); ++r) energy.row(r) /= energy.row(r).norm();
  const std::optional<InequalitySolution> found = inequality_least_squares(
      Matrix::Identity(n, n), Vector::Ones(n), energy, Vector::Zero(energy.rows()),
      -Matrix::Identity(n, n), Vector::Constant(n, -kLeastWeight));
  if (!found) return std::nullopt;
  const Vector& w = found->solution.h;
  if (energy.rows() > 0 && (energy * w).cwiseAbs().maxCoeff() > kRounding * w.maxCoeff())
    return std::nullopt;
  return w / w.mean();
}

/// The flow of W^1/2 x.
QuadraticFlow scaled(const QuadraticFlow& flow, const Vector& roots) {
  QuadraticFlow result = flow;
  const auto back = roots.cwiseInverse().asDiagonal();
  result.constant = roots.cwiseProduct(flow.constant);
  result.linear = roots.asDiagonal() * flow.linear * back;
  for (Index i = 0; i < flow.size(); ++i) {
    Matrix& q = result.quadratic[static_cast<std::size_t>(i)];
    q = roots[i] * (back * q * back).eval();
  }
  return result;
}

/// S(m) = S_0 + sum_k m_k S_k.
struct SymmetricParts {
  Matrix constant;
  std::vector<Matrix> slopes;

  Matrix at(const Vector& centre) const {
    Matrix sum = constant;
    for (std::size_t k = 0; k < slopes.size(); ++k)
      sum += centre[static_cast<Index>(k)] * slopes[k];
    return sum;
  }
};

SymmetricParts symmetric_parts(const QuadraticFlow& flow) {
  const Index n = flow.size();
  SymmetricParts parts{0.5 * (flow.linear + flow.linear.transpose()), {}};
  for (Index k = 0; k < n; ++k) {
    Matrix jacobian(n, n);  // of Q along x_k
    for (Index i = 0; i < n; ++i)
      jacobian.row(i) = 2.0 * flow.quadratic[static_cast<std::size_t>(i)].row(k);
    parts.slopes.push_back(0.5 * (jacobian + jacobian.transpose()));
  }
  return parts;
}

/// mu log tr exp(S / mu), which is above the largest eigenvalue by mu log n at most.
struct SoftMaximum {
  double value = 0.0;
  Vector gradient;
  Matrix hessian;
};

double soft_maximum(const Vector& eigenvalues, double mu) {
  const double top = eigenvalues.maxCoeff();
  return top + mu * std::log(((eigenvalues.array() - top) / mu).exp().sum());
}

SoftMaximum soft_maximum(const SymmetricParts& parts, const Vector& centre, double mu) {
  const SymmetricEigen eigen = symmetric_eigen(parts.at(centre));
  const Vector& values = eigen.values;
  const Index n = values.size();
  SoftMaximum result{soft_maximum(values, mu), Vector(n), Matrix(n, n)};
  const Vector p = ((values.array() - result.value) / mu).exp();
  Matrix curvature(n, n);  // divided differences of p
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j) {
      const double gap = values[i] - values[j];
      curvature(i, j) =
          std::abs(gap) > 1e-9 * mu ? (p[i] - p[j]) / gap : 0.5 * (p[i] + p[j]) / mu;
    }
  std::vector<Matrix> turned;
  for (const Matrix& slope : parts.slopes)
    turned.push_back(eigen.vectors.transpose() * slope * eigen.vectors);
  for (Index k = 0; k < n; ++k) {
    const Matrix& a = turned[static_cast<std::size_t>(k)];
    result.gradient[k] = p.dot(a.diagonal());
    for (Index l = 0; l < n; ++l)
      result.hessian(k, l) =
          curvature.cwiseProduct(a).cwiseProduct(turned[static_cast<std::size_t>(l)]).sum();
  }
  result.hessian -= result.gradient * result.gradient.transpose() / mu;
  return result;
}

/// A step of Newton's method, halved until the soft maximum falls. @return whether it fell.
bool step_down(const SymmetricParts& parts, double mu, Vector& centre) {
  const SoftMaximum now = soft_maximum(parts, centre, mu);
  const double damping = 1e-9 * std::max(1e-300, now.hessian.diagonal().cwiseAbs().maxCoeff());
  const Index n = centre.size();
  const Vector step =
      -solve_symmetric(now.hessian + damping * Matrix::Identity(n, n), now.gradient);
  if (!step.allFinite()) return false;
  for (double length = 1.0; length > 1e-6; length *= 0.5) {
    const Vector next = centre + length * step;
    const double gain = now.value - soft_maximum(symmetric_eigen(parts.at(next)).values, mu);
    if (!(gain > 0.0)) continue;
    centre = next;
    return gain > 1e-12 * std::abs(now.value);
  }
  return false;
}

/// The centre with the least largest eigenvalue, as far as Newton's method comes.
Vector best_centre(const SymmetricParts& parts) {
  // Facts of the method: it ends at a millionth of the rates, and bounds the work.
  constexpr double kLeast = 1e-6;
  constexpr int kSteps = 50;
  Vector centre = Vector::Zero(parts.constant.rows());
  const double rate = std::max(1e-300, parts.constant.cwiseAbs().maxCoeff());
  for (double mu = rate; mu > kLeast * rate; mu *= 0.5)
    for (int i = 0; i < kSteps && step_down(parts, mu, centre); ++i) {
    }
  return centre;
}

Vector rates_at(const QuadraticFlow& flow, const Vector& x) {
  Vector rates = flow.constant + flow.linear * x;
  for (Index i = 0; i < flow.size(); ++i)
    rates[i] += x.dot(flow.quadratic[static_cast<std::size_t>(i)] * x);
  return rates;
}

}  // namespace

TrappingAnswer trapping_region(const OdeModel& model) {
  const std::optional<QuadraticFlow> flow = quadratic_flow(model);
  if (!flow) return {Boundedness::NotQuadratic};
  const std::optional<Vector> weights = energy_weights(*flow);
  if (!weights) return {Boundedness::ProducesEnergy};
  const Vector roots = weights->cwiseSqrt();
  const QuadraticFlow energetic = scaled(*flow, roots);
  const SymmetricParts parts = symmetric_parts(energetic);
  const Vector centre = best_centre(parts);
  const Vector values = symmetric_eigen(parts.at(centre)).values;
  const double largest = values.maxCoeff();
  const double rounding = 1e-12 * values.cwiseAbs().maxCoeff();
  if (!(largest < -rounding)) return {Boundedness::NoCentre};
  return {Boundedness::Trapped,
          TrappingRegion{centre.cwiseQuotient(roots), *weights,
                         rates_at(energetic, centre).norm() / -largest, -largest}};
}

}  // namespace lacuna
