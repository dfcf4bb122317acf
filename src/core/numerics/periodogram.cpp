// SPDX-License-Identifier: MIT
#include "core/numerics/periodogram.hpp"

#include <cmath>
#include <numbers>
#include <unsupported/Eigen/FFT>

namespace lacuna {

Vector hann_window(Index n) {
  const double full = 2.0 * std::numbers::pi / static_cast<double>(n);
  Vector window(n);
  for (Index i = 0; i < n; ++i)
    window[i] = 0.5 - 0.5 * std::cos(full * (static_cast<double>(i) + 0.5));
  return window;
}

Vector periodogram(const Vector& samples, const Vector& window) {
  Eigen::FFT<double> fft;
  const Vector weighted = (samples.array() - samples.mean()) * window.array();
  Eigen::VectorXcd transform;
  fft.fwd(transform, weighted);
  const Index half = samples.size() / 2;
  Vector power = transform.head(half + 1).cwiseAbs2();
  const Index paired = samples.size() % 2 == 0 ? half - 1 : half;
  power.segment(1, paired) *= 2.0;
  return power;
}

}  // namespace lacuna
