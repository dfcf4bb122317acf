// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <string>

namespace lacuna::benchmarks {

/// A synchronisation error as printed.
struct PrintedError {
  double median, mean, percent;
};

/// Rows of Tables 2, 4 and 5 of Karimov et al. 2023 that speak of one system.
struct PrintedSystem {
  const char* name;
  std::optional<std::array<double, 8>> extents;  ///< dx, its error, dy, ., dz, ., volume, .
  PrintedError to_original;                      ///< Table 4: slave is the original system
  PrintedError to_adjusted;                      ///< Table 4: slave is the adjusted system
  PrintedError identified;                       ///< Table 5

  /// Unit of Table 5's errors in V: the amplitudes of the circuit are those of Rossler's
  /// equations divided by 4, and some rows are in the latter.
  double unit;
};

/// In the order of the tables. `identified` of the circuits and of the original system is in
/// units of 1/4 V: mean / percent is the largest |x|, which tells.
inline const std::array<PrintedSystem, 6>& printed_systems() {
  static const std::array<PrintedSystem, 6> systems{{
      {"Rossler original ODE",
       {},
       {2.5626e-5, 6.4179e-5, 2.7265e-4},
       {0.25598, 0.4448, 7.5591},
       {5.1217e-3, 9.4747e-3, 4.0250e-2},
       0.25},
      {"Rossler adjusted ODE",
       {{5.18, 0.03, 4.74, 0.03, 7.66, 0.18, 188, 6}},
       {0.9263, 1.5463, 4.8483},
       {1.0684e-5, 2.6749e-4, 3.3547e-4},
       {2.6192e-3, 6.6841e-3, 8.3827e-2},
       1.0},
      {"Multisim TL072",
       {{5.18, 0.02, 4.79, 0.04, 7.61, 0.14, 189, 5}},
       {1.6127, 1.8167, 5.9581},
       {0.4194, 0.6190, 8.121},
       {6.9212e-2, 0.1249, 1.6389},
       1.0},
      {"Multisim OPA2134",
       {{5.15, 0.03, 4.75, 0.03, 7.31, 0.15, 179, 6}},
       {1.9420, 1.6075, 6.5933},
       {0.3863, 0.3891, 5.2847},
       {3.0144e-2, 3.3475e-2, 0.4546},
       1.0},
      {"Circuit TL072",
       {{4.26, 0.01, 3.93, 0.01, 3.92, 0.04, 65.8, 0.6}},
       {0.56914, 1.0487, 6.1491},
       {0.14096, 0.11889, 3.3063},
       {9.7622e-3, 1.3091e-2, 7.6764e-2},
       0.25},
      {"Circuit OPA2134",
       {{3.98, 0.01, 3.70, 0.01, 2.89, 0.05, 42.4, 0.9}},
       {0.88045, 1.1895, 8.9829},
       {0.18727, 0.20016, 6.0461},
       {7.7741e-3, 9.3596e-3, 7.0681e-2},
       0.25},
  }};
  return systems;
}

/// Median error of the two models of Fig. 1.
inline constexpr double kPrintedFigure1Median = 2.77e-5;

}  // namespace lacuna::benchmarks
