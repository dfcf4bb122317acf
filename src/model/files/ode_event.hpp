// SPDX-License-Identifier: MIT
// Statements of events in text models.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lacuna/core/base/types.hpp"
#include "lacuna/model/equations/ode_model.hpp"
#include "ode_line.hpp"
#include "written_formula.hpp"

namespace lacuna {

/// An event before all names are known.
struct WrittenEvent {
  /// "x += D": the formula on the right is that behind the sign.
  struct WrittenReset {
    std::string state;
    char operation = '=';
    WrittenFormula formula;
  };
  Event times;  ///< without guard and resets
  std::optional<WrittenFormula> larger = {}, smaller = {};
  std::vector<WrittenReset> resets = {};
  std::string place = {};
};

/// The number that a formula is.
using ReadNumber = FunctionRef<double(const WrittenFormula&)>;

/// What follows the word "at", "every" or "when". @throws ModelError for what is none.
WrittenEvent read_event(OdeLine& line, const std::string& word, ReadNumber number);

/// The model with the events. @throws ModelError with place.
OdeModel with_events(const std::vector<WrittenEvent>& written, const OdeModel& model);

/// What follows "noise" behind an output. @throws ModelError for an unknown law or number.
NoiseLaw read_noise(OdeLine& line);

}  // namespace lacuna
