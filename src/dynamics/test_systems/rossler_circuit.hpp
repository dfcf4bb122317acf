// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {

/// Components of the Rossler circuit of Karimov et al. 2023, Sect. 2.3 (numbers as in its Table
/// 1); by default the proposed, ideal values.
struct RosslerComponents {
  double r1 = 10.0, r2 = 10.0;  ///< kOhm, to the integrator of x
  double r3 = 10.0, r4 = 40.0;  ///< kOhm; see the note at rossler_circuit
  double r8 = 40.0, r10 = 2.5, r11 = 10.0, r12 = 10.0;  ///< kOhm, to the integrator of z
  double r13 = 1.0;                                     ///< kOhm, at the multiplier's output
  double c1 = 10.0, c2 = 10.0, c3 = 10.0;               ///< nF
  double vb = 0.2, vc = 5.7;                            ///< V, the constants b and c

  /// The measured values of Table 1.
  static RosslerComponents measured();
};

/// The circuit as a model in V per tau, where tau = 0.1 ms and 1 kOhm nF = 0.01 tau:
///   C1 dx = -y/R1 - z/R2,  C2 dy = x/R3 + y/R4,
///   C3 dz = Vb/R8 + z/(10 R13) (R12 x/R10 - R12 Vc/R11).
/// The multiplier divides by 10 V. The article prints R8 Vb/R13 as first term of dz; Vb/R8 is
/// what its component values need and what gives its attractor. R4 = 40 kOhm is the nearest to
/// the ideal 50 kOhm that the article's Table 1 has: dy = x + 0.25 y, where its equations say
/// 0.2 y.
/// @throws ArgumentError when a resistance or a capacitance is not positive.
OdeModel rossler_circuit(const RosslerComponents& components = {});

}  // namespace lacuna
