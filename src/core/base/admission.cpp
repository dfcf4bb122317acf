// SPDX-License-Identifier: MIT
#include <algorithm>
#include <string>

#include "core/base/text.hpp"
#include "lacuna/core/base/stages_done.hpp"

namespace lacuna {
namespace {

Admission cut_search(const VerdictBasis& basis) {
  const std::string line = left_out_line(basis.stages);
  if (line.empty()) return {};
  const auto because = [&](const char* why) {
    return std::any_of(basis.stages.begin(), basis.stages.end(),
                       [&](const StageDone& stage) { return !stage.done && stage.why == why; });
  };
  std::vector<std::string> options;
  if (because(kTimeIsUp)) options.emplace_back("--time-limit");
  if (because(kIsQuick)) options.emplace_back("--effort");
  return {Standing::Incomplete, line, "leave it its time (" + join(options, ", ") + ")"};
}

Admission nothing_moves(const VerdictBasis& basis) {
  if (!basis.still) return {};
  return {Standing::Undetermined,
          "nothing moves in the records: they fit many models, and determine none",
          "use records with motion"};
}

Admission slow_noise(const VerdictBasis& basis) {
  if (!basis.memory || !(basis.memory->value > basis.memory->bound)) return {};
  return {Standing::Undetermined,
          "what is taken for noise has a memory of " +
              format_number(100.0 * basis.memory->value, 2) +
              " % of a record: that is not distinguished from structure that the model lacks",
          "use longer records, or several"};
}

Admission nothing_to_point_at(const VerdictBasis& basis) {
  if (basis.claim != Claim::CoefficientsOff || !basis.changed || *basis.changed > 0) return {};
  return {Standing::Undetermined,
          "the coefficients together fit better than as they were given, but none of them, and "
          "no combination, is off beyond its error",
          "use longer records, or such with more motion"};
}

Admission open_numbers(const VerdictBasis& basis) {
  if (basis.open.empty()) return {};
  return {Standing::Undetermined, "the records do not determine " + join(basis.open, ", "),
          "give records with more motion, or keep these numbers fixed"};
}

Admission not_shown(const VerdictBasis& basis) {
  if (basis.shows_opposite) return {};
  return {Standing::Undetermined, "the samples are too few to show the opposite",
          "give more samples"};
}

Admission few_runs_started(const VerdictBasis& basis) {
  if (basis.unstarted == 0 || 2 * basis.unstarted < basis.windows) return {};
  return {Standing::Undetermined,
          "in " + std::to_string(basis.unstarted) + " of " + std::to_string(basis.windows) +
              " windows no run of the model was found that begins near the samples",
          "use records with less noise or more of the states"};
}

Admission left_in_doubt(const VerdictBasis& basis) {
  if (basis.doubts.empty()) return {};
  return {Standing::Undetermined, basis.doubts.front().why, basis.doubts.front().remedy};
}

}  // namespace

Admission admit(const VerdictBasis& basis) {
  for (const auto refusal : {cut_search, nothing_moves, slow_noise, nothing_to_point_at,
                             open_numbers, not_shown, few_runs_started, left_in_doubt})
    if (Admission refused = refusal(basis); !refused.stands()) return refused;
  return {};
}

}  // namespace lacuna
