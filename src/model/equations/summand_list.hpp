// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <unordered_map>
#include <utility>

#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {

/// The summands of an equation, each term once, however many there are.
class SummandList {
 public:
  /// Where a summand is: that of an earlier one with the same term, which gets the sum of the
  /// coefficients and no error, or a new one at the end.
  std::size_t add(WeightedTerm summand) {
    const auto [place, is_new] = places_.try_emplace(summand.term.name(), summands_.size());
    if (is_new) {
      summands_.push_back(std::move(summand));
    } else {
      WeightedTerm& same = summands_[place->second];
      same = {.term = same.term,
              .coefficient = same.coefficient + summand.coefficient,
              .fixed = same.fixed && summand.fixed};
    }
    return place->second;
  }

  /// The summands; the list is empty afterwards.
  Equation take() {
    places_.clear();
    return std::exchange(summands_, {});
  }

 private:
  Equation summands_;
  std::unordered_map<std::string, std::size_t> places_;
};

}  // namespace lacuna
