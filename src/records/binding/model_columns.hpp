// SPDX-License-Identifier: MIT
// Which columns a model needs, by their names.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {

/// A state with a column and the states without one that are its first, second, ...
/// derivative by the identities of a model.
struct DerivativeChain {
  std::string root;
  std::vector<std::string> derivatives;
};

/// The chains of a model's states when there are the given columns; a state is in one chain.
std::vector<DerivativeChain> derivative_chains(const OdeModel& model,
                                               const std::vector<std::string>& columns);

/// The output whose column measures a state that has no column of its own name: the first that
/// is just the state.
std::optional<std::string> alias_of(const OdeModel& model, Index state);

/// Outputs that are channels of their own: formulas, and further measurements of a state.
std::vector<Output> formula_outputs(const OdeModel& model);

/// The names of columns with those of aliases replaced by the states that they measure.
std::vector<std::string> as_states(const OdeModel& model, std::vector<std::string> columns);

/// The quantities that columns may measure, with their units: states, under the names of their
/// aliases too, formula outputs and inputs.
std::vector<Quantity> measured_quantities(const OdeModel& model);

/// Checks that every input and every formula output has a column, every alias or its state too,
/// and that some state or output is measured.
/// @param columns as of as_states(). @param source what has the columns, for the message.
/// @throws DataError naming what is missing.
void check_columns(const OdeModel& model, const std::vector<std::string>& columns,
                   const std::string& source);

/// Checks that every state has a column or is in a chain. @throws DataError naming it.
void check_states(const OdeModel& model, const std::vector<std::string>& columns,
                  const std::vector<DerivativeChain>& chains, const std::string& source);

/// Whether a name is among others.
bool contains(const std::vector<std::string>& names, const std::string& name);

}  // namespace lacuna
