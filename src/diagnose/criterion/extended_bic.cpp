// SPDX-License-Identifier: MIT
#include "diagnose/criterion/extended_bic.hpp"

#include "core/statistics/information.hpp"

namespace lacuna {

void ExtendedBicOptions::describe(OptionVisitor& v) {
  v.field(
      {"choice", "", "Weight of the penalty for choosing; 0 is the plain criterion.", 0.0, 1.0},
      choice);
}

double ExtendedBic::do_penalty(const Evidence& evidence) const {
  return evidence.parameters * parameter_penalty(evidence.samples) +
         2.0 * options().choice * evidence.log_choices;
}

Stage<Criterion> extended_bic(const ExtendedBicOptions& options) {
  return ExtendedBic(options);
}

}  // namespace lacuna
