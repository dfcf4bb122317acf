// SPDX-License-Identifier: MIT
#include "signals.hpp"

#include <cmath>
#include <numbers>
#include <utility>

#include "lacuna/dynamics/integration/integrators.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"

namespace lacuna::benchmarks {
namespace {

using Point = std::pair<double, double>;  // value, rate

Signal formula(const std::string& name, double length, Point (*at)(double)) {
  return {name, length, [at](const Vector& time) {
            Matrix values(time.size(), 2);
            for (Index i = 0; i < time.size(); ++i) {
              const Point point = at(time[i]);
              values.row(i) << point.first, point.second;
            }
            return values;
          }};
}

/// The first state of a test system from its usual start.
Signal orbit(const std::string& name, double length) {
  return {name, length, [name](const Vector& time) {
            const TestSystem& system = test_system(name);
            const Solution solution = simulate(system.model, dopri87(), system.start, time);
            CompiledModel model = system.model.compile();
            Matrix values(time.size(), 2);
            for (Index i = 0; i < time.size(); ++i) {
              const Vector x = solution.states.row(i);
              Vector rate(x.size());
              model.evaluate(time[i], x.data(), nullptr, nullptr, rate.data());
              values.row(i) << x[0], rate[0];
            }
            return values;
          }};
}

Point sine(double t) { return {std::sin(t), std::cos(t)}; }

Point two_tones(double t) {
  return {std::sin(t) + 0.5 * std::cos(2.7 * t), std::cos(t) - 1.35 * std::sin(2.7 * t)};
}

Point chirp(double t) {
  return {std::sin(0.15 * t * t + 0.3 * t), (0.3 * t + 0.3) * std::cos(0.15 * t * t + 0.3 * t)};
}

Point damped(double t) {
  const double decay = std::exp(-0.2 * t);
  return {decay * std::cos(2.0 * t), decay * (-0.2 * std::cos(2.0 * t) - 2.0 * std::sin(2.0 * t))};
}

Point step(double t) {
  const double u = std::tanh(4.0 * (t - 5.0));
  return {u, 4.0 * (1.0 - u * u)};
}

Point pulses(double t) {
  Point sum{0.0, 0.0};
  for (const double centre : {2.0, 5.5, 8.0}) {
    const double u = (t - centre) / 0.35, value = std::exp(-0.5 * u * u);
    sum.first += value;
    sum.second -= u / 0.35 * value;
  }
  return sum;
}

Point triangle(double t) {
  const double phase = std::fmod(t, 2.0);
  return phase < 1.0 ? Point{phase, 1.0} : Point{2.0 - phase, -1.0};
}

Point logistic(double t) {
  const double e = std::exp(-(t - 5.0));
  return {1.0 / (1.0 + e), e / ((1.0 + e) * (1.0 + e))};
}

}  // namespace

const std::vector<Signal>& signals() {
  static const std::vector<Signal> all{formula("sine", 12.0, sine),
                                       formula("two tones", 15.0, two_tones),
                                       formula("chirp", 12.0, chirp),
                                       formula("damped", 15.0, damped),
                                       formula("step", 10.0, step),
                                       formula("pulses", 10.0, pulses),
                                       formula("triangle", 7.0, triangle),
                                       formula("logistic", 10.0, logistic),
                                       orbit("lorenz", 6.0),
                                       orbit("rossler", 40.0),
                                       orbit("chua", 30.0),
                                       orbit("van-der-pol", 25.0)};
  return all;
}

}  // namespace lacuna::benchmarks
