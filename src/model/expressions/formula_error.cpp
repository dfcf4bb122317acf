// SPDX-License-Identifier: MIT
#include "formula_error.hpp"

namespace lacuna {
namespace {

/// The formula for a one-line message: not too long, nothing that breaks the line.
std::string excerpt(std::string_view formula) {
  // For people.
  constexpr std::size_t kLettersShown = 60;
  std::string text(formula.substr(0, kLettersShown));
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  return formula.size() > kLettersShown ? text + "..." : text;
}

}  // namespace

FormulaError::FormulaError(std::string_view formula, std::size_t column,
                           const std::string& problem, const std::string& remedy)
    : ModelError("term '" + excerpt(formula) + "', column " + std::to_string(column), problem,
                 remedy),
      column_(column) {}

}  // namespace lacuna
