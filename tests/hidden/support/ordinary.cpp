// SPDX-License-Identifier: MIT
#include "hidden/support/ordinary.hpp"

#include <algorithm>
#include <cmath>

namespace lacuna::hidden {
namespace {

bool is_of_input(Ordinary ordinary) { return ordinary < Ordinary::Clipped; }

NoiseKind noise_of(Ordinary ordinary) {
  switch (ordinary) {
    case Ordinary::Clipped:
      return NoiseKind::Clipped;
    case Ordinary::Quantised:
      return NoiseKind::Quantised;
    case Ordinary::Dropouts:
      return NoiseKind::Dropouts;
    case Ordinary::SlowChannel:
      return NoiseKind::Slow;
    default:
      return NoiseKind::White;
  }
}

/// A drive of the same size and about the same band.
SignalSpec made(SignalSpec spec, double step, Ordinary ordinary) {
  using Shape = SignalSpec::Shape;
  spec.step = step;
  // Levels change twice in a period of the highest frequency.
  const auto half_period =
      std::max<Index>(2, static_cast<Index>(std::lround(0.5 / (spec.high * step))));
  switch (ordinary) {
    case Ordinary::HeldInput:
    case Ordinary::SlowlyHeld:
      spec.shape = Shape::Held;
      spec.held = ordinary == Ordinary::HeldInput ? 1 : 5;
      break;
    case Ordinary::TwoLevelInput:
      spec.shape = Shape::TwoLevel;
      spec.held = half_period;
      break;
    default:
      spec.shape = Shape::Switched;
      spec.low = 0.25 / (static_cast<double>(half_period) * step);
      spec.high = 1.0 / (static_cast<double>(half_period) * step);
  }
  return spec;
}

}  // namespace

std::string to_string(Ordinary ordinary) {
  switch (ordinary) {
    case Ordinary::HeldInput:
      return "held-input";
    case Ordinary::SlowlyHeld:
      return "slowly-held";
    case Ordinary::TwoLevelInput:
      return "two-level-input";
    case Ordinary::SwitchedInput:
      return "switched-input";
    case Ordinary::Clipped:
      return "clipped";
    case Ordinary::Quantised:
      return "quantised";
    case Ordinary::Dropouts:
      return "dropouts";
    case Ordinary::SlowChannel:
      break;
  }
  return "slow-channel";
}

bool can_be(const HiddenCase& hidden, Ordinary ordinary) {
  if (is_of_input(ordinary)) return !hidden.nominal.inputs().empty();
  return ordinary != Ordinary::SlowChannel || hidden.nominal.dimension() > 1;
}

HiddenCase made(HiddenCase hidden, Ordinary ordinary) {
  if (is_of_input(ordinary)) {
    // Inputs that are not recorded stand behind those that are, and stay as they are.
    for (std::size_t j = 0; j < hidden.nominal.inputs().size(); ++j)
      hidden.system.drives[j] = made(hidden.system.drives[j], hidden.system.step, ordinary);
  } else {
    hidden.noise = noise_of(ordinary);
  }
  hidden.name += " " + to_string(ordinary);
  return hidden;
}

std::vector<Ordinary> all_ordinary() {
  return {Ordinary::HeldInput,     Ordinary::SlowlyHeld, Ordinary::TwoLevelInput,
          Ordinary::SwitchedInput, Ordinary::Clipped,    Ordinary::Quantised,
          Ordinary::Dropouts,      Ordinary::SlowChannel};
}

}  // namespace lacuna::hidden
