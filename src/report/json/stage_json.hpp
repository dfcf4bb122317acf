// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lacuna/identify/pipeline/pipeline.hpp"

namespace lacuna {

/// One stage as a JSON object: its name as "type", then every option with its present value;
/// stages inside it likewise. The configuration reads it back as the same stage.
std::string format_stage(const StageInterface& stage);

/// All stages of a pipeline as a JSON object with the keys basis, formulation, filter,
/// regressor and pruner: a complete configuration.
std::string format_pipeline(const Pipeline& pipeline);

}  // namespace lacuna
