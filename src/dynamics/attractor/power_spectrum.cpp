// SPDX-License-Identifier: MIT
#include "dynamics/attractor/power_spectrum.hpp"

#include <cmath>

#include "core/numerics/periodogram.hpp"
#include "data/records/check_record.hpp"

namespace lacuna {
namespace {

double step_of(const Trajectory& record) {
  const std::optional<double> step = uniform_step(record);
  if (!step)
    throw ArgumentError("power spectrum", record.source + " is not sampled uniformly",
                        "resample it");
  return *step;
}

Trajectory first_samples(const Trajectory& record, Index n) {
  Trajectory part;
  part.source = record.source;
  part.time = record.time.head(n);
  part.states = record.states.topRows(n);
  return part;
}

void normalise(Matrix& density) {
  for (Index k = 0; k < density.cols(); ++k)
    if (const double sum = density.col(k).sum(); sum > 0.0) density.col(k) /= sum;
}

}  // namespace

PowerSpectrum power_spectrum(const Trajectory& record, Index segments) {
  const double step = step_of(record);
  check_rows(record, "power spectrum");
  const Index length = segments > 0 ? record.samples() / segments : 0;
  if (length < 8)
    throw ArgumentError("power spectrum", "a segment has fewer than 8 samples",
                        "use fewer segments or a longer record");
  const Vector window = hann_window(length);
  const Index shift = length / 2;
  const Index count = (record.samples() - length) / shift + 1;
  const double scale = step / (window.squaredNorm() * static_cast<double>(count));
  PowerSpectrum spectrum;
  spectrum.density = Matrix::Zero(length / 2 + 1, record.states.cols());
  for (Index k = 0; k < record.states.cols(); ++k)
    for (Index s = 0; s < count; ++s)
      spectrum.density.col(k) +=
          scale * periodogram(record.states.col(k).segment(s * shift, length), window);
  const double spacing = 1.0 / (static_cast<double>(length) * step);
  spectrum.frequency =
      Vector::LinSpaced(length / 2 + 1, 0.0, spacing * static_cast<double>(length / 2));
  check_argument(spectrum.density.allFinite() && spectrum.frequency.allFinite(),
                 "power spectrum", "a sample or its square is not finite",
                 "leave it out, or use larger units");
  return spectrum;
}

double power_spectrum_distance(const Trajectory& a, const Trajectory& b, Index segments) {
  if (a.states.cols() != b.states.cols())
    throw ArgumentError("power_spectrum_distance", "the records differ in states", "");
  check_argument(a.states.cols() > 0, "power_spectrum_distance", "the records have no state");
  check_rows(a, "power_spectrum_distance");
  check_rows(b, "power_spectrum_distance");
  if (std::abs(step_of(a) / step_of(b) - 1.0) > 1e-3)
    throw ArgumentError("power_spectrum_distance", "the records differ in sampling step",
                        "resample one of them");
  const Index n = std::min(a.samples(), b.samples());
  Matrix p = power_spectrum(first_samples(a, n), segments).density;
  Matrix q = power_spectrum(first_samples(b, n), segments).density;
  normalise(p);
  normalise(q);
  double sum = 0.0;
  for (Index k = 0; k < p.cols(); ++k) {
    const double overlap = p.col(k).cwiseProduct(q.col(k)).cwiseSqrt().sum();
    sum += std::sqrt(std::max(0.0, 1.0 - overlap));
  }
  return sum / static_cast<double>(p.cols());
}

}  // namespace lacuna
