// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {

/// A summand as text.
struct TextTerm {
  std::string term;
  double coefficient;
};

/// An autonomous or driven model without inputs from text, one list of summands per state.
OdeModel build_model(const std::vector<Quantity>& states,
                     const std::vector<std::vector<TextTerm>>& equations,
                     const std::string& time_unit);

}  // namespace lacuna
