// SPDX-License-Identifier: MIT
#include "dynamics/integration/butcher_tableau.hpp"

#include <array>
#include <string>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

ButcherTableau make_midpoint_2() {
  return {.order = 2,
          .embedded_order = 0,
          .nodes = {0.0, 0.5},
          .a = {{}, {0.5}},
          .weights = {0.0, 1.0},
          .embedded = {}};
}

ButcherTableau make_kutta_3() {
  return {.order = 3,
          .embedded_order = 0,
          .nodes = {0.0, 0.5, 1.0},
          .a = {{}, {0.5}, {-1.0, 2.0}},
          .weights = {1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0},
          .embedded = {}};
}

ButcherTableau make_runge_kutta_4() {
  return {.order = 4,
          .embedded_order = 0,
          .nodes = {0.0, 0.5, 0.5, 1.0},
          .a = {{}, {0.5}, {0.0, 0.5}, {0.0, 0.0, 1.0}},
          .weights = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0},
          .embedded = {}};
}

// clang-format off
ButcherTableau make_dormand_prince_54() {
  return {.order = 5,
          .embedded_order = 4,
          .nodes = {0.0, 0.2, 0.3, 0.8, 8.0 / 9.0, 1.0, 1.0},
          .a = {{},
                {0.2},
                {3.0 / 40.0, 9.0 / 40.0},
                {44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0},
                {19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0},
                {9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0,
                 -5103.0 / 18656.0},
                {35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0,
                 11.0 / 84.0}},
          .weights = {35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0,
                      11.0 / 84.0, 0.0},
          .embedded = {5179.0 / 57600.0, 0.0, 7571.0 / 16695.0, 393.0 / 640.0,
                       -92097.0 / 339200.0, 187.0 / 2100.0, 1.0 / 40.0}};
}

ButcherTableau make_butcher_6() {
  return {.order = 6,
          .embedded_order = 0,
          .nodes = {0.0, 1.0 / 2.0, 2.0 / 3.0, 1.0 / 3.0, 5.0 / 6.0, 1.0 / 6.0, 1.0},
          .a = {{},
                {1.0 / 2.0},
                {2.0 / 9.0, 4.0 / 9.0},
                {7.0 / 36.0, 2.0 / 9.0, -1.0 / 12.0},
                {-35.0 / 144.0, -55.0 / 36.0, 35.0 / 48.0, 15.0 / 8.0},
                {-1.0 / 360.0, -11.0 / 36.0, -1.0 / 8.0, 1.0 / 2.0, 1.0 / 10.0},
                {-41.0 / 260.0, 22.0 / 13.0, 43.0 / 156.0, -118.0 / 39.0, 32.0 / 195.0,
                 80.0 / 39.0}},
          .weights = {13.0 / 200.0, 0.0, 11.0 / 40.0, 11.0 / 40.0, 4.0 / 25.0, 4.0 / 25.0,
                      13.0 / 200.0},
          .embedded = {}};
}

std::vector<std::vector<double>> prince_dormand_stages() {
  return {
      {},
      {1.0 / 18.0},
      {1.0 / 48.0, 1.0 / 16.0},
      {1.0 / 32.0, 0.0, 3.0 / 32.0},
      {5.0 / 16.0, 0.0, -75.0 / 64.0, 75.0 / 64.0},
      {3.0 / 80.0, 0.0, 0.0, 3.0 / 16.0, 3.0 / 20.0},
      {29443841.0 / 614563906.0, 0.0, 0.0, 77736538.0 / 692538347.0,
       -28693883.0 / 1125000000.0, 23124283.0 / 1800000000.0},
      {16016141.0 / 946692911.0, 0.0, 0.0, 61564180.0 / 158732637.0, 22789713.0 / 633445777.0,
       545815736.0 / 2771057229.0, -180193667.0 / 1043307555.0},
      {39632708.0 / 573591083.0, 0.0, 0.0, -433636366.0 / 683701615.0,
       -421739975.0 / 2616292301.0, 100302831.0 / 723423059.0, 790204164.0 / 839813087.0,
       800635310.0 / 3783071287.0},
      {246121993.0 / 1340847787.0, 0.0, 0.0, -37695042795.0 / 15268766246.0,
       -309121744.0 / 1061227803.0, -12992083.0 / 490766935.0, 6005943493.0 / 2108947869.0,
       393006217.0 / 1396673457.0, 123872331.0 / 1001029789.0},
      {-1028468189.0 / 846180014.0, 0.0, 0.0, 8478235783.0 / 508512852.0,
       1311729495.0 / 1432422823.0, -10304129995.0 / 1701304382.0,
       -48777925059.0 / 3047939560.0, 15336726248.0 / 1032824649.0,
       -45442868181.0 / 3398467696.0, 3065993473.0 / 597172653.0},
      {185892177.0 / 718116043.0, 0.0, 0.0, -3185094517.0 / 667107341.0,
       -477755414.0 / 1098053517.0, -703635378.0 / 230739211.0, 5731566787.0 / 1027545527.0,
       5232866602.0 / 850066563.0, -4093664535.0 / 808688257.0, 3962137247.0 / 1805957418.0,
       65686358.0 / 487910083.0},
      {403863854.0 / 491063109.0, 0.0, 0.0, -5068492393.0 / 434740067.0,
       -411421997.0 / 543043805.0, 652783627.0 / 914296604.0, 11173962825.0 / 925320556.0,
       -13158990841.0 / 6184727034.0, 3936647629.0 / 1978049680.0, -160528059.0 / 685178525.0,
       248638103.0 / 1413531060.0, 0.0}};
}

