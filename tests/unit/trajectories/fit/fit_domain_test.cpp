// SPDX-License-Identifier: MIT
// Models with roots and powers whose argument comes to 0, and runs that would go beyond.
#include "trajectories/fit/fit_domain.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>

#include "core/base/random.hpp"
#include "data/derivatives/finite_differences.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/records/binding/model_view.hpp"
#include "lacuna/trajectories/fit/fit.hpp"
#include "support/expect_error.hpp"
#include "support/one_record.hpp"

namespace lacuna {
namespace {

using State = std::array<double, 2>;

/// Two states by so many Euler steps in a sample that they are exact beside the noise; what
/// would be below 0 is 0. The input is off in every other interval.
struct Emptied {
  std::function<State(const State&, double)> rates;
  std::function<double(const State&)> seen;
  State start;
  double step = 0.5, noise = 0.01;
  Index samples = 500, period = 35;
  bool begins_off = false;
};

Dataset record_of(const Emptied& plant, std::uint64_t seed) {
  constexpr int kParts = 4000;
  Random random(seed);
  Trajectory record;
  record.time = Vector::LinSpaced(plant.samples, 0.0,
                                  plant.step * static_cast<double>(plant.samples - 1));
  record.states.resize(plant.samples, 1);
  record.inputs.resize(plant.samples, 1);
  State x = plant.start;
  for (Index n = 0; n < plant.samples; ++n) {
    const bool is_on = (n / plant.period) % 2 == (plant.begins_off ? 1 : 0);
    record.inputs(n, 0) = is_on ? 0.6 + 0.2 * static_cast<double>(n / plant.period % 4) : 0.0;
    record.states(n, 0) = plant.seen(x) + plant.noise * random.normal();
    for (int part = 0; part < kParts; ++part) {
      const State rate = plant.rates(x, record.inputs(n, 0));
      for (std::size_t k = 0; k < 2; ++k)
        x[k] = std::max(0.0, x[k] + plant.step / kParts * rate[k]);
    }
  }
  return support::one_record({{"y", ""}}, {{"u", "", Hold::Zero}}, record);
}

Fit fitted(const std::string& text, const Emptied& plant, std::uint64_t seed) {
  const SystemModel system = parse_ode_system(text, "m.ode");
  return fit(system, model_view(system.model(), record_of(plant, seed), FiniteDifferences{}),
             {});
}

void expect_numbers(const Fit& found, const std::vector<double>& truth) {
  ASSERT_EQ(found.numbers.size(), truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const FittedParameter& one = found.numbers[i];
    ASSERT_TRUE(one.standard_error) << one.name;
    EXPECT_LT(std::abs(one.value - truth[i]), 4.0 * *one.standard_error) << one.name;
    EXPECT_LT(*one.standard_error, 0.05 * truth[i]) << one.name;
  }
  EXPECT_EQ(found.quality[0].residuals, Adequate::Yes);
}

TEST(FitDomain, AHiddenVesselThatEmptiesIntoAFilter) {
  // A hidden level behind an orifice, whose outflow passes a filter that is measured.
  const double k = 0.8, a = 0.5, tau = 4.0;
  const Emptied plant{[=](const State& x, double u) {
                        const double flow = a * std::sqrt(x[0]);
                        return State{k * u - flow, (flow - x[1]) / tau};
                      },
                      [](const State& x) { return x[1]; },
                      {0.7, 0.2},
                      0.5,
                      0.004};
  const std::string text =
      "input u hold zero\nparam k = 1.05 in 0.05..5\nparam a = 0.36 in 0.05..5\n"
      "param tau = 5.4 in 0.5..50\ndh/dt = k*u - a*sqrt(h)\n"
      "dq/dt = (a*sqrt(h) - q)/tau\ny = q\n";
  expect_numbers(fitted(text, plant, 5), {k, a, tau});
}

TEST(FitDomain, ALevelThatIsEmptyUntilSomethingFlowsIn) {
  const double k = 0.7, a = 0.5;
  const Emptied plant{.rates =
                          [=](const State& x, double u) {
                            const double flow = a * std::sqrt(x[0]);
                            return State{k * u - flow, flow - 0.3 * std::sqrt(x[1])};
                          },
                      .seen = [](const State& x) { return x[1]; },
                      .start = {0.0, 0.4},
                      .begins_off = true};
  const std::string text =
      "input u hold zero\nparam k = 0.9 in 0.05..5\nparam a = 0.4 in 0.05..5\n"
      "param b = 0.4 in 0.05..5\ndx/dt = k*u - a*sqrt(x)\n"
      "dz/dt = a*sqrt(x) - b*sqrt(z)\ny = z\n";
  expect_numbers(fitted(text, plant, 9), {k, a, 0.3});
  expect_numbers(fitted(text + "initial x = 0 fixed\n", plant, 9), {k, a, 0.3});
}

TEST(FitDomain, APowerThatIsNoRoot) {
  // A substance that is used up by a law between order 0 and 1; its product is measured.
  const double r = 0.3;
  const Emptied plant{[=](const State& x, double u) {
                        const double used = r * std::pow(x[0], 0.4);
                        return State{u - used, used - 0.2 * x[1]};
                      },
                      [](const State& x) { return x[1]; },
                      {1.0, 0.5},
                      0.4,
                      0.01};
  const std::string text =
      "input u hold zero\nparam r = 0.21 in 0.01..5\nparam l = 0.26 in 0.01..5\n"
      "ds/dt = u - r*s^0.4\ndp/dt = r*s^0.4 - l*p\ny = p\n";
  expect_numbers(fitted(text, plant, 6), {r, 0.2});
}

TEST(FitDomain, AMeasuredRootOfALevelThatIsHidden) {
  const double k = 0.5, a = 0.6;
  const Emptied plant{[=](const State& x, double u) {
                        return State{k * u - a * std::sqrt(x[0]), 0.0};
                      },
                      [=](const State& x) { return a * std::sqrt(x[0]); },
                      {0.5, 0.0}};
  const std::string text =
      "input u hold zero\nparam k = 0.65 in 0.05..5\nparam a = 0.42 in 0.05..5\n"
      "dh/dt = k*u - a*sqrt(h)\ny = a*sqrt(h)\n";
  expect_numbers(fitted(text, plant, 7), {k, a});
}

TEST(FitDomain, ARunThatGoesBeyondItsDomainIsNone) {
  // A pump takes 0.2 from the vessel whatever is in it: there is no run from empty on.
  const Emptied plant{[](const State& x, double u) {
                        return State{u - 0.5 * std::sqrt(x[0]), 0.0};
                      },
                      [](const State& x) { return x[0]; },
                      {0.5, 0.0}};
  const std::string text =
      "input u hold zero\nparam a = 0.5 fixed\nparam q = 0.2 in 0.19..0.21\n"
      "dh/dt = u - q - a*sqrt(h)\nfixed dh/dt: u\ny = h\ninitial h = 0.5 fixed\n";
  testing::expect_error<DataError>([&] { fitted(text, plant, 8); }, "model", "no free run",
                                   "start from other numbers");
}

TEST(FitDomain, StatesHaveTheRangesOfFunctionsOfThemAlone) {
  const SystemModel system = parse_ode_system(
      "param g = 9.8\nparam c = 2\ndx/dt = -sqrt(2*g*x)\ndy/dt = log(3-y) + y^2\n"
      "dz/dt = sqrt(z-c) - sqrt(x-z) + z^0.5\ndv/dt = sqrt(v-2)-asin(v-3)\ndw/dt = -w^3\n",
      "m.ode");
  const StateRanges ranges = state_ranges(system.parametrised());
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(ranges.lower, (Vector{{0.0, -infinity, 0.0, 2.0, -infinity}}));
  EXPECT_EQ(ranges.upper, (Vector{{infinity, 3.0, infinity, 4.0, infinity}}));
}

}  // namespace
}  // namespace lacuna
