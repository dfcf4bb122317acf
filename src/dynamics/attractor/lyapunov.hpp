// SPDX-License-Identifier: MIT
// Numbers that are not finite make numbers that are not finite.
#pragma once

#include "lacuna/dynamics/integration/integrator.hpp"
#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {

/// How long and how finely an orbit is followed.
struct LyapunovOptions {
  double step = 0.01;         ///< between two orthonormalisations, time units
  double transient = 100.0;   ///< left out at the start, time units
  double duration = 10000.0;  ///< averaged over, time units
};

/// Lyapunov exponents of a model.
struct LyapunovSpectrum {
  Vector exponents;        ///< m, from the largest on, 1 / time unit
  Vector half_width;       ///< of their 95 % intervals, from ten blocks of the orbit
  double dimension = 0.0;  ///< kaplan_yorke_dimension() of the exponents
};

/// All exponents from the variational equation dQ/dt = J(x) Q, Q m x m, orthonormalised by QR
/// after each step: lambda_k is the mean of log R_kk per time (Benettin, Galgani, Giorgilli,
/// Strelcyn, Meccanica 15:9-20, 1980).
/// @throws ArgumentError when the model has inputs or delays, when x0 does not fit or the orbit
/// diverges.
LyapunovSpectrum lyapunov_spectrum(const OdeModel& model, const Integrator& integrator,
                                   const Vector& x0, const LyapunovOptions& options = {});

/// j + (lambda_1 + .. + lambda_j) / |lambda_{j+1}| with the largest j whose sum is not negative
/// (Kaplan and Yorke 1979); the number of exponents when their whole sum is not negative.
/// @param exponents from the largest on.
/// @throws ArgumentError when one is NaN or infinite.
double kaplan_yorke_dimension(const Vector& exponents);

}  // namespace lacuna
