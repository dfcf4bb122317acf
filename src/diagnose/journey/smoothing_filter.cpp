// SPDX-License-Identifier: MIT
#include "smoothing_filter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/numerics/least_squares.hpp"
#include "core/numerics/periodogram.hpp"

namespace lacuna {
namespace {

using Kind = SmoothingFilter::Kind;

bool is_even(const SmoothingFilter& filter) { return filter.window % 2 == 0; }

/// Weights of the samples 0 ... reach away of a filter that is centred; of an even number with
/// the mean of two neighbours. Of a parabola they are those of Savitzky and Golay, Anal. Chem.
/// 36 (1964), written out.
Vector half_weights(const SmoothingFilter& filter) {
  const Index reach = filter.reach();
  Vector weights = Vector::Constant(reach + 1, 1.0 / static_cast<double>(filter.window));
  if (is_even(filter)) weights[reach] *= 0.5;
  if (filter.kind != Kind::Quadratic) return weights;
  const auto h = static_cast<double>(reach);
  for (Index j = 0; j <= reach; ++j) {
    const auto away = static_cast<double>(j);
    weights[j] = 3.0 * (3.0 * h * h + 3.0 * h - 1.0 - 5.0 * away * away) /
                 ((2.0 * h - 1.0) * (2.0 * h + 1.0) * (2.0 * h + 3.0));
  }
  return weights;
}

/// Frequency response of the centred filter.
double response(const Vector& weights, double omega) {
  double sum = weights[0];
  for (Index j = 1; j < weights.size(); ++j)
    sum += 2.0 * weights[j] * std::cos(omega * static_cast<double>(j));
  return sum;
}

/// Column k at sample i, mirrored at the values of its ends.
double value_at(const Matrix& samples, Index i, Index k) {
  const Index last = samples.rows() - 1;
  if (i < 0) return 2.0 * samples(0, k) - samples(std::min(-i, last), k);
  if (i > last) return 2.0 * samples(last, k) - samples(std::max<Index>(2 * last - i, 0), k);
  return samples(i, k);
}

Matrix smoothed_evenly(const Vector& weights, const Matrix& samples) {
  Matrix result = weights[0] * samples;
  for (Index k = 0; k < samples.cols(); ++k)
    for (Index i = 0; i < samples.rows(); ++i)
      for (Index j = 1; j < weights.size(); ++j)
        result(i, k) +=
            weights[j] * (value_at(samples, i - j, k) + value_at(samples, i + j, k));
  return result;
}

/// Samples so many rows later; the last or first one where there is none.
Matrix moved(const Matrix& samples, Index by) {
  Matrix result(samples.rows(), samples.cols());
  for (Index i = 0; i < samples.rows(); ++i)
    result.row(i) = samples.row(std::clamp<Index>(i + by, 0, samples.rows() - 1));
  return result;
}

/// Facts of the spectrum: samples of a window, six times the widest filter, so that the zeros
/// of its |h|^2 are distinguished; the frequencies that are looked at, from half of the highest
/// on, where differences of fourth order leave nothing of a well sampled signal; and those an
/// octave below them, where a signal may show, but by little.
constexpr Index kWindow = 256, kCount = kWindow / 4, kBelow = kWindow / 8;

double frequency(Index f) {
  return 2.0 * std::numbers::pi * static_cast<double>(kWindow / 4 + f) /
         static_cast<double>(kWindow);
}

/// A mean over windows.
struct Spectrum {
  Vector power = Vector::Zero(kCount);
  Vector below = Vector::Zero(kBelow);
  Index windows = 0;
  double plain = 0.0;  ///< whittle_beside() of white noise
};

bool says_anything(const Spectrum& spectrum) {
  return spectrum.windows > 0 && spectrum.power.minCoeff() > 0.0;
}

/// -2 log of Whittle's likelihood of a spectrum by its shape, the scale fitted. Neighbours in
/// frequency share a window's noise: two thirds are their own.
double whittle(const Spectrum& spectrum, const Vector& shape) {
  const Vector ratio = spectrum.power.cwiseQuotient(shape);
  return 2.0 / 3.0 * 2.0 * static_cast<double>(spectrum.windows * kCount) *
         (std::log(ratio.mean()) + shape.array().log().mean());
}

/// What Hann's window makes of a filter's |h|^2 and of differences of fourth order.
Vector shape_of(const SmoothingFilter& filter, Index first, Index count) {
  constexpr double kRounding = 1e-8;  // a fact: rounding of a record's digits fills zeros
  const Vector weights = half_weights(filter);
  const auto at = [&](Index f) {
    const double omega = frequency(f);
    const double pair = is_even(filter) ? std::cos(0.5 * omega) : 1.0;
    return (std::pow(response(weights, omega) / pair, 2) + kRounding) *
           std::pow(2.0 - 2.0 * std::cos(omega), 4);
  };
  Vector shape(count);
  for (Index i = 0; i < count; ++i) {
    const Index f = first + i;
    shape[i] = (at(f - 1) + 4.0 * at(f) + at(f + 1)) / 6.0;
  }
  return shape;
}

/// Of differences of fourth order of white noise.
Vector shape_of_white() {
  Vector shape(kCount);
  for (Index f = 0; f < kCount; ++f) shape[f] = std::pow(2.0 - 2.0 * std::cos(frequency(f)), 4);
  return shape;
}

/// whittle() of the likeliest shape times exp(a + b cos w + c cos 2 w), by Newton's method (a
/// generalised linear model of gamma-distributed powers).
double whittle_beside(const Spectrum& spectrum, const Vector& shape) {
  constexpr int kSteps = 30;  // a fact: the last ones change nothing but by rounding
  Matrix columns(kCount, 3);
  for (Index f = 0; f < kCount; ++f)
    columns.row(f) << 1.0, std::cos(frequency(f)), std::cos(2.0 * frequency(f));
  const Vector ratio = spectrum.power.cwiseQuotient(shape);
  Vector c = least_squares(columns, ratio.array().log().matrix());
  const auto smooth = [&] { return Vector((columns * c).array().exp()); };
  for (int step = 0; step < kSteps; ++step)
    c += least_squares(columns,
                       (ratio.cwiseQuotient(smooth()).array() - 1.0).cwiseMin(1.0).matrix());
  return whittle(spectrum, shape.cwiseProduct(smooth()));
}

/// Whether there is no more below the frequencies than the filter passes, up to a factor: what
/// falls off more steeply, as Gaussian weights do that are cut, only ends like it.
bool goes_on(const SmoothingFilter& filter, const Spectrum& spectrum, double scale,
             double factor) {
  const Vector below = shape_of(filter, -kBelow, kBelow);
  const Vector ratio = spectrum.below.cwiseQuotient(scale * below);
  return ratio.mean() < factor;
}

/// By what a filter is recognised.
struct FilterTest {
  double undecided = 0.0;
  SmoothingOptions options;
};

/// How much less likely noise with a short memory is than white noise behind a filter; nothing
/// where that would have to have a memory itself.
double lead_of(const SmoothingFilter& filter, const Spectrum& spectrum,
               const FilterTest& test) {
  const Vector shape = shape_of(filter, 0, kCount);
  const double own = whittle(spectrum, shape);
  const double scale = spectrum.power.cwiseQuotient(shape).mean();
  const bool is_whole = own < whittle_beside(spectrum, shape) + test.undecided &&
                        goes_on(filter, spectrum, scale, test.options.below);
  return is_whole ? spectrum.plain - own : 0.0;
}

Spectrum spectrum_of(const Dataset& data, Index state) {
  constexpr Index kWindows = 200;  // a fact: its mean is known to 7 % then, and each costs time
  const Vector hann = hann_window(kWindow);
  Spectrum spectrum;
  for (const Trajectory& record : data.trajectories) {
    const Vector& x = record.states.col(state);
    const Index n = x.size() - 4;
    if (n < kWindow) continue;
    const Vector fourth = x.head(n) - 4.0 * x.segment(1, n) + 6.0 * x.segment(2, n) -
                          4.0 * x.segment(3, n) + x.tail(n);
    for (Index first = 0; first + kWindow <= n && spectrum.windows < kWindows;
         first += kWindow, ++spectrum.windows) {
      const Vector power = periodogram(fourth.segment(first, kWindow), hann);
      spectrum.power += power.segment(kWindow / 4, kCount);
      spectrum.below += power.segment(kWindow / 4 - kBelow, kBelow);
    }
  }
  spectrum.power /= static_cast<double>(std::max<Index>(1, spectrum.windows));
  spectrum.below /= static_cast<double>(std::max<Index>(1, spectrum.windows));
  if (says_anything(spectrum)) spectrum.plain = whittle_beside(spectrum, shape_of_white());
  return spectrum;
}

std::vector<SmoothingFilter> possible_filters(Index widest) {
  std::vector<SmoothingFilter> filters;
  for (Index window = 2; window <= widest; ++window) {
    filters.push_back({Kind::CentredMean, window});
    if (window > 3 && window % 2 == 1) filters.push_back({Kind::Quadratic, window});
  }
  return filters;
}

/// Mean of a function of the frequency over all of them.
template <class Function>
double mean_over_frequencies(Function function) {
  constexpr int kFrequencies = 512;  // a fact of the quadrature: 12 between two zeros of |h|
  double sum = 0.0;
  for (int f = 0; f < kFrequencies; ++f)
    sum += function(std::numbers::pi * (f + 0.5) / kFrequencies);
  return sum / kFrequencies;
}

}  // namespace

std::optional<SmoothingFilter> estimated_filter(const Dataset& data,
                                                const std::vector<Index>& states,
                                                double undecided,
                                                const SmoothingOptions& options) {
  const FilterTest test{undecided, options};
  std::vector<Spectrum> spectra;
  for (const Index k : states) {
    spectra.push_back(spectrum_of(data, k));
    if (!says_anything(spectra.back())) return std::nullopt;
  }
  std::optional<SmoothingFilter> seen;
  double most = 0.0;
  for (const SmoothingFilter& filter : possible_filters(options.widest)) {
    double sum = 0.0, least = std::numeric_limits<double>::infinity();
    for (const Spectrum& spectrum : spectra) {
      const double lead = lead_of(filter, spectrum, test);
      least = std::min(least, lead);
      sum += lead;
    }
    if (least > undecided && sum > most) {
      most = sum;
      seen = filter;
    }
  }
  return seen;
}

Matrix smoothed(const SmoothingFilter& filter, const Matrix& samples) {
  if (filter.kind == Kind::Quadratic) return smoothed_evenly(half_weights(filter), samples);
  Matrix sum = samples;
  for (Index back = 1; back < filter.window; ++back) sum += moved(samples, -back);
  sum /= static_cast<double>(filter.window);
  return filter.kind == Kind::PastMean ? sum : moved(sum, (filter.window - 1) / 2);
}

Matrix undone(const SmoothingFilter& filter, const Matrix& samples, int turns) {
  const Vector weights = half_weights(filter);
  Matrix centred = samples;
  if (is_even(filter))
    centred = 0.5 * (samples + moved(samples, filter.kind == Kind::PastMean ? -1 : 1));
  Matrix result = centred;
  for (int turn = 0; turn < turns; ++turn)
    result += smoothed_evenly(weights, centred - smoothed_evenly(weights, result));
  return filter.kind == Kind::PastMean ? moved(result, filter.reach()) : result;
}

Index memory_of(const SmoothingFilter& filter, const SmoothingOptions& options) {
  // A fact: ripples of the covariance further away are smaller than the first ones.
  constexpr Index kMultiples = 4;
  const Vector weights = half_weights(filter);
  const auto covariance = [&](Index apart) {
    return mean_over_frequencies([&](double omega) {
      const double h = response(weights, omega);
      const double passed = 1.0 - (1.0 - h) * std::pow(1.0 - h * h, options.turns);
      return passed * passed * std::cos(omega * static_cast<double>(apart));
    });
  };
  const double most = options.in_common * covariance(0);
  for (Index apart = 1; apart < filter.window; ++apart) {
    bool fractions = false;
    for (Index times = 1; times <= kMultiples; ++times)
      fractions = fractions || std::abs(covariance(times * apart)) > most;
    if (!fractions) return apart;
  }
  return filter.window;
}

std::string description_of(const SmoothingFilter& filter) {
  const std::string window = std::to_string(filter.window) + " samples";
  switch (filter.kind) {
    case Kind::PastMean:
      return "means over the last " + window;
    case Kind::Quadratic:
      return "parabolas through " + window + " (Savitzky-Golay)";
    case Kind::CentredMean:
      break;
  }
  return "means over " + window;
}

}  // namespace lacuna
