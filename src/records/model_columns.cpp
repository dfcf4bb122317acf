// SPDX-License-Identifier: MIT
#include "model_columns.hpp"

#include <algorithm>

#include "lacuna/core/error.hpp"

namespace lacuna {
namespace {

/// The state that is dx/dt by an identity of the model.
std::optional<std::string> rate_in_model(const OdeModel& model, const std::string& state) {
  const auto rate = identity_of(model, model.state_index(state));
  if (!rate) return std::nullopt;
  return model.states()[static_cast<std::size_t>(*rate)].name;
}

bool has(const std::vector<DerivativeChain>& chains, const std::string& state) {
  return std::any_of(chains.begin(), chains.end(), [&](const DerivativeChain& chain) {
    return contains(chain.derivatives, state);
  });
}

}  // namespace

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<DerivativeChain> derivative_chains(const OdeModel& model,
                                               const std::vector<std::string>& columns) {
  std::vector<DerivativeChain> chains;
  for (const Quantity& state : model.states()) {
    if (!contains(columns, state.name)) continue;
    DerivativeChain chain{state.name, {}};
    // Two identities may share their rate, and a chain may run into itself.
    const auto is_free = [&](const std::string& rate) {
      return !contains(columns, rate) && !contains(chain.derivatives, rate) &&
             !has(chains, rate);
    };
    auto next = rate_in_model(model, state.name);
    while (next && is_free(*next)) {
      chain.derivatives.push_back(*next);
      next = rate_in_model(model, *next);
    }
    if (!chain.derivatives.empty()) chains.push_back(std::move(chain));
  }
  return chains;
}

void check_columns(const OdeModel& model, const std::vector<std::string>& columns,
                   const std::vector<DerivativeChain>& chains, const std::string& source) {
  for (const Quantity& state : model.states())
    if (!contains(columns, state.name) && !has(chains, state.name))
      throw DataError(source, "there is no column for the state '" + state.name + "'",
                      "name a column so, or define the state in the model as the derivative "
                      "of one that has a column");
  for (const Quantity& input : model.inputs())
    if (!contains(columns, input.name))
      throw DataError(source, "there is no column for the input '" + input.name + "'",
                      "add the column");
}

}  // namespace lacuna
