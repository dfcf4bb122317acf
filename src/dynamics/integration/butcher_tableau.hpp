// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace lacuna {

/// Coefficients of an explicit Runge-Kutta method with s stages:
/// k_i = f(t + c_i h, x + h sum_{j<i} a_ij k_j),  x_new = x + h sum_i b_i k_i
/// (Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, Sect. II.1).
struct ButcherTableau {
  int order = 0;                       ///< p of the solution that is carried on
  int embedded_order = 0;              ///< order of the second solution; 0 without one
  std::vector<double> nodes;           ///< c, s entries
  std::vector<std::vector<double>> a;  ///< row i has i entries
  std::vector<double> weights;         ///< b, s entries
  std::vector<double> embedded;        ///< b of the second solution; empty without one

  int stages() const noexcept { return static_cast<int>(nodes.size()); }  ///< s
};

/// The midpoint rule of order 2, two stages (Runge 1895).
const ButcherTableau& midpoint_2();

/// Kutta's method of order 3, three stages (Kutta 1901).
const ButcherTableau& kutta_3();

/// The classical method of order 4, four stages (Kutta 1901).
const ButcherTableau& runge_kutta_4();

/// Dormand and Prince's 5(4) pair, seven stages (J. Comput. Appl. Math. 6:19-26, 1980).
const ButcherTableau& dormand_prince_54();

/// Butcher's method of order 6, seven stages (J. Austral. Math. Soc. 4:179-194, 1964).
const ButcherTableau& butcher_6();

/// The solution of order 7 in Prince and Dormand's 8(7) pair, twelve stages.
const ButcherTableau& prince_dormand_7();

/// Prince and Dormand's 8(7) pair RK8(7)13M, 13 stages (J. Comput. Appl. Math. 7:67-75, 1981).
const ButcherTableau& prince_dormand_87();

/// One method for each order from 2 to 8: those above, of the pairs the solution
/// that is carried on. @throws ArgumentError for another order.
const ButcherTableau& method_of_order(int order);

}  // namespace lacuna
