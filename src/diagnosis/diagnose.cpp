// SPDX-License-Identifier: MIT
// The journey: records -> baseline -> accounts -> the best of them -> gap -> answer.
#include "lacuna/diagnosis/diagnose.hpp"

#include <cmath>
#include <utility>

#include "answer.hpp"
#include "journey.hpp"
#include "lacuna/records/gaps.hpp"

namespace lacuna {
namespace {

/// Records to explain and records that choose nothing.
struct Records {
  BoundRecords find;
  Dataset check;
  std::vector<std::string> notes = {};
};

Records prepared(const Dataset& data, const Dataset& held_out,
                 const DecisionOptions& decision) {
  UsableRecords all = usable_records(data, decision.gaps);
  if (held_out.trajectories.empty()) {
    SplitRecords parts = split_in_time(all.data);
    return {observed(std::move(parts.find), decision.outlying), std::move(parts.check),
            std::move(all.notes)};
  }
  UsableRecords other = usable_records(held_out, decision.gaps);
  for (const std::string& note : other.notes) all.notes.push_back("held-out records: " + note);
  return {observed(std::move(all.data), decision.outlying), std::move(other.data),
          std::move(all.notes)};
}

/// The gap on records that chose nothing, which the account's assumptions correct like the
/// others.
std::optional<Gap> gap_of(const Problem& problem, const Account& account,
                          const Dataset& check) {
  const auto& correct = account.base->correct;
  const Dataset corrected = correct ? correct(check) : check;
  Gap gap = measure_gap(problem.nominal, account.explanation,
                        {check, corrected, problem.options.decision.outlying}, problem.context);
  if (!std::isfinite(gap.before) || !std::isfinite(gap.after)) return std::nullopt;
  return gap;
}

}  // namespace

Diagnosis diagnose(const OdeModel& nominal, const Dataset& data, const Dataset& held_out,
                   const DiagnosisOptions& options, const RunContext& context) {
  const Records records = prepared(data, held_out, options.decision);
  const Problem problem{nominal, records.find, options, context};
  const std::vector<Stage<Hypothesis>> hypotheses =
      options.hypotheses.empty() ? standard_hypotheses() : in_order(options.hypotheses);

  Judged judged = choose_account(problem, hypotheses, plain_baseline(problem));
  judged = settle_account(problem, hypotheses, std::move(judged));
  std::optional<Gap> gap = gap_of(problem, judged.best, records.check);
  const Hearing hearing = hear_other_records(problem, judged.best, gap);
  if (hearing.withdraw) {
    judged.best = without_names(problem, judged.best);
    judged = settle_account(problem, hypotheses, std::move(judged));
    gap = gap_of(problem, judged.best, records.check);
  }
  Diagnosis diagnosis = make_answer(problem, std::move(judged), std::move(gap), hearing);
  diagnosis.notes.insert(diagnosis.notes.begin(), records.notes.begin(), records.notes.end());
  return diagnosis;
}

}  // namespace lacuna
