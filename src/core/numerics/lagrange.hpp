// SPDX-License-Identifier: MIT
// Numbers that are not finite make numbers that are not finite.
#pragma once

#include <vector>

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// Which samples the polynomial of the interval t_n .. t_{n+1} goes through: `points` samples
/// from t_{n - before} on, moved inwards at the ends of the record.
struct LagrangeWindow {
  Index points = 4;
  Index before = 1;

  /// As many samples before as after the interval: t_{n-1} .. t_{n+2} for four points. One
  /// point holds the last sample, two are a straight line.
  static LagrangeWindow centred(Index points);

  /// The window of a synchronisation by a method of order p: p samples (at least two) from
  /// t_{n - p/2} on, with t_{n+1} among them; t_{n-2} .. t_{n+1} for p = 4, as in Karimov et
  /// al. 2023, Sect. 2.2.
  static LagrangeWindow driving(int order);
};

/// Samples of q quantities as functions of time: piecewise Lagrange polynomials on any
/// increasing grid, in barycentric form (Berrut and Trefethen, SIAM Review 46:501-517, 2004).
/// It goes through the samples exactly. Refers to time and values; they must outlive it.
class LagrangeInterpolant {
 public:
  /// @param time n increasing times; @param values n x q.
  /// @throws ArgumentError when shapes do not fit, times do not increase, or there are fewer
  /// than `window.points` samples.
  LagrangeInterpolant(const Vector& time, const Matrix& values, LagrangeWindow window);

  /// Uses the polynomial of the interval t_n .. t_{n+1} from now on (n from 0).
  void select(Index interval);

  /// The interval whose begin t_n is the last sample time not above t; 0 for an earlier t.
  Index interval_of(double t) const;

  /// Writes the q values of the selected polynomial at t.
  void evaluate(double t, double* out);

  Index quantities() const noexcept { return values_.cols(); }

 private:
  void prepare();

  const Vector& time_;
  const Matrix& values_;
  LagrangeWindow window_;
  Index first_ = -1;             ///< first sample of the selected polynomial
  std::vector<double> weights_;  ///< barycentric weights of its points
  std::vector<double> factors_;  ///< scratch
};

}  // namespace lacuna
