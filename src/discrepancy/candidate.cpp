// SPDX-License-Identifier: MIT
#include "lacuna/discrepancy/candidate.hpp"

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

/// The word, or the number that stands in its place.
std::string replacement(const Candidate& candidate, std::string_view word,
                        std::span<const double> values) {
  for (std::size_t i = 0; i < candidate.shapes.size(); ++i)
    if (candidate.shapes[i].name == word) return literal(values[i]);
  return std::string(word);
}

}  // namespace

Expression bind_formula(const Candidate& candidate, const std::string& text,
                        std::span<const double> values) {
  if (values.size() != candidate.shapes.size())
    throw ArgumentError("effect " + candidate.effect,
                        std::to_string(values.size()) + " values for " +
                            std::to_string(candidate.shapes.size()) + " shape parameters",
                        "give one value for each");
  std::string bound;
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i;
    while (end < text.size() && is_word_character(text[end])) ++end;
    if (end == i) {
      bound.push_back(text[i++]);
      continue;
    }
    bound.append(replacement(candidate, std::string_view(text).substr(i, end - i), values));
    i = end;
  }
  return parse_expression(bound);
}

Expression bind_form(const Candidate& candidate, std::span<const double> values) {
  return bind_formula(candidate, candidate.form, values);
}

}  // namespace lacuna
