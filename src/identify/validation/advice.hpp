// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lacuna/forms/candidate/effect.hpp"
#include "lacuna/identify/options.hpp"
#include "lacuna/identify/pipeline/pipeline.hpp"

namespace lacuna {

/// What advice is asked for: all of it outlives the call.
struct AdviceTask {
  const IdentificationResult& result;
  const Dataset& data;
  const Pipeline& pipeline;  ///< by which the result was found
  const std::vector<Stage<Effect>>& effects;
  std::optional<Vector> white_noise = {};  ///< of each state, where it is known
};

/// What to try where a model does not fit: for each of its equations the form that the residual
/// asks for, if one stands out (FormSearch), as far as the pipeline keeps it where it is
/// offered, else `lacuna diagnose`. Each advice costs one more identification.
/// @throws OutOfTime past the deadline.
std::vector<std::string> advice_for(const AdviceTask& asked_for,
                                    const AdviceOptions& options = {},
                                    const RunContext& context = {});

}  // namespace lacuna
