// SPDX-License-Identifier: MIT
#include "stamps.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>

#include "core/base/text.hpp"

namespace lacuna {
namespace {

constexpr std::size_t kDecimals = 18;
constexpr Stamp kLargestStamp = kStampOfOne << 64U;
constexpr std::int64_t kLargestExact = std::int64_t{1} << 53U;  // a fact of doubles

Stamp magnitude(Stamp stamp) { return stamp < 0 ? -stamp : stamp; }

bool is_digit_of_stamp(char c) { return c >= '0' && c <= '9'; }

/// Digits in front of an exponent: number x 10^power.
struct Decimal {
  Stamp number = 0;
  int power = 0;
  bool has_digits = false;
};

/// Takes the digits, with a point or a comma among them, off the begin of a text.
Decimal take_digits(std::string_view& text) {
  Decimal decimal;
  bool in_fraction = false;
  while (!text.empty()) {
    const char c = text.front();
    if (!is_digit_of_stamp(c)) {
      if (in_fraction || (c != '.' && c != ',')) break;
      in_fraction = true;
    } else if (decimal.number < kLargestStamp / 10) {
      decimal.number = decimal.number * 10 + (c - '0');
      decimal.power -= in_fraction ? 1 : 0;
      decimal.has_digits = true;
    } else {
      decimal.power += in_fraction ? 0 : 1;  // a digit that does not count any more
    }
    text.remove_prefix(1);
  }
  return decimal;
}

/// The exponent, 0 where there is none; nothing where the text is no exponent.
std::optional<int> exponent_of(std::string_view text) {
  if (text.empty()) return 0;
  if (text.front() != 'e' && text.front() != 'E') return std::nullopt;
  text.remove_prefix(1);
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  int exponent = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), exponent);
  const bool whole = error == std::errc() && stop == text.data() + text.size();
  if (!whole || std::abs(exponent) > 1000) return std::nullopt;
  return exponent;
}

/// number x 10^power, rounded half away from zero; nothing beyond the largest stamp.
std::optional<Stamp> scaled(Stamp number, int power) {
  for (; power > 0 && number != 0; --power) {
    if (number > kLargestStamp / 10) return std::nullopt;
    number *= 10;
  }
  Stamp dropped = 0;
  for (; power < 0 && (number != 0 || dropped != 0); ++power) {
    dropped = number % 10;
    number /= 10;
  }
  number += dropped >= 5 ? 1 : 0;
  if (number >= kLargestStamp) return std::nullopt;
  return number;
}

/// What is lost of a time when it becomes a double.
Stamp lost_of(Stamp time) { return magnitude(time - nearest_stamp(value_of(time))); }

/// Whether digits are lost that are written: more than half of the last one. Doubles that were
/// printed lose nothing, but for the rounding of stamps themselves.
bool loses_digits(Stamp time) {
  if (magnitude(time) > kLargestExact * kStampOfOne) return true;
  return time != 0 && 2 * lost_of(time) > std::max(last_digit(time), Stamp{2});
}

}  // namespace

std::optional<Stamp> read_stamp(std::string_view text) {
  const bool negative = text.starts_with('-');
  if (negative || text.starts_with('+')) text.remove_prefix(1);
  const Decimal decimal = take_digits(text);
  const auto exponent = exponent_of(text);
  if (!decimal.has_digits || !exponent) return std::nullopt;
  const auto stamp =
      scaled(decimal.number, decimal.power + *exponent + static_cast<int>(kDecimals));
  if (!stamp) return std::nullopt;
  return negative ? -*stamp : *stamp;
}

std::string stamp_text(Stamp stamp) {
  std::string digits;  // the last one first
  for (Stamp rest = magnitude(stamp); rest != 0 || digits.size() <= kDecimals; rest /= 10)
    digits += static_cast<char>('0' + static_cast<int>(rest % 10));
  std::reverse(digits.begin(), digits.end());
  digits.insert(digits.size() - kDecimals, 1, '.');
  digits.erase(digits.find_last_not_of('0') + 1);
  if (digits.back() == '.') digits.pop_back();
  return stamp < 0 ? "-" + digits : digits;
}

double value_of(Stamp stamp) {
  constexpr std::int64_t kNano = 1'000'000'000;
  if (stamp % kStampOfOne == 0) return static_cast<double>(stamp / kStampOfOne);
  // A quotient of two whole numbers that doubles hold is rounded once.
  if (stamp % kNano == 0 && magnitude(stamp / kNano) < kLargestExact)
    return static_cast<double>(stamp / kNano) / static_cast<double>(kNano);
  return *parse_number(stamp_text(stamp));
}

Stamp nearest_stamp(double value) {
  constexpr int kDigits = std::numeric_limits<double>::digits, kAllGone = 120;
  int exponent = 0;
  const double fraction = std::frexp(value, &exponent);
  const auto digits = static_cast<std::int64_t>(std::ldexp(fraction, kDigits));
  const Stamp product = kStampOfOne * (digits < 0 ? -digits : digits);
  const int shift = kDigits - exponent;
  if (shift > kAllGone) return 0;
  const Stamp size = shift <= 0 ? product << static_cast<unsigned>(-shift)
                                : (product + (Stamp{1} << static_cast<unsigned>(shift - 1))) >>
                                      static_cast<unsigned>(shift);
  return digits < 0 ? -size : size;
}

Stamp last_digit(Stamp stamp) {
  Stamp unit = 1;
  for (; stamp != 0 && stamp % 10 == 0; stamp /= 10) unit *= 10;
  return unit;
}

std::optional<Stamp> origin_of(std::span<const Stamp> times) {
  constexpr Stamp kPartsOfStep = 1'000'000;  // far below what any sampling clock keeps
  if (times.empty() || times.front() == 0) return std::nullopt;
  if (std::any_of(times.begin(), times.end(), loses_digits)) return times.front();
  Stamp smallest = kLargestStamp, lost = 0;
  for (std::size_t i = 0; i < times.size(); ++i) {
    lost = std::max(lost, lost_of(times[i]));
    if (i > 0 && times[i] > times[i - 1])
      smallest = std::min(smallest, times[i] - times[i - 1]);
  }
  if (lost <= smallest / kPartsOfStep) return std::nullopt;
  return times.front();
}

}  // namespace lacuna
