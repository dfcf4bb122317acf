// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "core/base/names.hpp"
#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {

/// Why a model with these variables cannot have an output; nothing where it can. Whether
/// another output has its name is not asked.
std::optional<TextFault> output_fault(const Output& output, const VariableIndex& variables);

}  // namespace lacuna
