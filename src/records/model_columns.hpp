// SPDX-License-Identifier: MIT
// Which columns a model needs, by their names.
#pragma once

#include <string>
#include <vector>

#include "lacuna/model/ode_model.hpp"

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

/// Checks that every state has a column or is in a chain, and that every input has a column.
/// @param source what has the columns, for the message.
/// @throws DataError naming what is missing.
void check_columns(const OdeModel& model, const std::vector<std::string>& columns,
                   const std::vector<DerivativeChain>& chains, const std::string& source);

/// Whether a name is among others.
bool contains(const std::vector<std::string>& names, const std::string& name);

}  // namespace lacuna