ButcherTableau make_prince_dormand_87() {
  return {.order = 8,
          .embedded_order = 7,
          .nodes = {0.0, 1.0 / 18.0, 1.0 / 12.0, 1.0 / 8.0, 5.0 / 16.0, 3.0 / 8.0,
                    59.0 / 400.0, 93.0 / 200.0, 5490023248.0 / 9719169821.0, 13.0 / 20.0,
                    1201146811.0 / 1299019798.0, 1.0, 1.0},
          .a = prince_dormand_stages(),
          .weights = {14005451.0 / 335480064.0, 0.0, 0.0, 0.0, 0.0,
                      -59238493.0 / 1068277825.0, 181606767.0 / 758867731.0,
                      561292985.0 / 797845732.0, -1041891430.0 / 1371343529.0,
                      760417239.0 / 1151165299.0, 118820643.0 / 751138087.0,
                      -528747749.0 / 2220607170.0, 0.25},
          .embedded = {13451932.0 / 455176623.0, 0.0, 0.0, 0.0, 0.0,
                       -808719846.0 / 976000145.0, 1757004468.0 / 5645159321.0,
                       656045339.0 / 265891186.0, -3867574721.0 / 1518517206.0,
                       465885868.0 / 322736535.0, 53011238.0 / 667516719.0, 2.0 / 45.0, 0.0}};
}
// clang-format on

/// The 8(7) pair with the weights of order 7, which leave out the last stage.
ButcherTableau make_prince_dormand_7() {
  ButcherTableau tableau = make_prince_dormand_87();
  tableau.nodes.pop_back();
  tableau.a.pop_back();
  tableau.weights = tableau.embedded;
  tableau.weights.pop_back();
  tableau.order = tableau.embedded_order;
  tableau.embedded_order = 0;
  tableau.embedded.clear();
  return tableau;
}

}  // namespace

const ButcherTableau& midpoint_2() {
  static const ButcherTableau tableau = make_midpoint_2();
  return tableau;
}

const ButcherTableau& kutta_3() {
  static const ButcherTableau tableau = make_kutta_3();
  return tableau;
}

const ButcherTableau& runge_kutta_4() {
  static const ButcherTableau tableau = make_runge_kutta_4();
  return tableau;
}

const ButcherTableau& dormand_prince_54() {
  static const ButcherTableau tableau = make_dormand_prince_54();
  return tableau;
}

const ButcherTableau& butcher_6() {
  static const ButcherTableau tableau = make_butcher_6();
  return tableau;
}

const ButcherTableau& prince_dormand_7() {
  static const ButcherTableau tableau = make_prince_dormand_7();
  return tableau;
}

const ButcherTableau& prince_dormand_87() {
  static const ButcherTableau tableau = make_prince_dormand_87();
  return tableau;
}

const ButcherTableau& method_of_order(int order) {
  static const std::array methods{&midpoint_2(),        &kutta_3(),   &runge_kutta_4(),
                                  &dormand_prince_54(), &butcher_6(), &prince_dormand_7(),
                                  &prince_dormand_87()};
  if (order < 2 || order > 8)
    throw ArgumentError("Runge-Kutta method", "there is none of order " + std::to_string(order),
                        "choose an order from 2 to 8");
  return *methods[static_cast<std::size_t>(order - 2)];
}

}  // namespace lacuna
