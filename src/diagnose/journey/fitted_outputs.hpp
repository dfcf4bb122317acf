// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "lacuna/core/base/run_context.hpp"
#include "lacuna/data/records/dataset.hpp"
#include "lacuna/model/equations/system_model.hpp"

namespace lacuna {

/// A model whose outputs have numbers that fit records.
struct FittedOutputs {
  SystemModel model;
  std::vector<std::string> notes = {};  ///< which numbers were changed, for people
};

/// What a sensor shows (an offset, a resistance in series) is no effect of the dynamics, and a
/// diagnosis leaves it as it is. Free parameters that stand in measured outputs and in no
/// equation are fitted first, along with all others (fit()); only theirs are kept.
/// @return the model as it is where there are none, or where it cannot be fitted.
/// @throws Cancelled.
FittedOutputs with_fitted_outputs(const SystemModel& model, const Dataset& records,
                                  const RunContext& context);

}  // namespace lacuna
