// SPDX-License-Identifier: MIT
#include "lacuna/dynamics/test_systems/test_systems.hpp"

#include <algorithm>

#include "core/base/text.hpp"
#include "dynamics/test_systems/rossler_circuit.hpp"
#include "lacuna/core/base/error.hpp"
#include "measured_circuits.hpp"
#include "model_builder.hpp"

namespace lacuna {
namespace {

std::vector<Quantity> named(const std::vector<std::string>& names) {
  std::vector<Quantity> quantities;
  for (const std::string& name : names) quantities.push_back({name, ""});
  return quantities;
}

Vector vector_of(std::initializer_list<double> values) {
  Vector vector(static_cast<Index>(values.size()));
  std::copy(values.begin(), values.end(), vector.begin());
  return vector;
}

// alpha = 15.6, beta = 28, diode slopes m0 = -8/7, m1 = -5/7.
TestSystem chua() {
  constexpr double kAlpha = 15.6, kInner = -8.0 / 7.0, kOuter = -5.0 / 7.0;
  constexpr double kBend = 0.5 * kAlpha * (kInner - kOuter);
  return {"chua",
          "Chua's circuit with a piecewise linear diode: the double scroll.",
          "Matsumoto, Chua and Komuro 1985",
          build_model(named({"x", "y", "z"}),
                      {{{"x", -kAlpha * (1.0 + kOuter)},
                        {"y", kAlpha},
                        {"abs(x+1)", -kBend},
                        {"abs(x-1)", kBend}},
                       {{"x", 1.0}, {"y", -1.0}, {"z", 1.0}},
                       {{"y", -28.0}}},
                      ""),
          vector_of({1.6, 0.1, -2.3}),
          0.02};
}

TestSystem duffing() {
  return {
      "duffing",
      "Double-well oscillator under a harmonic force, chaotic.",
      "Holmes 1979; damping 0.3, force 0.5 cos(1.2 t)",
      build_model(named({"q", "v"}),
                  {{{"v", 1.0}}, {{"q", 1.0}, {"q^3", -1.0}, {"v", -0.3}, {"cos(1.2*t)", 0.5}}},
                  ""),
      vector_of({1.0, 0.0}),
      0.05};
}

TestSystem fitzhugh_nagumo() {
  return {"fitzhugh-nagumo",
          "Spiking nerve cell: a fast voltage and a slow recovery.",
          "FitzHugh 1961; a = 0.7, b = 0.8, current 0.5, rate 0.08",
          build_model(named({"v", "w"}),
                      {{{"1", 0.5}, {"v", 1.0}, {"w", -1.0}, {"v^3", -1.0 / 3.0}},
                       {{"1", 0.056}, {"v", 0.08}, {"w", -0.064}}},
                      ""),
          vector_of({-1.0, -0.5}),
          0.1};
}

TestSystem lorenz() {
  return {"lorenz",
          "Thermal convection, the butterfly.",
          "Lorenz 1963; sigma = 10, rho = 28, beta = 8/3",
          build_model(named({"x", "y", "z"}),
                      {{{"x", -10.0}, {"y", 10.0}},
                       {{"x", 28.0}, {"y", -1.0}, {"x*z", -1.0}},
                       {{"z", -8.0 / 3.0}, {"x*y", 1.0}}},
                      ""),
          vector_of({-8.0, 8.0, 27.0}),
          0.01};
}

// C = 1, L = 3, alpha = 0.6, beta = 1.5; z is the memristor's inner state.
TestSystem memristor() {
  return {"memristor",
          "Capacitor, inductor and memristor: the simplest chaotic circuit.",
          "Muthuswamy and Chua 2010, Int. J. Bifurcation Chaos 20:1567, eq. (4)",
          build_model(named({"x", "y", "z"}),
                      {{{"y", 1.0}},
                       {{"x", -1.0 / 3.0}, {"y", 0.5}, {"y*z^2", -0.5}},
                       {{"y", -1.0}, {"z", -0.6}, {"y*z", 1.0}}},
                      ""),
          vector_of({0.1, 0.0, 0.1}),
          0.05};
}

TestSystem opa2134() {
  return {
      "opa2134",
      "Rossler's circuit with OPA2134 amplifiers: the printed equations, not its attractor.",
      "Karimov et al. 2023, Table 3; docs/paper.md",
      opa2134_model(),
      vector_of({0.25, 0.25, 0.025}),
      0.1};
}

TestSystem pendulum() {
  return {"pendulum",
          "Pendulum of 0.5 m length with viscous friction.",
          "9.81 / 0.5 = 19.62 per s^2, friction 0.15 per s",
          build_model({{"th", "rad"}, {"w", "rad/s"}},
                      {{{"w", 1.0}}, {{"sin(th)", -19.62}, {"w", -0.15}}}, "s"),
          vector_of({2.5, 0.0}),
          0.01};
}

TestSystem rossler() {
  return {"rossler",
          "The simplest chaotic flow: one product.",
          "Rossler 1976; a = b = 0.2, c = 5.7",
          build_model(named({"x", "y", "z"}),
                      {{{"y", -1.0}, {"z", -1.0}},
                       {{"x", 1.0}, {"y", 0.2}},
                       {{"1", 0.2}, {"z", -5.7}, {"x*z", 1.0}}},
                      ""),
          vector_of({1.0, 1.0, 0.1}),
          0.05};
}

TestSystem rossler_original_circuit() {
  return {"rossler-circuit",
          "Rossler's system in a circuit of ideal parts, amplitudes / 4.",
          "Karimov et al. 2023, Sect. 2.3; tau = 0.1 ms",
          build_model({{"x", "V"}, {"y", "V"}, {"z", "V"}},
                      {{{"y", -1.0}, {"z", -1.0}},
                       {{"x", 1.0}, {"y", 0.2}},
                       {{"1", 0.05}, {"z", -5.7}, {"x*z", 4.0}}},
                      "tau"),
          vector_of({0.25, 0.25, 0.025}),
          0.1};
}

TestSystem rossler_adjusted_circuit() {
  return {"rossler-adjusted",
          "Rossler's circuit with the measured values of its parts.",
          "Karimov et al. 2023, Table 1",
          rossler_circuit(RosslerComponents::measured()),
          vector_of({0.25, 0.25, 0.025}),
          0.1};
}

TestSystem tl072() {
  return {"tl072",
          "Rossler's circuit with TL072 amplifiers, as identified from measurements.",
          "Karimov et al. 2023, Table 3",
          tl072_model(),
          vector_of({0.25, 0.25, 0.025}),
          0.1};
}

TestSystem van_der_pol() {
  return {"van-der-pol",
          "Self-excited oscillator with one limit cycle.",
          "van der Pol 1926; mu = 1",
          build_model(named({"q", "v"}),
                      {{{"v", 1.0}}, {{"q", -1.0}, {"v", 1.0}, {"q^2*v", -1.0}}}, ""),
          vector_of({2.0, 0.0}),
          0.05};
}

}  // namespace

const std::vector<TestSystem>& test_systems() {
  static const std::vector<TestSystem> systems{chua(),
                                               duffing(),
                                               fitzhugh_nagumo(),
                                               lorenz(),
                                               memristor(),
                                               opa2134(),
                                               pendulum(),
                                               rossler(),
                                               rossler_adjusted_circuit(),
                                               rossler_original_circuit(),
                                               tl072(),
                                               van_der_pol()};
  return systems;
}

const TestSystem& test_system(const std::string& name) {
  std::vector<std::string> names;
  for (const TestSystem& system : test_systems()) {
    if (system.name == name) return system;
    names.push_back(system.name);
  }
  throw ConfigError("test system '" + name + "'", "there is no such system",
                    suggestion(name, names));
}

}  // namespace lacuna
