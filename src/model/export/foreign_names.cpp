// SPDX-License-Identifier: MIT
#include "model/export/foreign_names.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <unordered_map>
#include <unordered_set>

namespace lacuna {
namespace {

/// What MATLAB takes and C promises to distinguish.
constexpr std::size_t kLongestName = 63;

bool is_small(char c) { return c >= 'a' && c <= 'z'; }
bool is_capital(char c) { return c >= 'A' && c <= 'Z'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_of_names(char c) { return is_small(c) || is_capital(c) || is_digit(c) || c == '_'; }

bool has_shape(std::string_view name, const NameRules& rules) {
  if (name.empty() || name.size() > kLongestName || is_digit(name.front())) return false;
  if (!std::all_of(name.begin(), name.end(), is_of_names)) return false;
  return rules.underscores ||
         (name.front() != '_' && name.find("__") == std::string_view::npos);
}

/// The name as the language compares it.
std::string compared(std::string name, const NameRules& rules) {
  if (rules.case_blind)
    for (char& c : name)
      if (is_capital(c)) c = static_cast<char>(c - 'A' + 'a');
  return name;
}

bool has_prefix(const std::string& name, const NameRules& rules) {
  const std::string key = compared(name, rules);
  return std::any_of(rules.prefixes.begin(), rules.prefixes.end(),
                     [&](std::string_view prefix) { return key.starts_with(prefix); });
}

bool is_word(const std::string& name, const NameRules& rules) {
  return rules.words.contains(compared(name, rules)) || has_prefix(name, rules);
}

/// "x0a" for a line feed.
std::string numbered_byte(char c) {
  std::array<char, 8> text{};
  std::snprintf(text.data(), text.size(), "x%02x", static_cast<unsigned char>(c));
  return text.data();
}

/// A name of the right shape, with room for a number.
std::string shaped(std::string_view name, const NameRules& rules) {
  // What a number behind a name may take.
  constexpr std::size_t kLettersOfNumber = 12;
  std::string text;
  for (const char c : name.substr(0, kLongestName))
    if (c != '_' || rules.underscores || !text.ends_with('_'))
      text += is_of_names(c) ? std::string(1, c) : numbered_byte(c);
  if (text.empty() || is_digit(text.front()) || (text.front() == '_' && !rules.underscores))
    text = "v" + text;
  if (has_prefix(text, rules)) text = "v_" + text;
  if (text.size() > kLongestName - kLettersOfNumber)
    text.resize(kLongestName - kLettersOfNumber);
  return text;
}

}  // namespace

std::set<std::string, std::less<>> words_of(std::string_view list) {
  std::set<std::string, std::less<>> words;
  for (std::size_t at = 0; at < list.size();) {
    const std::size_t end = std::min(list.find(' ', at), list.size());
    if (end > at) words.emplace(list.substr(at, end - at));
    at = end + 1;
  }
  return words;
}

ForeignNames foreign_names(const std::vector<std::string>& names, const NameRules& rules) {
  ForeignNames foreign;
  std::unordered_set<std::string> taken;
  const auto give = [&](const std::string& name, const std::string& candidate) {
    if (!has_shape(candidate, rules) || is_word(candidate, rules)) return false;
    return taken.insert(compared(candidate, rules)).second &&
           foreign.emplace(name, candidate).second;
  };
  std::vector<std::string> others;
  for (const std::string& name : names)
    if (!give(name, name)) others.push_back(name);
  std::unordered_map<std::string, int> numbers;
  for (const std::string& name : others) {
    if (foreign.contains(name)) continue;
    std::string base = shaped(name, rules);
    if (give(name, base) || give(name, base + "_")) continue;
    while (base.size() > 1 && base.ends_with('_')) base.pop_back();
    int& number = numbers.try_emplace(compared(base, rules), 1).first->second;
    while (!give(name, base + "_" + std::to_string(++number))) continue;
  }
  return foreign;
}

}  // namespace lacuna
