// SPDX-License-Identifier: MIT
#include "hidden/support/twins.hpp"

#include <string>

#include "core/base/random.hpp"
#include "hidden/support/case_builder.hpp"

namespace lacuna::hidden {
namespace {

/// The numbers of a heated body: its losses, how it is heated, and a store beside it.
struct Body {
  double loss, heating, exchange, pace, fraction;

  explicit Body(Random& random)
      : loss(1.0 / random.uniform(20.0, 60.0)),
        heating(loss * random.uniform(5.0, 15.0)),
        exchange(loss * random.uniform(0.5, 3.0)),
        pace(loss * random.uniform(2.0, 10.0)),
        fraction(random.uniform(0.1, 0.5)) {}
};

SignalSpec heater_steps() {
  return {
      .shape = SignalSpec::Shape::Steps, .mean = 1.0, .size = 0.5, .low = 0.01, .high = 0.1};
}

SignalSpec weather() { return {.mean = 10.0, .size = 5.0, .low = 0.0005, .high = 0.01}; }

/// A body that loses heat to the surroundings Ta and is heated by u, 1 500 minutes.
Plant heated_body(const Body& body, double direct_loss) {
  return {model_of("min", {{"T", "K"}}, {{"u", "kW"}, {"Ta", "K"}},
                   {{{"T", -direct_loss}, {"Ta", direct_loss}, {"u", body.heating}}}),
          Vector{{15.0}},
          Vector{{5.0}},
          1.0,
          1500,
          300.0,
          {heater_steps(), weather()}};
}

/// A pendulum that a propeller pushes, 20 s.
Plant pushed_pendulum(Random& random) {
  const double stiffness = random.uniform(15.0, 40.0), damping = random.uniform(0.3, 1.0);
  return {
      model_of("s", {{"th", "rad"}, {"w", "rad/s"}}, {{"u", "V"}},
               {{{"w", 1.0}},
                {{"sin(th)", -stiffness}, {"w", -damping}, {"u", random.uniform(1.0, 3.0)}}}),
      Vector{{0.0, 0.0}},
      Vector{{0.3, 0.5}},
      0.01,
      2000,
      5.0,
      {{.mean = 2.0, .size = 0.6, .low = 0.1, .high = 1.5}}};
}

/// A slide on a spring, 20 s.
Plant slide(Random& random) {
  return {
      model_of(
          "s", {{"x", "mm"}, {"v", "mm/s"}}, {{"u", "mm/s^2"}},
          {{{"v", 1.0}},
           {{"x", -random.uniform(10.0, 30.0)}, {"v", -random.uniform(0.5, 1.5)}, {"u", 1.0}}}),
      Vector{{0.0, 0.0}},
      Vector{{0.3, 0.5}},
      0.01,
      2000,
      5.0,
      {{.size = 8.0, .low = 0.1, .high = 1.5}}};
}

/// Each coefficient of an equation off by up to 30 %.
void misjudge_all(const Plant& plant, const std::string& state, Random& random,
                  CaseBuilder& builder) {
  const Index k = plant.model.state_index(state);
  for (const WeightedTerm& summand : plant.model.equations()[static_cast<std::size_t>(k)])
    builder.misjudge(state, summand.term.name(), random.uniform(0.7, 1.3));
}

std::string numbered(const std::string& name, std::uint64_t seed) {
  return name + "-" + std::to_string(seed);
}

/// How the store of a wall exchanges heat: with the surroundings too.
Terms rates_of_store(const Body& body, double fraction) {
  return {
      {"T", (1.0 - fraction) * body.pace}, {"Ta", fraction * body.pace}, {"Tw", -body.pace}};
}

HiddenCase body_with_store(const Body& body, bool is_wall, bool hides, Random& random,
                           std::uint64_t seed) {
  const Plant plant = heated_body(body, body.loss);
  CaseBuilder builder(numbered(is_wall ? "twin-wall" : "twin-second-store", seed),
                      "A heated body beside a store that nobody measures", plant);
  if (hides)
    builder.hidden_states({{"Tw", rates_of_store(body, is_wall ? body.fraction : 0.0)}})
        .hide({"T", {"extra-state"}, {}, "Tw-T", body.exchange});
  misjudge_all(plant, "T", random, builder);
  builder.start(hides ? Vector{{15.0, 12.0}} : Vector{{15.0}},
                hides ? Vector{{5.0, 5.0}} : Vector{{5.0}});
  return builder.build();
}

HiddenCase pendulum_with_thrust(bool hides, Random& random, std::uint64_t seed) {
  const Plant plant = pushed_pendulum(random);
  const double pace = 1.0 / random.uniform(0.05, 0.3);
  const double thrust = plant.model.coefficient(1, "u");
  CaseBuilder builder(numbered("twin-lagged-thrust", seed),
                      "A pendulum pushed by a propeller whose thrust follows u^2 late", plant);
  if (hides)
    builder.hidden_states({{"F", {{"u^2", pace}, {"F", -pace}}}})
        .hide({"w", {"extra-state", "lag"}, {}, "F-u", thrust});
  misjudge_all(plant, "w", random, builder);
  return builder.build();
}

HiddenCase slide_with_friction(bool hides, Random& random, std::uint64_t seed) {
  const Plant plant = slide(random);
  CaseBuilder builder(numbered("twin-lattice-friction", seed),
                      "A slide with dry friction behind a coarse encoder", plant);
  if (hides)
    builder.hide({"v", {"coulomb-friction"}, {}, "sign(v)", -random.uniform(1.0, 3.0)},
                 "tanh(v/0.01)");
  misjudge_all(plant, "v", random, builder);
  return builder.noise(NoiseKind::Quantised).build();
}

HiddenCase made(Twin kind, bool hides, std::uint64_t seed) {
  Random random(seed);
  switch (kind) {
    case Twin::SecondStore:
    case Twin::Wall: {
      const Body body(random);
      return body_with_store(body, kind == Twin::Wall, hides, random, seed);
    }
    case Twin::LaggedThrust:
      return pendulum_with_thrust(hides, random, seed);
    case Twin::LatticeFriction:
      break;
  }
  return slide_with_friction(hides, random, seed);
}

}  // namespace

std::vector<Twin> all_twins() {
  return {Twin::SecondStore, Twin::Wall, Twin::LaggedThrust, Twin::LatticeFriction};
}

HiddenCase twin(Twin kind, std::uint64_t seed) { return made(kind, true, seed); }

HiddenCase complete_twin(Twin kind, std::uint64_t seed) { return made(kind, false, seed); }

}  // namespace lacuna::hidden
