// SPDX-License-Identifier: MIT
#include "time_names.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>
#include <vector>

#include "data/records/text_field.hpp"

namespace lacuna {
namespace {

struct UnitWords {
  std::string_view symbol;
  std::string_view words;  ///< with blanks around each
};

/// The symbol stands first.
constexpr std::array<UnitWords, 7> kUnitWords{
    {{"s", " s sec secs second seconds sekunde sekunden "},
     {"ms", " ms msec msecs millis millisec millisecs millisecond milliseconds "},
     {"us",
      " us \u00b5s \u03bcs usec usecs micros microsec microsecs microsecond microseconds "},
     {"ns", " ns nsec nsecs nanos nanosec nanosecs nanosecond nanoseconds "},
     {"min", " min mins minute minutes minuten "},
     {"h", " h hr hrs hour hours stunde stunden "},
     {"d", " d day days tag tage "}}};

std::optional<std::string> symbol_of_word(std::string_view word) {
  const std::string framed = " " + std::string(word) + " ";
  for (const UnitWords& unit : kUnitWords)
    if (unit.words.find(framed) != std::string_view::npos) return std::string(unit.symbol);
  return std::nullopt;
}

bool is_lower(char c) { return std::islower(static_cast<unsigned char>(c)) != 0; }
bool is_upper(char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; }

/// Words of a name in lower case: "Time in ms", "time_ms", "timeMs" are ["time", ..., "ms"].
std::vector<std::string> words_of(std::string_view name) {
  constexpr std::string_view kBetween = " \t_-,;:./()[]";
  std::vector<std::string> words(1);
  for (std::size_t i = 0; i < name.size(); ++i) {
    const bool between = kBetween.find(name[i]) != std::string_view::npos;
    const bool hump = i > 0 && is_lower(name[i - 1]) && is_upper(name[i]);
    if ((between || hump) && !words.back().empty()) words.emplace_back();
    if (!between) words.back() += lower_case(name.substr(i, 1));
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

bool means_time(std::string_view word) {
  constexpr std::array<std::string_view, 9> kWords{
      "t", "time", "times", "timestamp", "stamp", "zeit", "elapsed", "uptime", "clock"};
  return std::find(kWords.begin(), kWords.end(), word) != kWords.end();
}

/// "min" is a least value and "m" a length elsewhere; after t alone they may be that here too.
bool has_other_meanings(std::string_view word) { return word.size() == 1 || word == "min"; }

}  // namespace

std::optional<std::string> time_unit_symbol(std::string_view text) {
  text = strip(text);
  const bool bracketed = text.size() > 2 && ((text.front() == '(' && text.back() == ')') ||
                                             (text.front() == '[' && text.back() == ']'));
  if (bracketed) text = strip(text.substr(1, text.size() - 2));
  return symbol_of_word(lower_case(text));
}

bool names_time(std::string_view name) {
  const std::vector<std::string> words = words_of(name);
  return std::any_of(words.begin(), words.end(), means_time);
}

std::optional<UnitInName> unit_in_name(std::string_view name) {
  std::vector<std::string> words = words_of(name);
  if (words.empty()) return std::nullopt;
  const std::string last = std::exchange(words.back(), {});
  words.pop_back();
  if (last == "m" && !words.empty() && means_time(words.front()))
    return UnitInName{"min", false, false};
  const auto symbol = symbol_of_word(last);
  if (!symbol) return std::nullopt;
  const bool timed = std::any_of(words.begin(), words.end(), means_time);
  const bool long_word = timed && words.front() != "t";
  const bool certain = !has_other_meanings(last) || long_word || (timed && last == "s");
  std::erase(words, "in");
  return UnitInName{*symbol, certain, words.size() == 1 && words.front() == "time"};
}

}  // namespace lacuna
