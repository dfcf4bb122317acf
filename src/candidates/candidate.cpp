// SPDX-License-Identifier: MIT
#include "lacuna/candidates/candidate.hpp"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "lacuna/core/error.hpp"
#include "lacuna/core/names.hpp"
#include "lacuna/core/text.hpp"

namespace lacuna {
namespace {

bool is_word_character(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.';
}

/// The text of a number as a factor: in parentheses, so that a sign binds to it.
std::string literal(double value) {
  std::string text(1, '(');
  return text.append(format_number(value)).append(")");
}

/// The text with every word replaced by what `replace(word)` gives.
template <class Replace>
std::string replace_words(const std::string& text, Replace replace) {
  std::string result;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i;
    while (end < text.size() && is_word_character(text[end])) ++end;
    if (end == i) {
      result.push_back(text[i++]);
      continue;
    }
    result.append(replace(text.substr(i, end - i)));
    i = end;
  }
  return result;
}

void rename(Candidate& candidate, const std::string& old, const std::string& name) {
  const auto replace = [&](const std::string& word) { return word == old ? name : word; };
  candidate.form = replace_words(candidate.form, replace);
  for (MemoryState& memory : candidate.memory) {
    memory.name = replace(memory.name);
    memory.rate = replace_words(memory.rate, replace);
    memory.start = replace_words(memory.start, replace);
  }
}

}  // namespace

bool Candidate::is_driven() const {
  return std::any_of(memory.begin(), memory.end(),
                     [](const MemoryState& state) { return state.driven; });
}

Expression bind_formula(const Candidate& candidate, const std::string& text,
                        std::span<const double> values) {
  if (values.size() != candidate.shapes.size())
    throw ArgumentError("effect " + candidate.effect,
                        std::to_string(values.size()) + " values for " +
                            std::to_string(candidate.shapes.size()) + " shape parameters",
                        "give one value for each");
  return parse_expression(replace_words(text, [&](const std::string& word) {
    for (std::size_t i = 0; i < candidate.shapes.size(); ++i)
      if (candidate.shapes[i].name == word) return literal(values[i]);
    return word;
  }));
}

Expression bind_form(const Candidate& candidate, std::span<const double> values) {
  return bind_formula(candidate, candidate.form, values);
}

Candidate without_clash(Candidate candidate, const std::vector<std::string>& taken) {
  const auto is_taken = [&](const std::string& name) {
    return std::find(taken.begin(), taken.end(), name) != taken.end();
  };
  for (std::size_t i = 0; i < candidate.memory.size(); ++i) {
    const std::string old = candidate.memory[i].name;
    std::string name = old;
    for (int number = 2; is_taken(name); ++number) name = old + std::to_string(number);
    if (name != old) rename(candidate, old, name);
  }
  return candidate;
}

}  // namespace lacuna
