// SPDX-License-Identifier: MIT
// Effects whose shapes are far from the size of the motion, and amounts that touch zero by
// noise.
#include <algorithm>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "core/base/random.hpp"
#include "integration/program.hpp"
#include "lacuna/core/base/types.hpp"
#include "support/temporary_folder.hpp"

namespace lacuna::testing {
namespace {

using State = Vector;

/// Eight sines between two frequencies.
std::function<double(double)> multisine(double low, double high, double size, double phase) {
  return [=](double t) {
    double sum = 0.0;
    for (int k = 0; k < 8; ++k) {
      const double frequency = low * std::pow(high / low, k / 7.0);
      sum += std::sin(2.0 * std::numbers::pi * frequency * t + phase * (k + 1) * (k + 1));
    }
    return size * sum;
  };
}

/// A bench: dx/dt = rate(u, x), sampled with noise.
struct Bench {
  std::string header;
  std::function<State(double u, const State& x)> rate;
  std::function<double(double t)> input;
  State start;
  double step = 0.01, noise = 0.003;
  int parts = 100;  ///< Runge-Kutta steps of a sample
};

std::string record_of(const Bench& bench, std::uint64_t seed) {
  std::ostringstream out;
  out.precision(10);
  out << bench.header << '\n';
  Random random(seed);
  State x = bench.start;
  const double h = bench.step / bench.parts;
  for (int i = 0; i < 2500; ++i) {
    const double begin = i * bench.step;
    out << begin;
    for (Index k = 0; k < x.size(); ++k) out << ',' << x[k] + bench.noise * random.normal();
    out << ',' << bench.input(begin) << '\n';
    for (int part = 0; part < bench.parts; ++part) {
      const double t = begin + part * h;
      const double u0 = bench.input(t), u1 = bench.input(t + 0.5 * h), u2 = bench.input(t + h);
      const State a = bench.rate(u0, x), b = bench.rate(u1, x + 0.5 * h * a),
                  c = bench.rate(u1, x + 0.5 * h * b), d = bench.rate(u2, x + h * c);
      x += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
    }
  }
  return out.str();
}

nlohmann::json diagnosis_of(const std::string& model, const Bench& find, const Bench& check) {
  const TemporaryFolder place;
  const std::string nominal = place.write("model.json", model);
  const std::string a = place.write("a.csv", record_of(find, 1));
  const std::string b = place.write("b.csv", record_of(check, 2));
  const CommandResult run = run_program_well("diagnose --model " + nominal + " " + a +
                                             " --holdout " + b + " --json -");
  return nlohmann::json::parse(run.out);
}

/// A capacitor behind a resistor and across a diode: dv/dt = 5 (u - v) - 2e-9 (exp(v/0.026) -
/// 1). The voltage swings to -2 V and below, the junction conducts from 0.5 V on.
Bench diode(double phase) {
  return {.header = "t,v,u",
          .rate =
              [](double u, const State& x) {
                return State::Constant(1, 5.0 * (u - x[0]) - 2e-9 * std::expm1(x[0] / 0.026));
              },
          .input = multisine(0.1, 2.0, 0.75, phase),
          .start = State::Zero(1)};
}

TEST(ExtremeShapes, AJunctionIsFoundBesideALargeReverseSwing) {
  const auto json = diagnosis_of(R"({"format": "lacuna.model/1", "time_unit": "s",
      "states": [{"name": "v", "unit": "V"}], "inputs": [{"name": "u", "unit": "V"}],
      "equations": [{"state": "v", "terms": [{"term": "v", "coefficient": -5.0},
        {"term": "u", "coefficient": 5.0}]}]})",
                                 diode(1.3), diode(0.7));
  EXPECT_EQ(json.at("verdict"), "explained");
  ASSERT_EQ(json.at("effects").size(), 1u) << json["effects"];
  EXPECT_EQ(json["effects"][0]["name"], "exponential-conduction");
  for (const auto& [name, value] : json["effects"][0]["parameters"].items())
    EXPECT_NEAR(value.get<double>(), 0.026, 0.0026)
        << name << ": the junction settles within a sample";
}

/// Substrate that is taken up by a saturating rate, and what it makes:
/// dS/dt = u - 0.2 S - 1.5 S/(0.25 + S), dX/dt = 0.9 S - 0.2 X; the feed stands still at times.
Bench uptake(double phase) {
  const auto feed = multisine(0.02, 0.3, 0.45, phase);
  return {.header = "t,S,X,u",
          .rate =
              [](double u, const State& x) {
                State rate(2);
                rate << u - 0.2 * x[0] - 1.5 * x[0] / (0.25 + x[0]), 0.9 * x[0] - 0.2 * x[1];
                return rate;
              },
          .input = [feed](double t) { return std::max(0.0, 0.3 + feed(t)); },
          .start = State::Constant(2, 0.6),
          .step = 0.05,
          .noise = 0.03,
          .parts = 10};
}

TEST(ExtremeShapes, AnAmountThatTouchesZeroByNoiseIsAnAmount) {
  const auto json = diagnosis_of(R"({"format": "lacuna.model/1", "time_unit": "s",
      "states": [{"name": "S"}, {"name": "X"}], "inputs": [{"name": "u"}],
      "equations": [{"state": "S", "terms": [{"term": "u", "coefficient": 1.0},
        {"term": "S", "coefficient": -1.7}]},
       {"state": "X", "terms": [{"term": "S", "coefficient": 0.9},
        {"term": "X", "coefficient": -0.2}]}]})",
                                 uptake(1.3), uptake(0.7));
  EXPECT_EQ(json.at("verdict"), "explained");
  ASSERT_EQ(json.at("effects").size(), 1u) << json["effects"];
  EXPECT_EQ(json["effects"][0]["name"], "saturating-rate");
  EXPECT_EQ(json["effects"][0]["equation"], "S");
  EXPECT_NEAR(json["effects"][0]["coefficient"].get<double>(), -1.5, 0.1);
}

}  // namespace
}  // namespace lacuna::testing
