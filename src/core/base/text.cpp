// SPDX-License-Identifier: MIT
#include "core/base/text.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <system_error>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

using Buffer = std::array<char, 64>;

std::string from_result(const Buffer& buffer, std::to_chars_result result) {
  return {buffer.data(), static_cast<const char*>(result.ptr)};
}

std::string not_finite_text(double value) {
  if (std::isnan(value)) return "nan";
  return value > 0.0 ? "inf" : "-inf";
}

/// From where on a percentage is harder to read than a factor.
bool is_many_times(double fraction) { return std::abs(fraction) >= 10.0; }

bool is_blank(char c) { return c == ' ' || c == '\t'; }

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

/// Number of insertions, deletions, replacements and swaps of neighbours that make a into b
/// (optimal string alignment), letters of either case being the same.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0U : 1U)});
      const bool swapped = i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) &&
                           lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before.swap(last);
    last.swap(row);
  }
  return last[b.size()];
}

/// The decimals that from_chars calls out of range, as strtod reads them: 0 or infinity.
double out_of_range_value(std::string_view digits) {
  return std::strtod(std::string(digits).c_str(), nullptr);
}

}  // namespace

std::string format_number(double value) {
  if (!std::isfinite(value)) return not_finite_text(value);
  Buffer buffer;
  return from_result(buffer,
                     std::to_chars(buffer.data(), buffer.data() + buffer.size(), value));
}

std::string format_number(double value, int significant_digits) {
  if (!std::isfinite(value)) return not_finite_text(value);
  const int digits = std::clamp(significant_digits, 1, 17);
  Buffer buffer;
  return from_result(buffer, std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                           std::chars_format::general, digits));
}

std::string percent(double fraction, std::string_view whole) {
  if (!is_many_times(fraction))
    return format_number(100.0 * fraction, std::abs(fraction) < 0.995 ? 2 : 3) + " %";
  return format_number(fraction, 3) + " times" + (whole.empty() ? "" : " ") +
         std::string(whole);
}

std::string percent_of(double fraction, std::string_view whole) {
  if (is_many_times(fraction)) return percent(fraction, whole);
  return percent(fraction) + " of " + std::string(whole);
}

std::string join(std::span<const std::string> parts, std::string_view separator) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) text += separator;
    text += parts[i];
  }
  return text;
}

std::string padded(std::string text, std::size_t width) {
  constexpr std::size_t kWidest = std::size_t{1} << 32;  // a fact of memory: no line is longer
  if (width > kWidest) throw ArgumentError("padded", "there is no room for so wide a text", "");
  text.resize(std::max(width, text.size()), ' ');
  return text;
}

std::string_view trim(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::vector<std::string> split_list(std::string_view text, char separator) {
  std::vector<std::string> pieces;
  if (trim(text).empty()) return pieces;
  int depth = 0;
  std::size_t begin = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '(') ++depth;
    if (text[i] == ')' && depth > 0) --depth;
    if (text[i] != separator || depth > 0) continue;
    pieces.emplace_back(trim(text.substr(begin, i - begin)));
    begin = i + 1;
  }
  pieces.emplace_back(trim(text.substr(begin)));
  return pieces;
}

std::optional<double> parse_number(std::string_view text) {
  text = trim(text);
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error == std::errc::invalid_argument || stop != end) return std::nullopt;
  return error == std::errc() ? value : out_of_range_value(text);
}

std::optional<std::string> nearest_name(std::string_view name,
                                        std::span<const std::string> known) {
  std::optional<std::string> nearest;
  std::size_t bound = std::max<std::size_t>(1, name.size() / 3) + 1;
  for (const std::string& candidate : known) {
    const std::size_t shorter = std::min(name.size(), candidate.size());
    const std::size_t longer = std::max(name.size(), candidate.size());
    if (longer - shorter >= bound) continue;  // no distance is below that
    const std::size_t distance = edit_distance(name, candidate);
    if (distance >= bound || distance >= longer) continue;
    bound = distance;
    nearest = candidate;
  }
  return nearest;
}

std::string suggestion(std::string_view name, std::span<const std::string> known) {
  if (const auto nearest = nearest_name(name, known)) return "did you mean '" + *nearest + "'?";
  return known.empty() ? "none are known" : "known are: " + join(known, ", ");
}

}  // namespace lacuna
