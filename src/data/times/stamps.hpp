// SPDX-License-Identifier: MIT
// Times as they are written, before anything becomes a double.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace lacuna {

/// A number as it is written, in units of 1e-18: whole numbers of 64 bits, with 18 decimals.
__extension__ typedef __int128 Stamp;

inline constexpr Stamp kStampOfOne = 1'000'000'000'000'000'000;

/// The stamp of a whole number of at most 64 bits, with or without a sign.
template <class Whole>
constexpr Stamp stamp_of(Whole number) {
  return kStampOfOne * number;
}

/// Reads a decimal number, with a point or a comma and an exponent; what stands behind the 18th
/// decimal is rounded. Nothing for any other text and for numbers of more than 64 bits.
std::optional<Stamp> read_stamp(std::string_view text);

/// Its digits: "1700000000.000001".
std::string stamp_text(Stamp stamp);

/// The nearest double.
double value_of(Stamp stamp);

/// The nearest stamp of a double below 2^64.
Stamp nearest_stamp(double value);

/// What the last digit of a stamp that is not zero counts: 1e-6 for 1.500001, 100 for 1700.
Stamp last_digit(Stamp stamp);

/// The stamp from which times have to be counted, the first one, because doubles do not hold
/// them: whole numbers above 2^53, digits that are lost, or rounding by more than a millionth
/// of the smallest step. Nothing where they do.
std::optional<Stamp> origin_of(std::span<const Stamp> times);

}  // namespace lacuna
