// SPDX-License-Identifier: MIT
#include "data/units/units.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "core/base/text.hpp"

namespace lacuna {
namespace {

constexpr double kPi = std::numbers::pi;

/// A symbol of the table; some take prefixes.
struct Symbol {
  std::string_view names;  ///< with blanks around each
  double factor;
  Dimension dimension;
  bool takes_prefixes;
  double offset = 0.0;
};

// Sources: SI brochure, 9th edition, tables 2, 4 and 8; NIST SP 811, appendix B (inch, foot,
// psi, mmHg). "C" is left out: people write it for the coulomb and for degrees.
const std::vector<Symbol>& symbols() {
  static const std::vector<Symbol> table{
      {" m ", 1.0, {1}, true},
      {" g ", 1e-3, {0, 1}, true},
      {" s sec secs second seconds ", 1.0, {0, 0, 1}, true},
      {" A ", 1.0, {0, 0, 0, 1}, true},
      {" K ", 1.0, {0, 0, 0, 0, 1}, true},
      {" mol ", 1.0, {0, 0, 0, 0, 0, 1}, true},
      {" cd ", 1.0, {0, 0, 0, 0, 0, 0, 1}, true},
      {" rad ", 1.0, {0, 0, 0, 0, 0, 0, 0, 1}, true},
      {" 1 ", 1.0, {}, false},
      {" % percent ", 1e-2, {}, false},
      {" ppm ", 1e-6, {}, false},
      {" deg \u00b0 degree degrees ", kPi / 180.0, {0, 0, 0, 0, 0, 0, 0, 1}, false},
      {" rev turn turns ", 2.0 * kPi, {0, 0, 0, 0, 0, 0, 0, 1}, false},
      {" rpm RPM r/min U/min rev/min ", kPi / 30.0, {0, 0, -1, 0, 0, 0, 0, 1}, false},
      {" Hz ", 1.0, {0, 0, -1}, true},
      {" min mins minute minutes ", 60.0, {0, 0, 1}, false},
      {" h hr hrs hour hours ", 3600.0, {0, 0, 1}, false},
      {" d day days ", 86400.0, {0, 0, 1}, false},
      {" N ", 1.0, {1, 1, -2}, true},
      {" Nm ", 1.0, {2, 1, -2}, true},
      {" Pa ", 1.0, {-1, 1, -2}, true},
      {" bar ", 1e5, {-1, 1, -2}, true},
      {" atm ", 101325.0, {-1, 1, -2}, false},
      {" psi ", 6894.757293168361, {-1, 1, -2}, false},
      {" mmHg ", 133.322387415, {-1, 1, -2}, false},
      {" J ", 1.0, {2, 1, -2}, true},
      {" W ", 1.0, {2, 1, -3}, true},
      {" Wh ", 3600.0, {2, 1, -2}, true},
      {" V Volt Volts volt volts ", 1.0, {2, 1, -3, -1}, true},
      {" Ah ", 3600.0, {0, 0, 1, 1}, true},
      {" Ohm ohm \u03a9 ", 1.0, {2, 1, -3, -2}, true},
      {" F ", 1.0, {-2, -1, 4, 2}, true},
      {" H ", 1.0, {2, 1, -2, -2}, true},
      {" T ", 1.0, {0, 1, -2, -1}, true},
      {" Wb ", 1.0, {2, 1, -2, -1}, true},
      {" S ", 1.0, {-2, -1, 3, 2}, true},
      {" l L ", 1e-3, {3}, true},
      {" M ", 1e3, {-3, 0, 0, 0, 0, 1}, true},
      {" in inch ", 0.0254, {1}, false},
      {" ft ", 0.3048, {1}, false},
      {" degC \u00b0C ", 1.0, {0, 0, 0, 0, 1}, false, 273.15},
      {" degF \u00b0F ", 5.0 / 9.0, {0, 0, 0, 0, 1}, false, 459.67 * 5.0 / 9.0}};
  return table;
}

/// SI prefixes; the micro sign and the Greek letter are one.
constexpr std::array<std::pair<std::string_view, double>, 14> kPrefixes{{{"p", 1e-12},
                                                                         {"n", 1e-9},
                                                                         {"u", 1e-6},
                                                                         {"\u00b5", 1e-6},
                                                                         {"\u03bc", 1e-6},
                                                                         {"m", 1e-3},
                                                                         {"c", 1e-2},
                                                                         {"d", 1e-1},
                                                                         {"h", 1e2},
                                                                         {"k", 1e3},
                                                                         {"M", 1e6},
                                                                         {"G", 1e9},
                                                                         {"T", 1e12},
                                                                         {"f", 1e-15}}};

const Symbol* symbol_called(std::string_view name) {
  const std::string framed = " " + std::string(name) + " ";
  for (const Symbol& symbol : symbols())
    if (symbol.names.find(framed) != std::string_view::npos) return &symbol;
  return nullptr;
}

/// A symbol by itself, before one with a prefix: "min" is no milli-inch, "cd" no centi-day.
std::optional<Unit> unit_of_symbol(std::string_view name) {
  if (name.empty() || name.find(' ') != std::string_view::npos) return std::nullopt;
  if (const Symbol* symbol = symbol_called(name))
    return Unit{symbol->factor, symbol->offset, symbol->dimension};
  for (const auto& [prefix, size] : kPrefixes) {
    if (!name.starts_with(prefix)) continue;
    const Symbol* symbol = symbol_called(name.substr(prefix.size()));
    if (symbol != nullptr && symbol->takes_prefixes)
      return Unit{size * symbol->factor, 0.0, symbol->dimension};
  }
  return std::nullopt;
}

/// Signs of powers that stand higher, as plain ones: U+00B2 and its like.
std::string with_plain_powers(std::string_view text) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kSigns{
      {{"\u00b2", "2"}, {"\u00b3", "3"}, {"\u00b9", "1"}, {"\u207b", "-"}, {"\u2074", "4"},
       {"\u00b7", "*"}}};
  std::string plain(text);
  for (const auto& [sign, replacement] : kSigns)
    for (std::size_t at = plain.find(sign); at != std::string::npos; at = plain.find(sign))
      plain.replace(at, sign.size(), replacement);
  return plain;
}

/// Where the power of a factor such as "s^-2", "s-2", "s2" begins; its size where it has none.
std::size_t begin_of_power(std::string_view factor) {
  std::size_t begin = factor.size();
  while (begin > 0 && factor[begin - 1] >= '0' && factor[begin - 1] <= '9') --begin;
  if (begin == factor.size()) return begin;
  if (begin > 0 && (factor[begin - 1] == '-' || factor[begin - 1] == '+')) --begin;
  return begin;
}

/// A symbol with its power; an offset has a meaning only where it stands alone.
std::optional<Unit> unit_of_factor(std::string_view factor) {
  constexpr int kLargestPower = 9;  // beyond those of any unit
  if (auto unit = unit_of_symbol(factor)) return unit;
  const std::size_t begin = begin_of_power(factor);
  std::string_view digits = factor.substr(begin), name = factor.substr(0, begin);
  if (digits.starts_with('+')) digits.remove_prefix(1);
  if (name.ends_with('^')) name.remove_suffix(1);
  int power = 0;
  const auto [stop, error] =
      std::from_chars(digits.data(), digits.data() + digits.size(), power);
  if (error != std::errc() || std::abs(power) > kLargestPower) return std::nullopt;
  auto unit = unit_of_symbol(name);
  if (!unit) return std::nullopt;
  Unit result{std::pow(unit->factor, power), 0.0, unit->dimension};
  for (int& exponent : result.dimension) exponent *= power;
  return result;
}

/// The factors of a product and the signs between them: '*', '/' or ' '.
struct Product {
  std::vector<std::string_view> factors;
  std::vector<char> signs;  ///< in front of each; '*' for the first one
};

Product product_of(std::string_view text) {
  Product product;
  char sign = '*';
  while (true) {
    const std::size_t end = std::min(text.find_first_of("*/. "), text.size());
    product.factors.push_back(text.substr(0, end));  // empty behind a sign at the end
    product.signs.push_back(sign);
    if (end == text.size()) return product;
    sign = text[end] == '.' ? '*' : text[end];
    text.remove_prefix(end + 1);
    while (text.starts_with(' ')) text.remove_prefix(1);
    if (sign != ' ' || text.empty() || (text[0] != '*' && text[0] != '/')) continue;
    sign = text[0];
    text = trim(text.substr(1));
  }
}

}  // namespace

