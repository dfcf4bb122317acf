// SPDX-License-Identifier: MIT
#include "hidden/support/disturbance.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/random.hpp"
#include "lacuna/data/records/marks.hpp"

namespace lacuna::hidden {
namespace {

double deviation(const Vector& x) { return std::sqrt((x.array() - x.mean()).square().mean()); }

Vector white(Index n, Random& random) {
  Vector noise(n);
  for (double& value : noise) value = random.normal();
  return noise;
}

Vector coloured(Index n, Random& random) {
  const double kept = std::exp(-1.0 / 5.0), fresh = std::sqrt(1.0 - kept * kept);
  Vector noise = white(n, random);
  for (Index i = 1; i < n; ++i) noise[i] = kept * noise[i - 1] + fresh * noise[i];
  return noise;
}

Vector with_outliers(Index n, Random& random) {
  Vector noise = white(n, random);
  for (double& value : noise) {
    if (random.uniform() >= 0.01) continue;
    const double spike = random.uniform(5.0, 10.0);
    value += random.uniform() < 0.5 ? -spike : spike;
  }
  return noise;
}

Vector drifting(Index n, Random& random) {
  const double phase = random.uniform(0.0, 2.0 * std::numbers::pi);
  Vector noise = white(n, random) * std::sqrt(0.5);
  for (Index i = 0; i < n; ++i)
    noise[i] +=
        std::sin(std::numbers::pi * static_cast<double>(i) / static_cast<double>(n) + phase);
  return noise;
}

/// White noise, then the ends of the range.
Vector clipped(const Vector& x, double sigma, Random& random) {
  const Vector noisy = x + sigma * white(x.size(), random);
  std::vector<double> sorted(noisy.begin(), noisy.end());
  std::sort(sorted.begin(), sorted.end());
  const std::size_t tenth = sorted.size() / 10;
  return noisy.cwiseMax(sorted[tenth]).cwiseMin(sorted[sorted.size() - 1 - tenth]);
}

Vector with_dropouts(const Vector& x, double sigma, Random& random) {
  Vector noisy = x + sigma * white(x.size(), random);
  for (Index i = 1; i < noisy.size(); ++i) {
    if (random.uniform() >= 0.01) continue;
    const auto length = static_cast<Index>(random.uniform(3.0, 8.0));
    for (const Index end = std::min(noisy.size(), i + length); i < end; ++i)
      noisy[i] = noisy[i - 1];
  }
  return noisy;
}

/// Blank but for every fifth sample; blanks repeat the value before, as a reader fills them.
void make_slow(Trajectory& record, Index state) {
  for (Index i = 0; i < record.samples(); ++i) {
    if (i % 5 == 0) continue;
    record.states(i, state) = record.states(i - 1, state);
    set_mark(record, i, state, Mark::Missing);
  }
}

/// The middle of the polynomial of least squares through the samples about each one.
Vector fitted(const Vector& x, Index reach, Index degree) {
  Vector middle(x.size());
  for (Index i = 0; i < x.size(); ++i) {
    const Index r = std::min({reach, i, x.size() - 1 - i});
    Matrix powers(2 * r + 1, std::min(degree, 2 * r) + 1);
    for (Index j = -r; j <= r; ++j)
      for (Index p = 0; p < powers.cols(); ++p)
        powers(j + r, p) = std::pow(static_cast<double>(j), static_cast<double>(p));
    middle[i] = powers.householderQr().solve(x.segment(i - r, 2 * r + 1))[0];
  }
  return middle;
}

Vector rounded(const Vector& x, double grid) { return (x.array() / grid).round() * grid; }

Vector measured(const Vector& x, NoiseKind kind, double sigma, Random& random) {
  switch (kind) {
    case NoiseKind::White:
    case NoiseKind::Slow:
      return x + sigma * white(x.size(), random);
    case NoiseKind::Clipped:
      return clipped(x, sigma, random);
    case NoiseKind::Dropouts:
      return with_dropouts(x, sigma, random);
    case NoiseKind::Coloured:
      return x + sigma * coloured(x.size(), random);
    case NoiseKind::Outliers:
      return x + sigma * with_outliers(x.size(), random);
    case NoiseKind::Drifting:
      return x + sigma * drifting(x.size(), random);
    case NoiseKind::Averaged:
      return fitted(x + sigma * white(x.size(), random), 4, 0);
    case NoiseKind::Parabolas:
      return fitted(x + sigma * white(x.size(), random), 7, 2);
    case NoiseKind::Quantised:
      break;
  }
  return rounded(x, sigma * std::sqrt(12.0));
}

}  // namespace

std::string to_string(NoiseKind kind) {
  switch (kind) {
    case NoiseKind::White:
      return "white";
    case NoiseKind::Coloured:
      return "coloured";
    case NoiseKind::Outliers:
      return "outliers";
    case NoiseKind::Quantised:
      return "quantised";
    case NoiseKind::Clipped:
      return "clipped";
    case NoiseKind::Dropouts:
      return "dropouts";
    case NoiseKind::Slow:
      return "slow";
    case NoiseKind::Averaged:
      return "averaged";
    case NoiseKind::Parabolas:
      return "parabolas";
    case NoiseKind::Drifting:
      break;
  }
  return "drifting";
}

Dataset disturbed(const Dataset& clean, NoiseKind kind, double level, std::uint64_t seed) {
  Dataset record = clean;
  Random random(seed);
  for (Trajectory& trajectory : record.trajectories) {
    trajectory.derivatives.resize(0, 0);
    for (Index k = 0; level > 0.0 && k < trajectory.states.cols(); ++k) {
      const Vector x = trajectory.states.col(k);
      trajectory.states.col(k) = measured(x, kind, level * deviation(x), random);
    }
    if (kind == NoiseKind::Slow) make_slow(trajectory, trajectory.states.cols() - 1);
  }
  return record;
}

}  // namespace lacuna::hidden
