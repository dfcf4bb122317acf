// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "lacuna/identify/pipeline/pipeline.hpp"
#include "lacuna/regression/stages/basis.hpp"
#include "lacuna/regression/stages/solvers.hpp"

namespace lacuna {

/// The fate of every candidate of one equation, in library order.
class TrailWriter {
 public:
  TrailWriter(const TermLibrary& library, const std::string& equation) {
    for (const Term& term : library.terms)
      entries_.push_back({.equation = equation, .term = term.name()});
  }

  /// Enters what a stage removed, and by what number.
  void removed(const std::vector<Removal>& removals, const std::string& stage) {
    for (const Removal& removal : removals) {
      TrailEntry& entry = at(removal.term);
      entry.stage = stage;
      entry.quantity = removal.quantity;
      entry.value = removal.value;
      entry.threshold = removal.threshold;
      entry.step = removal.step;
    }
  }

  /// Enters the coefficient of a term that stays.
  void kept(Index term, double coefficient) {
    at(term).kept = true;
    at(term).quantity = "coefficient";
    at(term).value = coefficient;
  }

  /// The entries, which are gone from here then.
  std::vector<TrailEntry> take() { return std::move(entries_); }

 private:
  TrailEntry& at(Index term) { return entries_[static_cast<std::size_t>(term)]; }
  std::vector<TrailEntry> entries_;
};

}  // namespace lacuna
