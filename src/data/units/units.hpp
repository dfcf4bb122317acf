// SPDX-License-Identifier: MIT
// Units of measurement and how one becomes another.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace lacuna {

/// Exponents of metre, kilogram, second, ampere, kelvin, mole, candela, radian. The radian is
/// counted, so that hertz and rad/s are different things and nothing is turned into the other
/// by chance.
using Dimension = std::array<int, 8>;

/// A unit by those of the SI: a value v of it is factor * v + offset of them.
struct Unit {
  double factor = 1.0;
  double offset = 0.0;  ///< of temperatures that do not begin at 0 K
  Dimension dimension = {};
};

/// Reads a unit: symbols with SI prefixes ("mV", "kPa", "um"), products with a blank, `*` or a
/// dot, quotients, powers ("m/s^2", "rad s-1", "N m"), "rpm", "degC", "%". Nothing for
/// other text, for the empty one, and where two readings differ ("J/kg K").
std::optional<Unit> read_unit(std::string_view text);

/// What makes a value of one unit one of another: factor * value + offset.
struct UnitConversion {
  double factor = 1.0;
  double offset = 0.0;

  bool changes_nothing() const { return factor == 1.0 && offset == 0.0; }
};

/// Nothing where one is not known or they measure different things.
std::optional<UnitConversion> conversion(std::string_view from, std::string_view to);

/// "factor 0.001", "factor 1, offset 273.15".
std::string describe(const UnitConversion& conversion);

}  // namespace lacuna
