// SPDX-License-Identifier: MIT
#include "model_columns.hpp"

#include <algorithm>

#include "data/records/text_field.hpp"
#include "lacuna/core/base/error.hpp"

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

std::optional<std::string> alias_of(const OdeModel& model, Index state) {
  for (const Output& output : model.outputs())
    if (state_of(model, output) == state) return output.name;
  return std::nullopt;
}

std::vector<Output> formula_outputs(const OdeModel& model) {
  std::vector<Output> found;
  for (const Output& output : model.outputs()) {
    const auto state = state_of(model, output);
    if (!state || alias_of(model, *state) != output.name) found.push_back(output);
  }
  return found;
}

std::vector<std::string> as_states(const OdeModel& model, std::vector<std::string> columns) {
  for (Index k = 0; k < model.dimension(); ++k) {
    const std::string& state = model.states()[static_cast<std::size_t>(k)].name;
    const auto alias = alias_of(model, k);
    if (alias && !contains(columns, state))
      std::replace(columns.begin(), columns.end(), *alias, state);
  }
  return columns;
}

std::vector<Quantity> measured_quantities(const OdeModel& model) {
  std::vector<Quantity> all = model.states();
  for (Index k = 0; k < model.dimension(); ++k)
    if (const auto alias = alias_of(model, k))
      all.push_back({*alias, model.states()[static_cast<std::size_t>(k)].unit});
  for (const Output& output : formula_outputs(model)) all.push_back({output.name, output.unit});
  all.insert(all.end(), model.inputs().begin(), model.inputs().end());
  return all;
}

namespace {

/// "name a column so (--map u=Spannung)", with a column that the model does not know.
std::string map_remedy(const OdeModel& model, const std::string& name,
                       const std::vector<std::string>& columns) {
  const std::vector<Quantity> known = measured_quantities(model);
  const auto is_free = [&](const std::string& column) {
    return lower_case(column) != "t" && lower_case(column) != "time" &&
           std::none_of(known.begin(), known.end(),
                        [&](const Quantity& one) { return one.name == column; });
  };
  const auto free = std::find_if(columns.begin(), columns.end(), is_free);
  return "name a column so (--map " + name + "=" +
         (free == columns.end() ? "COLUMN" : *free) + ")";
}

}  // namespace

void check_columns(const OdeModel& model, const std::vector<std::string>& columns,
                   const std::string& source) {
  for (const Quantity& input : model.inputs())
    if (!contains(columns, input.name))
      throw DataError(source, "there is no column for the input '" + input.name + "'",
                      "add the column, or " + map_remedy(model, input.name, columns));
  bool any = false;
  for (const Output& output : formula_outputs(model)) {
    any = true;
    if (!contains(columns, output.name))
      throw DataError(source, "there is no column for the output '" + output.name + "'",
                      map_remedy(model, output.name, columns) +
                          ", or take the output out of the model");
  }
  for (Index k = 0; k < model.dimension(); ++k) {
    const std::string& state = model.states()[static_cast<std::size_t>(k)].name;
    const auto alias = alias_of(model, k);
    any = any || contains(columns, state);
    if (alias && !contains(columns, state))
      throw DataError(source, "there is no column for the output '" + *alias + "'",
                      map_remedy(model, *alias, columns) + ", or '" + state + "'");
  }
  if (!any)
    throw DataError(source,
                    "there is no column for the state '" + model.states().front().name +
                        "', nor for any other state or output",
                    map_remedy(model, model.states().front().name, columns) +
                        ", or give the model outputs");
}

void check_states(const OdeModel& model, const std::vector<std::string>& columns,
                  const std::vector<DerivativeChain>& chains, const std::string& source) {
  for (const Quantity& state : model.states())
    if (!contains(columns, state.name) && !has(chains, state.name))
      throw DataError(source, "there is no column for the state '" + state.name + "'",
                      "name a column so, or define the state in the model as the derivative "
                      "of one that has a column");
}

}  // namespace lacuna
