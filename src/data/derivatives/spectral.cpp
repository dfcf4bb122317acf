// SPDX-License-Identifier: MIT
#include "data/derivatives/spectral.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "core/numerics/qr.hpp"
#include "data/derivatives/excerpt.hpp"
#include "data/derivatives/stencil.hpp"

namespace lacuna {
namespace {

constexpr Index kPiece = 1024;  ///< samples that are fitted together
constexpr int kEndDegree = 5;   ///< of the polynomials for the ends

/// n x (degree + 1 + cosines): k-th derivatives of the functions at given times.
Matrix series_rows(const Vector& time, double first, double length, int degree, Index cosines,
                   int order) {
  Matrix rows(time.size(), degree + 1 + cosines);
  const double scale = std::pow(length, -order);
  for (Index i = 0; i < time.size(); ++i) {
    const double s = (time[i] - first) / length;
    // Powers of 2s - 1 span the same polynomials and depend less on each other.
    rows.row(i).head(degree + 1) =
        scale * std::pow(2.0, order) *
        power_derivatives(2.0 * s - 1.0, degree, order).transpose();
    for (Index k = 1; k <= cosines; ++k) {
      const double w = std::numbers::pi * static_cast<double>(k);
      rows(i, degree + k) =
          scale * std::pow(w, order) * std::cos(w * s + 0.5 * std::numbers::pi * order);
    }
  }
  return rows;
}

int end_degree(Index samples) {
  return static_cast<int>(std::min<Index>(kEndDegree, samples - 2));
}

/// Cosines up to the cutoff over a length; half of the samples at most.
Index cosines_below(double cutoff, double length, Index samples, int degree) {
  const double count = std::floor(2.0 * cutoff * length * (1.0 + 1e-12));
  const Index most = std::max<Index>(0, samples / 2 - degree - 1);
  return static_cast<Index>(std::min(count, static_cast<double>(most)));
}

/// Fit of one piece: derivatives of all columns and their error per unit of noise.
struct SeriesFit {
  Matrix derivative;
  Vector gain;   ///< norm of each row's weights
  Vector noise;  ///< sqrt(RSS / (n - functions))
};

SeriesFit fit_series(const Vector& time, const Matrix& values, double cutoff, int order) {
  const Index n = time.size();
  const int degree = end_degree(n);
  const double length = time[n - 1] - time[0];
  const Index cosines = cosines_below(cutoff, length, n, degree);
  const Matrix rows = series_rows(time, time[0], length, degree, cosines, 0);
  const Qr qr(rows);
  const Matrix projected = qr.transposed_times(values);
  const Index functions = rows.cols();
  const Matrix r = qr.triangle();
  const Matrix coefficients =
      r.triangularView<Eigen::Upper>().solve(projected.topRows(functions));
  const Matrix wanted = series_rows(time, time[0], length, degree, cosines, order);
  const Matrix weights = r.triangularView<Eigen::Upper>().transpose().solve(wanted.transpose());
  const double free = static_cast<double>(std::max<Index>(n - functions, 1));
  const Vector squares = projected.bottomRows(n - functions).colwise().squaredNorm();
  return {wanted * coefficients, weights.colwise().norm(), (squares / free).cwiseSqrt()};
}

/// The cosines of least cross-validation: the first K functions of one factor are those of K.
Index best_cosines(const Vector& time, const Matrix& values) {
  const Index n = time.size();
  const int degree = end_degree(n);
  const Index most = cosines_below(std::numeric_limits<double>::max(), 1.0, n, degree);
  const Matrix rows = series_rows(time, time[0], time[n - 1] - time[0], degree, most, 0);
  const Matrix squares = Qr(rows).transposed_times(values).array().square();
  constexpr double kUnit = std::numeric_limits<double>::epsilon();
  const Vector rounding = kUnit * kUnit * values.colwise().squaredNorm().transpose();
  double least = std::numeric_limits<double>::infinity();
  Index best = 0;
  for (Index cosines = 0; cosines <= most; ++cosines) {
    const Index functions = degree + 1 + cosines;
    const double free = static_cast<double>(n - functions);
    const Vector rest = squares.bottomRows(n - functions).colwise().sum().transpose() + rounding;
    const double score =
        ((rest.array() + std::numeric_limits<double>::min()) / (free * free)).log().sum();
    if (!(score < least)) continue;
    least = score;
    best = cosines;
  }
  return best;
}

/// A stretch of samples that is fitted, and the part of it that is used.
struct Piece {
  Index first, count, from, to;
};

std::vector<Piece> pieces_of(Index samples) {
  if (samples <= kPiece) return {{0, samples, 0, samples}};
  std::vector<Piece> pieces;
  constexpr Index kQuarter = kPiece / 4;
  for (Index from = 0; from < samples;) {
    const Index first = std::min(std::max<Index>(from - kQuarter, 0), samples - kPiece);
    const bool last = first + kPiece >= samples;
    const Index to = last ? samples : first + 3 * kQuarter;
    pieces.push_back({first, kPiece, from, to});
    from = to;
  }
  return pieces;
}

/// Applies a cutoff to all pieces; `take` gets the piece and its fit.
template <class Take>
void over_pieces(const Vector& time, const Eigen::Ref<const Matrix>& values, double cutoff,
                 int order, Take take) {
  for (const Piece& piece : pieces_of(time.size()))
    take(piece, fit_series(time.segment(piece.first, piece.count),
                           values.middleRows(piece.first, piece.count), cutoff, order));
}

}  // namespace

Matrix Spectral::do_differentiate(const Vector& time, const Eigen::Ref<const Matrix>& values,
                                  int order) const {
  check_samples(info().name, time.size(), do_fewest_samples());
  if (!options().cutoff)
    return do_fit(dataset_of(time, values), std::nullopt)->differentiate(time, values, order);
  Matrix result(time.size(), values.cols());
  over_pieces(time, values, *options().cutoff, order, [&](const Piece& p, const SeriesFit& fit) {
    result.middleRows(p.from, p.to - p.from) =
        fit.derivative.middleRows(p.from - p.first, p.to - p.from);
  });
  return result;
}

std::optional<Matrix> Spectral::do_standard_error(const Vector& time,
                                                  const Eigen::Ref<const Matrix>& values,
                                                  int order) const {
  check_samples(info().name, time.size(), do_fewest_samples());
  if (!options().cutoff)
    return do_fit(dataset_of(time, values), std::nullopt)->standard_error(time, values, order);
  Matrix result(time.size(), values.cols());
  over_pieces(time, values, *options().cutoff, order, [&](const Piece& p, const SeriesFit& fit) {
    result.middleRows(p.from, p.to - p.from) =
        fit.gain.segment(p.from - p.first, p.to - p.from) * fit.noise.transpose();
  });
  return result;
}

std::shared_ptr<const Differentiator> Spectral::do_fit(const Dataset& data,
                                                       const std::optional<Vector>&) const {
  if (options().cutoff) return nullptr;
  const Trajectory& longest = longest_record(data);
  check_samples(info().name, longest.samples(), do_fewest_samples());
  const Index count = std::min(longest.samples(), kPiece);
  const Trajectory middle = rows_of(longest, (longest.samples() - count) / 2, count);
  const double cosines = static_cast<double>(best_cosines(middle.time, middle.states));
  // A quarter more, for pieces whose lengths differ by rounding; never 0.
  return std::make_shared<Spectral>(
      Options{.cutoff = (cosines + 0.25) / (2.0 * middle.duration())});
}

Stage<Differentiator> spectral(const SpectralOptions& options) { return Spectral(options); }

}  // namespace lacuna
