// SPDX-License-Identifier: MIT
#include "dynamics/test_systems/rossler_circuit.hpp"

#include <string>
#include <utility>

#include "lacuna/core/base/error.hpp"
#include "model_builder.hpp"

namespace lacuna {
namespace {

void check_positive(const RosslerComponents& c) {
  const std::pair<const char*, double> values[] = {
      {"R1", c.r1},   {"R2", c.r2},   {"R3", c.r3},   {"R4", c.r4},
      {"R8", c.r8},   {"R10", c.r10}, {"R11", c.r11}, {"R12", c.r12},
      {"R13", c.r13}, {"C1", c.c1},   {"C2", c.c2},   {"C3", c.c3}};
  for (const auto& [name, value] : values)
    if (!(value > 0.0))
      throw ArgumentError("rossler_circuit", std::string(name) + " is not positive",
                          "resistances are in kOhm, capacitances in nF");
}

// 1 / (R C) per tau = 0.1 ms.
double rate(double kilo_ohm, double nano_farad) { return 100.0 / (kilo_ohm * nano_farad); }

}  // namespace

RosslerComponents RosslerComponents::measured() {
  return {.r1 = 9.60,
          .r2 = 9.38,
          .r3 = 9.64,
          .r4 = 41.5,
          .r8 = 38.2,
          .r10 = 2.21,
          .r11 = 9.12,
          .r12 = 9.99,
          .r13 = 0.990,
          .c1 = 10.1,
          .c2 = 10.0,
          .c3 = 9.9};
}

OdeModel rossler_circuit(const RosslerComponents& c) {
  check_positive(c);
  const double multiplier = rate(10.0 * c.r13, c.c3);
  return build_model({{"x", "V"}, {"y", "V"}, {"z", "V"}},
                     {{{"y", -rate(c.r1, c.c1)}, {"z", -rate(c.r2, c.c1)}},
                      {{"x", rate(c.r3, c.c2)}, {"y", rate(c.r4, c.c2)}},
                      {{"1", c.vb * rate(c.r8, c.c3)},
                       {"z", -multiplier * c.r12 * c.vc / c.r11},
                       {"x*z", multiplier * c.r12 / c.r10}}},
                     "tau");
}

}  // namespace lacuna