std::optional<Unit> read_unit(std::string_view text) {
  const std::string plain = with_plain_powers(trim(text));
  if (auto unit = unit_of_symbol(plain)) return unit;
  const Product product = product_of(plain);
  Unit result;
  bool divided = false;
  for (std::size_t i = 0; i < product.factors.size(); ++i) {
    const auto unit = unit_of_factor(product.factors[i]);
    if (!unit || (divided && product.signs[i] == ' ')) return std::nullopt;
    divided = divided || product.signs[i] == '/';
    const int power = product.signs[i] == '/' ? -1 : 1;
    result.factor *= power > 0 ? unit->factor : 1.0 / unit->factor;
    for (std::size_t d = 0; d < result.dimension.size(); ++d)
      result.dimension[d] += power * unit->dimension[d];
  }
  return result;
}

std::optional<UnitConversion> conversion(std::string_view from, std::string_view to) {
  if (trim(from) == trim(to) && !trim(from).empty()) return UnitConversion{};
  const auto a = read_unit(from), b = read_unit(to);
  if (!a || !b || a->dimension != b->dimension) return std::nullopt;
  UnitConversion found{a->factor / b->factor, (a->offset - b->offset) / b->factor};
  // Quotients of powers of ten are off by a rounding.
  const double round = std::pow(10.0, std::round(std::log10(found.factor)));
  if (std::abs(found.factor / round - 1.0) < 1e-12) found.factor = round;
  return found;
}

std::string describe(const UnitConversion& conversion) {
  constexpr int kDigits = 7;  // for people
  std::string text = "factor " + format_number(conversion.factor, kDigits);
  if (conversion.offset != 0.0) text += ", offset " + format_number(conversion.offset, kDigits);
  return text;
}

}  // namespace lacuna
