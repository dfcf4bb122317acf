// SPDX-License-Identifier: MIT
#include <cmath>
#include <numbers>

#include "lacuna/diagnose/hints/hints.hpp"
#include "slip_hints.hpp"

namespace lacuna {
namespace {

bool is_change_of(const OdeModel& model, const CoefficientFactor& change,
                  const EstimatedCoefficient& said) {
  return change.equation == said.equation &&
         model.equations()[static_cast<std::size_t>(change.equation)]
                          [static_cast<std::size_t>(change.summand)]
                              .term.name() == said.term;
}

/// Whether the records determine this factor, and no other near it.
bool is_said(const EstimatedCoefficient& said, double factor, double round_factor) {
  if (!(said.ratio * factor > 0.0)) return false;
  const double size = std::abs(factor) == 1.0 ? std::numbers::ln10 : std::log(std::abs(factor));
  const double tolerance = round_factor * std::abs(size);
  return std::abs(std::log(said.ratio / factor)) <= tolerance &&
         said.deviation <= tolerance * std::abs(said.ratio);
}

}  // namespace

std::optional<Hint> coefficient_hint(const OdeModel& model, const Dataset& data,
                                     const EstimatedCoefficient& said,
                                     const HintOptions& options) {
  for (const Slip& slip : possible_slips(model, data)) {
    const auto change = as_coefficient(model, slip);
    if (!change || !is_change_of(model, *change, said)) continue;
    if (!is_said(said, change->factor, options.round_factor)) continue;
    Hint hint = hint_of(model, {slip, Vector(), Vector()});
    hint.withheld = Withheld::Nothing;
    return hint;
  }
  return std::nullopt;
}

}  // namespace lacuna
