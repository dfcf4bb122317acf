// SPDX-License-Identifier: MIT
#include "options.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <type_traits>
#include <utility>

#include "core/base/text.hpp"

namespace lacuna::cli {
namespace {

/// An end of a range: whole numbers without an exponent.
std::string end_text(double end) {
  constexpr double kLongest = 1e15;  // a fact: whole numbers below are exact in a double
  const bool whole = std::abs(end) < kLongest && end == std::floor(end);
  return whole ? std::to_string(static_cast<long long>(end)) : format_number(end);
}

/// What a target holds, where that is text or a number.
std::string text_in(const Target& target) {
  return std::visit(
      [](const auto& place) -> std::string {
        std::ostringstream text;
        if constexpr (requires { text << *place; }) text << *place;
        return text.str();
      },
      target);
}

}  // namespace

Check from_to(double low, double high) {
  const std::string range = end_text(low) + " to " + end_text(high);
  return {[low, high, range](const std::string& text) {
            const auto value = parse_number(text);
            if (value && *value >= low && *value <= high) return std::string();
            return "'" + text + "' is no number from " + range;
          },
          range};
}

Check finite() {
  return {[](const std::string& text) {
    const auto value = parse_number(text);
    // What is no number at all is refused where it is read.
    if (!value || std::isfinite(*value)) return std::string();
    return "'" + text + "' is no finite number";
  }};
}

Check above_zero() {
  return {[](const std::string& text) {
            const auto value = parse_number(text);
            if (value && *value > 0.0 && std::isfinite(*value)) return std::string();
            return "'" + text + "' is no number above 0";
          },
          "above 0"};
}

Check one_of(std::vector<std::string> words) {
  const std::string shown = join(words, "|");
  return {[words = std::move(words)](const std::string& text) {
            const bool known = std::find(words.begin(), words.end(), text) != words.end();
            return known ? std::string() : none_of(text, words);
          },
          shown};
}

std::string none_of(const std::string& word, const std::vector<std::string>& words) {
  const auto near = nearest_name(word, words);
  return "'" + word + "' is none of " + join(words, ", ") +
         (near ? "; did you mean '" + *near + "'?" : "");
}

Option& Option::check(Check condition) {
  checked = std::move(condition);
  return *this;
}

Option& Option::require() {
  is_required = true;
  return *this;
}

Option& Option::expect_one() {
  is_single = true;
  return *this;
}

Option& Option::exclude(std::string_view other) {
  excluded = other;
  return *this;
}

Option& Option::show_default() {
  default_text = text_in(target);
  return *this;
}

bool Option::is_list() const {
  return !is_single && std::holds_alternative<std::vector<std::string>*>(target);
}

std::vector<std::string> Option::all_names() const { return split_list(names); }

std::string Option::name() const {
  const std::vector<std::string> all = all_names();
  const auto is_long = [](const std::string& one) { return one.starts_with("--"); };
  const auto found = std::find_if(all.begin(), all.end(), is_long);
  return found == all.end() ? all.front() : *found;
}

Option& Command::add(std::string_view usage, Target target, std::string_view help) {
  const std::size_t blank = std::min(usage.find(' '), usage.size());
  const std::string_view form = usage.substr(std::min(blank + 1, usage.size()));
  return options.emplace_back(Option{std::string(usage.substr(0, blank)), std::move(target),
                                     std::string(help), std::string(form)});
}

}  // namespace lacuna::cli
