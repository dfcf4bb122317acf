// SPDX-License-Identifier: MIT
#include "lacuna/records/channels/map_hint.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/text.hpp"
#include "core/numerics/least_squares.hpp"

namespace lacuna {
namespace {

// Facts: what a polynomial needs, and what is enough of the largest part of records for a
// remark; neighbours are sought among all pairs of them.
constexpr Index kMostSamples = 2000;
constexpr Index kSamplesOfTerm = 4;

/// Samples and those that follow, in deviations about the mean.
struct Pairs {
  Matrix before;  ///< n x (m + p), states and inputs
  Matrix after;   ///< n x m
};

/// The factors of one monomial, with repeats: {0, 0, 1} is x0^2 x1.
using Factors = std::vector<Index>;

bool has_rates(const Dataset& data) {
  return std::any_of(data.trajectories.begin(), data.trajectories.end(),
                     [](const Trajectory& t) { return t.has_derivatives(); }) ||
         std::any_of(data.rate_of.begin(), data.rate_of.end(),
                     [](const auto& rate) { return rate.has_value(); });
}

/// The first records, of no more samples than are looked at; none where there is nothing to
/// look at.
std::vector<Trajectory> looked_at(const Dataset& data) {
  std::vector<Trajectory> records;
  if (data.states.empty() || has_rates(data)) return records;
  Index left = kMostSamples;
  for (const Trajectory& record : data.trajectories) {
    const Index count = std::min(left, record.samples());
    if (count < 2) break;
    records.push_back(rows_of(record, 0, count));
    left -= count;
  }
  return records;
}

Pairs pairs_of(const std::vector<Trajectory>& records) {
  const Index m = records.front().states.cols(), p = records.front().inputs.cols();
  Index rows = 0;
  for (const Trajectory& record : records) rows += record.samples() - 1;
  Pairs pairs{Matrix(rows, m + p), Matrix(rows, m)};
  Index row = 0;
  for (const Trajectory& record : records) {
    const Index count = record.samples() - 1;
    pairs.before.middleRows(row, count) << record.states.topRows(count),
        record.inputs.topRows(count);
    pairs.after.middleRows(row, count) = record.states.bottomRows(count);
    row += count;
  }
  for (Index c = 0; c < m + p; ++c) {
    const double mean = pairs.before.col(c).mean();
    pairs.before.col(c).array() -= mean;
    const double size = std::sqrt(pairs.before.col(c).squaredNorm() / double(rows));
    if (size > 0.0) pairs.before.col(c) /= size;
    if (c < m) pairs.after.col(c) = (pairs.after.col(c).array() - mean) / size;
  }
  return pairs;
}

double roughness_of(const std::vector<Trajectory>& records) {
  Vector near = Vector::Zero(records.front().states.cols()), far = near;
  for (const Trajectory& record : records) {
    const Index n = record.samples() - 4;
    if (n < 1) continue;
    const auto from = [&](Index first) { return record.states.middleRows(first, n); };
    near += (from(2) - 0.5 * (from(1) + from(3))).colwise().squaredNorm().transpose();
    far += (from(2) - 0.5 * (from(0) + from(4))).colwise().squaredNorm().transpose();
  }
  if (!(far.minCoeff() > 0.0)) return 0.0;
  return std::sqrt((near.array() / far.array()).minCoeff());
}

/// Monomials of so many variables up to a degree, that of degree 0 first, then degree by
/// degree.
std::vector<Factors> monomials(Index variables, int degree) {
  std::vector<Factors> all{{}};
  for (std::size_t begin = 0; degree > 0; --degree) {
    const std::size_t end = all.size();
    for (; begin < end; ++begin)
      for (Index v = all[begin].empty() ? 0 : all[begin].back(); v < variables; ++v) {
        all.push_back(all[begin]);
        all.back().push_back(v);
      }
  }
  return all;
}

double product(const Factors& factors, const Matrix& values, Index row) {
  double result = 1.0;
  for (const Index factor : factors) result *= values(row, factor);
  return result;
}

/// The derivative of a monomial by a variable.
double derivative(const Factors& factors, const Matrix& values, Index row, Index variable) {
  const auto found = std::find(factors.begin(), factors.end(), variable);
  if (found == factors.end()) return 0.0;
  Factors rest = factors;
  rest.erase(rest.begin() + (found - factors.begin()));
  return double(std::count(factors.begin(), factors.end(), variable)) *
         product(rest, values, row);
}

Matrix design(const std::vector<Factors>& terms, const Matrix& values) {
  Matrix theta(values.rows(), static_cast<Index>(terms.size()));
  for (Index row = 0; row < theta.rows(); ++row)
    for (std::size_t l = 0; l < terms.size(); ++l)
      theta(row, static_cast<Index>(l)) = product(terms[l], values, row);
  return theta;
}

/// Rows of every other one of ten blocks.
std::vector<Index> half_of(Index rows, bool second) {
  constexpr Index kBlocks = 10;  // each longer than what neighbouring samples share
  std::vector<Index> half;
  for (Index row = 0; row < rows; ++row)
    if ((row * kBlocks / rows % 2 == 1) == second) half.push_back(row);
  return half;
}

/// The largest fraction of a deviation that is left on the half that was not fitted.
double remainder_of(const Matrix& theta, const Matrix& after) {
  Vector squares = Vector::Zero(after.cols());
  for (const bool second : {false, true}) {
    const std::vector<Index> fitted = half_of(theta.rows(), second);
    const std::vector<Index> left = half_of(theta.rows(), !second);
    const Matrix h = least_squares(theta(fitted, Eigen::all), after(fitted, Eigen::all));
    squares += (after(left, Eigen::all) - theta(left, Eigen::all) * h)
                   .colwise()
                   .squaredNorm()
                   .transpose();
  }
  return std::sqrt(squares.maxCoeff() / double(after.rows()));
}

double reversed_fraction(const std::vector<Factors>& terms, const Matrix& theta,
                         const Pairs& pairs) {
  const Index m = pairs.after.cols();
  const Matrix h = least_squares(theta, pairs.after);
  Index reversed = 0;
  for (Index row = 0; row < theta.rows(); ++row) {
    Matrix slopes(theta.cols(), m);
    for (Index l = 0; l < theta.cols(); ++l)
      for (Index j = 0; j < m; ++j)
        slopes(l, j) = derivative(terms[static_cast<std::size_t>(l)], pairs.before, row, j);
    if ((h.transpose() * slopes).determinant() < 0.0) ++reversed;
  }
  return double(reversed) / double(theta.rows());
}

/// Sets mean and standard error of the logarithm by which neighbours part. @param remainder in
/// deviations.
void measure_divergence(const Pairs& pairs, double remainder, MapEvidence& seen) {
  const Index n = pairs.before.rows(), m = pairs.after.cols();
  // Pairs nearer than the polynomial's own error would show that error and not the map.
  constexpr double kBeyond = 5.0, kRounding = 1e-9;
  const double least = std::max(kBeyond * remainder * std::sqrt(double(m)), kRounding);
  double sum = 0.0, squares = 0.0, count = 0.0;
  for (Index i = 0; i < n; ++i) {
    Index nearest = i;
    double distance = std::numeric_limits<double>::infinity();
    for (Index j = 0; j < n; ++j) {
      const double apart = (pairs.before.row(j) - pairs.before.row(i)).squaredNorm();
      if (apart < least * least || apart >= distance) continue;
      distance = apart;
      nearest = j;
    }
    if (nearest == i) continue;
    const double after = (pairs.after.row(nearest) - pairs.after.row(i)).norm();
    const double growth = std::log(std::max(after, kRounding) / std::sqrt(distance));
    sum += growth;
    squares += growth * growth;
    ++count;
  }
  if (count < 2.0) return;
  seen.divergence = sum / count;
  seen.divergence_error =
      std::sqrt(std::max(squares / count - seen.divergence * seen.divergence, 0.0) / count);
}

}  // namespace

void MapHintOptions::describe(OptionVisitor& v) {
  v.field({"roughness", "",
           "Samples are on no path where their mean neighbours are off by this fraction of "
           "what neighbours at twice the distance are off by.",
           0.25, 1e6},
          roughness);
  v.field({"remainder", "", "A map leaves less than this fraction of the deviation.", 0.0, 1.0},
          remainder);
  v.field({"bend", "",
           "A linear map leaves so many times more: a linear one may be samples far apart.",
           1.0, 1e6},
          bend);
  v.field({"reversed", "",
           "Fraction of samples at which the map turns the orientation, as no flow does.", 0.0,
           1.0},
          reversed);
  v.field(
      {"divergence", "",
       "Neighbours part by this logarithm in a step: on closed orbits of a flow they do not.",
       0.0, 10.0},
      divergence);
  v.field({"errors", "", "That logarithm is so many of its standard errors.", 0.0, 100.0},
          errors);
}

std::optional<MapEvidence> map_evidence(const Dataset& data) {
  const std::vector<Trajectory> records = looked_at(with_input_columns(data));
  if (records.empty()) return std::nullopt;
  const Pairs pairs = pairs_of(records);
  if (!pairs.before.allFinite() || !pairs.after.allFinite()) return std::nullopt;
  const auto enough = [&](const std::vector<Factors>& terms) {
    return kSamplesOfTerm * static_cast<Index>(terms.size()) <= pairs.before.rows();
  };
  std::vector<Factors> terms = monomials(pairs.before.cols(), 3);
  if (!enough(terms)) terms = monomials(pairs.before.cols(), 2);
  if (!enough(terms)) return std::nullopt;
  const Matrix theta = design(terms, pairs.before);
  MapEvidence seen{
      .roughness = roughness_of(records),
      .remainder = remainder_of(theta, pairs.after),
      .linear_remainder = remainder_of(theta.leftCols(1 + pairs.before.cols()), pairs.after),
      .reversed = reversed_fraction(terms, theta, pairs)};
  measure_divergence(pairs, seen.remainder, seen);
  return seen;
}

std::optional<Hint> map_hint(const Dataset& data, const MapHintOptions& options) {
  // Most records end here, at no cost.
  const std::vector<Trajectory> records = looked_at(data);
  if (records.empty() || roughness_of(records) < options.roughness) return std::nullopt;
  const std::optional<MapEvidence> seen = map_evidence(data);
  const bool holds = seen && seen->remainder <= options.remainder &&
                     seen->linear_remainder >= options.bend * seen->remainder &&
                     seen->reversed >= options.reversed &&
                     seen->divergence >= options.divergence &&
                     seen->divergence >= options.errors * seen->divergence_error;
  if (!holds) return std::nullopt;
  return Hint{HintKind::DiscreteMap,
              "the record looks like a map x[n+1] = f(x[n]): each sample follows from the one "
              "before to " +
                  format_number(100.0 * seen->remainder, 2) +
                  " % of the deviation, and neighbours are on no common path",
              "identify --discrete"};
}

}  // namespace lacuna
