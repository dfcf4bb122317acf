// SPDX-License-Identifier: MIT
#include "moments.hpp"

#include <algorithm>
#include <cmath>

#include "data/records/known_noise.hpp"

namespace lacuna {
namespace {

constexpr Index kMostSamples = 5000;  // more distinguish relations no better
constexpr Index kBlocks = 20;

/// Exponents of all monomials of a degree, in lexicographic order.
void add_exponents(std::size_t variables, int degree, std::vector<int>& begun,
                   std::vector<std::vector<int>>& all) {
  if (begun.size() + 1 == variables) {
    all.push_back(begun);
    all.back().push_back(degree);
    return;
  }
  for (int power = degree; power >= 0; --power) {
    begun.push_back(power);
    add_exponents(variables, degree - power, begun, all);
    begun.pop_back();
  }
}

double power_of(double x, int exponent) { return exponent == 0 ? 1.0 : std::pow(x, exponent); }

double monomial(const Vector& x, const std::vector<int>& exponents) {
  double value = 1.0;
  for (std::size_t k = 0; k < exponents.size(); ++k)
    value *= power_of(x[static_cast<Index>(k)], exponents[k]);
  return value;
}

double slope(const Vector& x, std::vector<int> exponents, std::size_t k) {
  const int power = exponents[k];
  if (power == 0) return 0.0;
  --exponents[k];
  return power * monomial(x, exponents);
}

/// Second derivatives of a monomial.
Matrix bend(const Vector& x, const std::vector<int>& exponents) {
  const auto m = static_cast<Index>(exponents.size());
  Matrix second = Matrix::Zero(m, m);
  for (Index k = 0; k < m; ++k) {
    std::vector<int> lower = exponents;
    const int power = lower[static_cast<std::size_t>(k)]--;
    for (Index l = 0; l < m && power > 0; ++l)
      second(k, l) = power * slope(x, lower, static_cast<std::size_t>(l));
  }
  return second;
}

/// tr(H_a S H_b S) of all pairs of monomials at a point. Hessians H up to degree 2 are the same
/// everywhere.
Matrix second_order(const std::vector<std::vector<int>>& monomials, const Vector& x,
                    const Vector& variances) {
  const auto count = static_cast<Index>(monomials.size());
  const Vector root = variances.cwiseSqrt();
  Matrix bends(x.size() * x.size(), count);
  for (Index c = 0; c < count; ++c) {
    const Matrix scaled =
        root.asDiagonal() * bend(x, monomials[static_cast<std::size_t>(c)]) * root.asDiagonal();
    bends.col(c) = scaled.reshaped();
  }
  return bends.transpose() * bends;
}

/// Measured states at samples of all records, evenly thinned.
Matrix samples_of(const Dataset& data, const std::vector<Index>& states) {
  const Index stride = 1 + (data.samples() - 1) / kMostSamples;
  Index rows = 0;
  for (const Trajectory& record : data.trajectories)
    rows += (record.samples() + stride - 1) / stride;
  Matrix values(rows, static_cast<Index>(states.size()));
  Index row = 0;
  for (const Trajectory& record : data.trajectories)
    for (Index i = 0; i < record.samples(); i += stride, ++row)
      for (std::size_t k = 0; k < states.size(); ++k)
        values(row, static_cast<Index>(k)) = record.states(i, states[k]);
  return values;
}

/// Variances of the errors of each state.
struct ErrorVariances {
  Vector white, lasting;
};

ErrorVariances error_variances(const std::vector<Index>& states, const Matrix& samples,
                               double resolution, const std::vector<StateNoise>& noise) {
  const Index m = samples.cols();
  ErrorVariances errors{Vector::Zero(m), Vector::Zero(m)};
  for (Index k = 0; k < m; ++k) {
    const StateNoise& seen =
        noise[static_cast<std::size_t>(states[static_cast<std::size_t>(k)])];
    const double variance = seen.sigma * seen.sigma;
    const double spread = (samples.col(k).array() - samples.col(k).mean()).square().mean();
    errors.lasting[k] = resolution * resolution * spread;
    if (seen.kind == NoiseKind::Coloured) errors.lasting[k] += variance;
    if (seen.kind == NoiseKind::White || seen.kind == NoiseKind::Quantised)
      errors.white[k] = variance;
  }
  return errors;
}

}  // namespace

MonomialMoments monomial_moments(const Dataset& data, int degree, double resolution,
                                 int threads, const KnownNoise& noise) {
  std::vector<Index> states;
  Variables variables;
  for (Index k = 0; k < data.state_count(); ++k)
    if (data.is_measured(k)) {
      states.push_back(k);
      variables.states.push_back(data.states[static_cast<std::size_t>(k)].name);
    }
  MonomialMoments moments;
  std::vector<int> begun;
  for (int d = 1; d <= degree; ++d) add_exponents(states.size(), d, begun, moments.exponents);
  for (std::vector<int> exponents : moments.exponents) {
    exponents.push_back(0);  // of t
    moments.terms.push_back(Term::monomial(exponents, variables));
  }

  const Matrix samples = samples_of(data, states);
  const ErrorVariances errors =
      error_variances(states, samples, resolution, known_or_analysed(noise, data, threads));
  const Index n = samples.rows(), count = static_cast<Index>(moments.terms.size());
  Matrix values(n, count);
  moments.white = Matrix::Zero(count, count);
  moments.lasting = moments.white;
  Matrix slopes(count, samples.cols());
  for (Index i = 0; i < n; ++i) {
    const Vector x = samples.row(i);
    for (Index c = 0; c < count; ++c) {
      const std::vector<int>& exponents = moments.exponents[static_cast<std::size_t>(c)];
      values(i, c) = monomial(x, exponents);
      for (Index k = 0; k < samples.cols(); ++k)
        slopes(c, k) = slope(x, exponents, static_cast<std::size_t>(k));
    }
    moments.white += slopes * errors.white.asDiagonal() * slopes.transpose();
    moments.lasting += slopes * errors.lasting.asDiagonal() * slopes.transpose();
  }
  moments.second = second_order(moments.exponents, samples.colwise().mean(), errors.white);
  const double rows = static_cast<double>(n);
  moments.white /= rows;
  moments.lasting /= rows;
  const Vector mean = values.colwise().mean().transpose();
  values.rowwise() -= mean.transpose();
  moments.mean = mean;
  for (Index c = 0; c < count; ++c)
    for (Index k = 0; k < samples.cols(); ++k)
      if (moments.exponents[static_cast<std::size_t>(c)][static_cast<std::size_t>(k)] == 2)
        moments.mean[c] -= errors.white[k];
  moments.covariance = values.transpose() * values / rows;
  moments.samples = n;
  moments.block = std::max<Index>(1, n / kBlocks);
  const Index blocks = n / moments.block;
  moments.block_means.resize(blocks, count);
  for (Index b = 0; b < blocks; ++b)
    moments.block_means.row(b) =
        values.middleRows(b * moments.block, moments.block).colwise().mean();
  return moments;
}

}  // namespace lacuna
