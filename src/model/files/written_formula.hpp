// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "lacuna/core/base/error.hpp"
#include "model/expressions/formula_error.hpp"

namespace lacuna {

/// A formula of a text before all names are known.
struct WrittenFormula {
  std::string_view formula;
  std::string place;  ///< of the formula, "m.ode:3:11"
};

/// "m.ode:3" and the column of a formula's place, moved by a column inside the formula.
inline std::string moved_place(const std::string& place, std::size_t column) {
  const std::size_t colon = place.rfind(':');
  return place.substr(0, colon + 1) +
         std::to_string(std::stoul(place.substr(colon + 1)) + column - 1);
}

/// What `parse` makes of a formula; its errors say where in the text.
template <class Parse>
auto read_formula(const WrittenFormula& written, const Parse& parse) {
  const auto& [text, place] = written;
  try {
    return parse(text);
  } catch (const FormulaError& error) {
    throw ModelError(moved_place(place, error.column()), error.problem(), error.remedy());
  } catch (const ModelError& error) {
    throw ModelError(place, error.problem(), error.remedy());
  }
}

}  // namespace lacuna
