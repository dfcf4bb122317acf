// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lacuna/forms/candidate/effect.hpp"
#include "lacuna/identify/forms_beside/form_options.hpp"
#include "lacuna/identify/pipeline/pipeline.hpp"

namespace lacuna {

/// Which forms are worth reporting where a model does not fit.
struct AdviceOptions {
  static constexpr StageInfo kInfo{"advice",
                                   "Which forms are reported where a model does not fit", ""};

  double worth_asking = 1e-3;
  double most_residual = 0.7;
  int most_forms = 2;
  FormOptions search = {};  ///< how forms are sought; listed as `forms`

  void describe(OptionVisitor& v) {
    v.field({"worth_asking", "",
             "Residual as a fraction of the rate (rms) below which an equation is not asked "
             "what it lacks.",
             0.0, 1.0},
            worth_asking);
    v.field(
        {"most_left", "",
         "A form that leaves a larger fraction of the residual (rms) is not what is missing.",
         0.0, 1.0},
        most_residual);
    v.field({"most_forms", "", "Forms that are reported for one equation at most.", 1.0, 20.0},
            most_forms);
  }
};

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
