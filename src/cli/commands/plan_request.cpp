// SPDX-License-Identifier: MIT
#include "plan_request.hpp"

#include <cmath>
#include <limits>

#include "core/base/text.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna::cli {
namespace {

/// NAME=REST of an option.
struct NamedText {
  std::string place, name, rest;
};

NamedText named_text(const std::string& option, const std::string& text, const char* example) {
  const std::size_t equals = text.find('=');
  NamedText named{option + " " + text, std::string(trim(text.substr(0, equals))), ""};
  if (equals == std::string::npos || named.name.empty())
    throw ConfigError(named.place, "it has not the form NAME=...",
                      "write e.g. " + option + " " + example);
  named.rest = std::string(trim(std::string_view(text).substr(equals + 1)));
  return named;
}

double number_in(const NamedText& named, std::string_view text, const char* example) {
  const auto number = parse_number(trim(text));
  if (!number || !std::isfinite(*number))
    throw ConfigError(named.place, "'" + std::string(trim(text)) + "' is no finite number",
                      std::string("write e.g. ") + example);
  return *number;
}

/// By definition: a range without an end.
constexpr double kOpenEnd = std::numeric_limits<double>::infinity();

/// LOW..HIGH; a missing end is infinite where that may be.
struct InputRange {
  double low, high;
};

std::optional<InputRange> range_in(const NamedText& named, std::string_view text, bool open,
                              const char* example) {
  const std::size_t dots = text.find("..");
  if (dots == std::string_view::npos) return std::nullopt;
  const std::string_view low = trim(text.substr(0, dots)), high = trim(text.substr(dots + 2));
  return InputRange{open && low.empty() ? -kOpenEnd : number_in(named, low, example),
               open && high.empty() ? kOpenEnd : number_in(named, high, example)};
}

constexpr const char* kInputExample =
    "\"u=-5..5, rate 100, hold 0.01, family steps|prbs, pieces 8\"";

std::vector<InputFamily> families_in(const NamedText& named, const std::string& text) {
  std::vector<InputFamily> families;
  std::vector<std::string> known;
  for (const InputFamily family : all_input_families()) known.push_back(to_string(family));
  for (const std::string& name : split_list(text, '|')) {
    const auto family = input_family_named(name);
    if (!family)
      throw ConfigError(named.place, "there is no family '" + name + "'",
                        suggestion(name, known));
    families.push_back(*family);
  }
  return families;
}

/// "rate 100" and the like.
void read_input_limit(const NamedText& named, const std::string& text, PlanInput& input) {
  const std::size_t blank = text.find(' ');
  const std::string word = text.substr(0, blank);
  const std::string value =
      blank == std::string::npos ? "" : std::string(trim(text.substr(blank)));
  if (word == "rate") {
    input.rate = number_in(named, value, kInputExample);
  } else if (word == "hold") {
    input.hold = number_in(named, value, kInputExample);
  } else if (word == "pieces") {
    constexpr double kMost = 200.0;  // a fact of cost: the search has no derivatives
    const double pieces = number_in(named, value, kInputExample);
    if (pieces != std::floor(pieces) || pieces < 1.0 || pieces > kMost)
      throw ConfigError(named.place, "'" + value + "' is no whole number from 1 to 200",
                        std::string("write e.g. ") + kInputExample);
    input.pieces = static_cast<int>(pieces);
  } else if (word == "family") {
    input.families = families_in(named, value);
  } else {
    throw ConfigError(named.place, "'" + word + "' is not known",
                      suggestion(word, std::vector<std::string>{"rate", "hold", "pieces",
                                                                "family"}));
  }
}

}  // namespace

PlanInput plan_input(const std::string& text) {
  const NamedText named = named_text("--input", text, kInputExample);
  const std::vector<std::string> parts = split_list(named.rest);
  const auto range =
      range_in(named, parts.empty() ? std::string() : parts.front(), false, kInputExample);
  if (!range)
    throw ConfigError(named.place, "it does not begin with a range LOW..HIGH",
                      std::string("write e.g. --input ") + kInputExample);
  PlanInput input{named.name, range->low, range->high};
  for (std::size_t i = 1; i < parts.size(); ++i) read_input_limit(named, parts[i], input);
  return input;
}

PlanChannel plan_channel(const std::string& text) {
  const NamedText named = named_text("--measure", text, "y=0.02");
  return {named.name, number_in(named, named.rest, "--measure y=0.02")};
}

PlanStart plan_start(const std::string& text) {
  constexpr const char* kExample = "x=0..1, x=0.5 or \"x=0 +- 0.1\"";
  const NamedText named = named_text("--start", text, kExample);
  if (const auto range = range_in(named, named.rest, false, kExample))
    return {named.name, range->low, range->high, 0.0};
  const std::size_t sign = named.rest.find("+-");
  const double value = number_in(named, named.rest.substr(0, sign), kExample);
  const double deviation =
      sign == std::string::npos ? 0.0
                                : number_in(named, named.rest.substr(sign + 2), kExample);
  return {named.name, value, value, deviation};
}

SafeRange safe_range(const std::string& text) {
  const NamedText named = named_text("--safe", text, "x=-2..2");
  const auto range = range_in(named, named.rest, true, "--safe x=-2..2");
  if (!range)
    throw ConfigError(named.place, "it is no range LOW..HIGH", "write e.g. --safe x=-2..2");
  return {named.name, range->low, range->high};
}

}  // namespace lacuna::cli
