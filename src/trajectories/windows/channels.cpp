// SPDX-License-Identifier: MIT
#include "channels.hpp"

#include "model/expressions/domain.hpp"

namespace lacuna {
namespace {

/// The formulas as they are outside of their domain.
std::vector<Expression> held(std::vector<Expression> formulas, Outside outside,
                             Expression (*in_domain)(const Expression&)) {
  if (outside == Outside::AsAtTheEdge)
    for (Expression& formula : formulas) formula = in_domain(formula);
  return formulas;
}

}  // namespace

Channels::Channels(const ParametrisedModel& model, const std::vector<Expression>& formulas,
                   Outside outside)
    : values_(held(formulas, outside, held_in_domain), model.symbolic().variables()),
      derivatives_({}, model.symbolic().variables()) {
  std::vector<Expression> entries;
  const std::vector<Expression> sloped = held(formulas, outside, held_off_edges);
  const auto add = [&](std::size_t channel, const std::string& name, Index column,
                       bool is_state) {
    Expression entry = differentiate(sloped[channel], name);
    if (is_number(entry, 0.0)) return;
    entries.push_back(std::move(entry));
    places_.push_back({static_cast<Index>(channel), column, is_state});
  };
  for (std::size_t c = 0; c < formulas.size(); ++c) {
    for (Index k = 0; k < model.symbolic().dimension(); ++k)
      add(c, model.symbolic().states()[static_cast<std::size_t>(k)].name, k, true);
    auto column = static_cast<Index>(model.coefficients().size());
    for (const FreeShape& shape : model.shapes()) add(c, shape.name, column++, false);
  }
  derivatives_ = Program(entries, model.symbolic().variables());
  entries_.resize(entries.size());
}

void Channels::derivatives(const double* slots, Matrix& by_state, Matrix& by_parameter) {
  by_state.setZero();
  by_parameter.setZero();
  derivatives_.evaluate(slots, entries_.data(), workspace_);
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const auto& [channel, column, is_state] = places_[i];
    (is_state ? by_state : by_parameter)(channel, column) = entries_[i];
  }
}

}  // namespace lacuna
