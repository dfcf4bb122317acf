// SPDX-License-Identifier: MIT
// The journey: records -> baseline -> composite models -> the best of them -> gap -> answer.
#include "lacuna/diagnose/diagnose.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "answer.hpp"
#include "core/base/text.hpp"
#include "data/derivatives/finite_differences.hpp"
#include "data/records/number_range.hpp"
#include "diagnose/hints/hints.hpp"
#include "diagnose/hypotheses/input_noise.hpp"
#include "fitted_start.hpp"
#include "gap.hpp"
#include "held_inputs.hpp"
#include "journey.hpp"
#include "lacuna/records/binding/gaps.hpp"
#include "lacuna/records/binding/model_view.hpp"
#include "lacuna/records/binding/read_records.hpp"
#include "model/equations/formula_channel.hpp"
#include "output_channels.hpp"
#include "records/binding/other_records.hpp"
#include "smoothed_records.hpp"
#include "trajectories/smoother/hidden_states.hpp"
#include "trajectories/smoother/unknown_past.hpp"

namespace lacuna {
namespace {

/// Records to explain and records that choose nothing.
struct Records {
  BoundRecords find;
  Dataset unused;  ///< as `find`, with columns that the model does not know as inputs
  BoundRecords check;
  std::vector<std::string> notes = {};
  bool continued = false;  ///< whether the others are the last parts of the same records
};

ChannelOptions channel_options(const DecisionOptions& decision) {
  return {decision.outlying, decision.pile_up};
}

/// Whether any measured channel ever changes.
bool something_changes(const Dataset& data) {
  for (Index k = 0; k < data.state_count(); ++k)
    for (const Trajectory& record : data.trajectories) {
      const auto& x = record.states.col(k);
      if (data.is_measured(k) && (x.array() != x[0]).any()) return true;
    }
  return false;
}

/// @throws DataError where what was before a record is not known for half of it or longer.
void check_past(const OdeModel& nominal, const Dataset& data) {
  const double longest = longest_delays(nominal).maxCoeff();
  for (const Trajectory& record : data.trajectories)
    if (longest > 0.5 * record.duration())
      throw DataError(record.source,
                      "the model has a delay of " + format_number(longest, 4) +
                          ", more than half of the record: what was before it is not known",
                      "give longer records");
}

Records prepared(const OdeModel& nominal, const Dataset& data, const Dataset& held_out,
                 const DecisionOptions& decision) {
  UsableRecords all = usable_records(data, decision.gaps);
  const bool split = held_out.trajectories.empty();
  SplitRecords parts = split ? split_in_time(all.data) : SplitRecords{std::move(all.data), {}};
  if (!split) {
    UsableRecords other = usable_records(held_out, decision.gaps);
    for (const std::string& note : other.notes)
      all.notes.push_back("held-out records: " + note);
    parts.check = std::move(other.data);
  }
  Dataset unused = unused_part(nominal, parts.find);
  const auto with_start = [&](Dataset part) {
    part = used_part(nominal, std::move(part));
    return with_hidden_paths(nominal, part, hidden_states(nominal, part), given_begin(nominal));
  };
  BoundRecords find = observed(with_start(std::move(parts.find)), channel_options(decision));
  if (!something_changes(find.data))
    throw DataError(find.data.trajectories.front().source,
                    "nothing moves: no measured state or output ever changes",
                    "use a record with motion");
  check_past(nominal, find.data);
  all.notes.insert(all.notes.end(), find.notes.begin(), find.notes.end());
  Dataset check = with_start(std::move(parts.check));
  if (split && !something_changes(check))
    all.notes.push_back(
        "nothing moves in the last quarter of the records, which is kept back to measure the "
        "gap "
        "on: give other records for that (--holdout)");
  BoundRecords known = observed_alike(std::move(check), find, channel_options(decision));
  return {std::move(find), std::move(unused), std::move(known), std::move(all.notes),
          split};
}

/// The gap on records that chose nothing, which the composite model's assumptions correct like
/// the others.
/// @param without the model before it. @param floor see HeldOutRecords::known_floor.
std::optional<Gap> gap_of(const Problem& problem, const OdeModel& without,
                          const CompositeModel& composite, const BoundRecords& check,
                          double floor) {
  const auto& correct = composite.base->correct;
  const Dataset corrected = correct ? correct(check.data) : check.data;
  const bool unexplained = composite.named.empty() && composite.findings.empty();
  Gap gap =
      measure_gap(without, composite.explanation,
                  {check, corrected, problem.options.decision.outlying, floor, unexplained},
                  problem.context);
  // Without a window in which the model has a solution there is no distance to measure.
  if (std::isfinite(gap.before) && std::isnan(gap.after)) gap.after = INFINITY;
  const bool refuted = std::isinf(gap.after);
  if (!refuted && !std::isfinite(gap.before + gap.after)) return std::nullopt;
  return gap;
}

/// A composite model with its holdout evaluation.
struct EvaluatedComposite {
  Judged judged;
  std::optional<Gap> gap;
  HoldoutEvaluation evaluation = {};        ///< the last one, which withdraws nothing more
  std::vector<std::string> withdrawn = {};  ///< what was, and why
};

/// Gaps on records that chose nothing: of the nominal model as it was given, and of its structure
/// with fitted coefficients where something is named.
struct Gaps {
  std::optional<Gap> given, fitted;
};

/// Enters whether there was time to measure the gaps. @return those there are.
/// @param floor see HeldOutRecords::known_floor.
Gaps gaps_in_time(const Problem& problem, const CompositeModel& composite,
                  const BoundRecords& check, double floor, std::vector<StageDone>& stages) {
  std::erase_if(stages, [](const StageDone& stage) { return stage.name == kGapStage; });
  Gaps gaps;
  run_stage(stages, kGapStage, [&] {
    gaps.given = gap_of(problem, problem.nominal, composite, check, floor);
    if (gaps.given && !composite.named.empty())
      gaps.fitted = gap_of(problem, composite.base->fitted.model, composite, check, floor);
  });
  return gaps;
}

/// The faults of the measurement alone, where effects of the dynamics beside them make a minor
/// difference to the records that were not used, or explain these to their noise. The form of a
/// fault is an approximation (a sensor that shows means of its last samples is no pure delay):
/// what it leaves is no structure of the device, however significant.
std::optional<CompositeModel> faults_that_suffice(const Problem& problem,
                                                  const EvaluatedComposite& evaluated,
                                                  const BoundRecords& check) {
  if (!evaluated.gap) return std::nullopt;
  std::optional<CompositeModel> alone =
      with_only(problem, evaluated.judged.best, [](const FittedEffect& effect) {
        return effect.candidate.place == Place::Channel;
      });
  if (!alone) return std::nullopt;
  const std::optional<Gap> gap =
      gap_of(problem, problem.nominal, *alone, check, evaluated.gap->noise_floor);
  if (!gap) return std::nullopt;
  const DecisionOptions& decision = problem.options.decision;
  const double most = std::max((1.0 + decision.minor) * evaluated.gap->after,
                               decision.explained_gap * gap->noise_floor);
  return gap->after <= most ? std::move(alone) : std::nullopt;
}

/// evaluate_time() where some effects depend on time and others do not.
HoldoutEvaluation evaluate_time_on(const Problem& problem, const EvaluatedComposite& evaluated,
                                   const BoundRecords& check) {
  const CompositeModel& best = evaluated.judged.best;
  if (!evaluated.gap) return {};
  const auto without = with_only(problem, best, [](const FittedEffect& effect) {
    return !depends_on_time(effect);
  });
  if (!without) return {};
  const auto gap =
      gap_of(problem, problem.nominal, *without, check, evaluated.gap->noise_floor);
  return gap ? evaluate_time(problem, best, *gap, *evaluated.gap) : HoldoutEvaluation{};
}

/// @param problem without a deadline. @param context with it.
EvaluatedComposite evaluated_on(const Records& records, const Problem& problem,
                                const RunContext& context,
                                const std::vector<Stage<Hypothesis>>& hypotheses,
                                Judged judged) {
  const Problem hurried{problem.nominal, problem.records, problem.options, context,
                        problem.memory};
  EvaluatedComposite evaluated{
      settle_composite(problem, context, hypotheses, std::move(judged)), {}};
  double floor = std::numeric_limits<double>::infinity();
  for (;;) {
    const CompositeModel& best = evaluated.judged.best;
    Gaps gaps = gaps_in_time(hurried, best, records.check, floor, evaluated.judged.stages);
    evaluated.gap = std::move(gaps.given);
    evaluated.evaluation = evaluate_holdout(problem, best, evaluated.gap, records.continued);
    if (!evaluated.evaluation.withdraw && gaps.fitted)
      if (HoldoutEvaluation names = evaluate_names(problem, best, *gaps.fitted); names.withdraw)
        evaluated.evaluation = std::move(names);
    if (!evaluated.evaluation.withdraw && !evaluated.evaluation.lower)
      evaluated.evaluation = evaluate_time_on(problem, evaluated, records.check);
    if (evaluated.gap && !std::isfinite(evaluated.gap->after)) evaluated.gap.reset();
    if (evaluated.evaluation.withdraw) {
      evaluated.withdrawn.push_back(evaluated.evaluation.note);
      evaluated.judged.best = without_claims(problem, evaluated.judged.best,
                                             evaluated.evaluation.assumptions_too);
    } else if (auto alone = faults_that_suffice(problem, evaluated, records.check)) {
      evaluated.withdrawn.push_back(
          "effects of the dynamics beside the fault of a sensor make a minor difference to the "
          "records that were not used: they get no name");
      // What the effects explained where they were found is no noise without them.
      floor = std::min(floor, evaluated.gap->noise_floor);
      evaluated.judged.best = *std::move(alone);
    } else {
      return evaluated;
    }
    evaluated.judged =
        settle_composite(problem, context, hypotheses, std::move(evaluated.judged));
  }
}

/// The answer where records and model do not fit together: nothing but why.
Diagnosis withheld_answer(const OdeModel& nominal, std::vector<Hint> hints) {
  Diagnosis diagnosis{
      .verdict = Verdict::UnnamedStructure,
      .nominal = nominal,
      .disagreement = {},
      .effects = {},
      .coefficient_changes = {},
      .gap = {},
      .remaining = {.structure = true, .sigma = 0.0, .equations = {}, .details = {}},
      .augmented = nominal,
      .noise = {},
      .rounds = {},
      .rivals = {},
      .notes = {},
      .hints = std::move(hints)};
  admit_verdict(diagnosis, {}, 0.0);
  return diagnosis;
}

/// Slips that coefficients give away, all of them together or one by itself, where none was
/// seen before.
void add_coefficient_hints(const Problem& problem, Diagnosis& diagnosis) {
  if (withheld_by(diagnosis.hints) != Withheld::Nothing) return;
  const DecisionOptions& decision = problem.options.decision;
  const Dataset& data = problem.records.data;
  std::vector<EstimatedCoefficient> all, changed;
  for (const CoefficientChange& change : diagnosis.coefficient_changes) {
    if (change.nominal == 0.0 || !change.determined) continue;
    all.push_back({change.equation, change.term, change.estimated / change.nominal,
                   change.deviation / std::abs(change.nominal)});
    if (change.sigma >= decision.significance) changed.push_back(all.back());
  }
  if (diagnosis.verdict == Verdict::CoefficientsOnly)
    if (auto hint = clock_hint(problem.nominal, data, all, decision.hints)) {
      diagnosis.hints.push_back(*std::move(hint));
      return;
    }
  for (const EstimatedCoefficient& said : changed)
    if (auto hint = coefficient_hint(problem.nominal, data, said, decision.hints))
      diagnosis.hints.push_back(std::move(*hint));
}

/// The model with coefficients that are not fitted.
OdeModel held(const OdeModel& model) {
  std::vector<Equation> equations = model.equations();
  for (Equation& equation : equations)
    for (WeightedTerm& term : equation) term.fixed = true;
  return model.with_equations(std::move(equations));
}

/// Records that were smoothed, as their noise shows, as they were before.
void preprocess(const OdeModel& nominal, const DiagnosisOptions& options,
                const RunContext& context, Records& records) {
  const auto smoothing = smoothing_of({nominal, records.find, options, context});
  if (!smoothing) return;
  const SmoothingOptions& undoing = options.decision.smoothing;
  records.find = preprocessed(*smoothing, std::move(records.find), undoing);
  records.check = preprocessed(*smoothing, std::move(records.check), undoing);
  records.notes.push_back(note_on(*smoothing));
}

/// What the records themselves show. Where states are hidden there are no rates to compare.
std::vector<Hint> hints_on(const OdeModel& nominal, const Records& records,
                           const HintOptions& options) {
  if (hidden_states(nominal, records.find.data).empty())
    return look_at(nominal, records.find, records.unused, options);
  if (auto still = stillness(records.find, options)) return {std::move(*still)};
  return {};
}

/// Records whose columns are those of the model as they are, others in its variables.
Dataset in_variables_of(const OdeModel& model, const Dataset& records) {
  return is_view(model, records) ? with_input_columns(records)
                                 : model_view(model, records, FiniteDifferences{});
}

/// Model and records in which outputs that are states in other units are these states.
struct SeenInStates {
  OdeModel model;
  Dataset find, check;
};

SeenInStates in_states(const OdeModel& model, const Dataset& measured, const Dataset& other) {
  const Dataset data = in_variables_of(model, measured);
  const std::vector<StateImage> images = images_of_states(model, data);
  OdeModel seen = without_images(model, images);
  Dataset check = other;
  if (!other.trajectories.empty())
    check = with_states_of(images, seen, in_variables_of(model, other));
  Dataset find = with_states_of(images, seen, data);
  return {std::move(seen), std::move(find), std::move(check)};
}

// Facts of cost, of the time that there is: errors, gap and places of disagreement take what the
// search leaves, and a start of it may not take what it is a start for.
constexpr double kFractionOfSearch = 0.6, kFractionOfStart = 0.2;

/// A context whose deadline is that of a part of the time that is left.
RunContext with_part_of_time(const RunContext& context, double fraction) {
  RunContext part = context;
  if (!context.deadline) return part;
  const auto now = std::chrono::steady_clock::now();
  const std::chrono::duration<double> left = *context.deadline - now;
  part.deadline =
      now + std::chrono::duration_cast<std::chrono::steady_clock::duration>(fraction * left);
  return part;
}

/// Whether some state that has a rate was not measured: it is hidden, or made of others.
bool has_unmeasured_states(const OdeModel& nominal, const Dataset& data) {
  for (Index k = 0; k < nominal.dimension(); ++k)
    if (!is_formula_channel(nominal.states()[static_cast<std::size_t>(k)]) &&
        !data.is_measured(k))
      return true;
  return false;
}

/// Hypotheses in the order in which they are judged; none where no effect may be named.
std::vector<Stage<Hypothesis>> hypotheses_of(const DiagnosisOptions& options,
                                             const std::vector<Hint>& hints) {
  if (withheld_by(hints) != Withheld::Nothing) return {};
  return in_order(options.hypotheses);
}

}  // namespace

Diagnosis diagnose(const OdeModel& model, const Dataset& measured, const Dataset& other,
                   const DiagnosisOptions& options, const RunContext& context) {
  check_flow(model, "diagnose");
  check_no_events(model, "diagnose");
  const auto [seen, data, held_out] = in_states(model, measured, other);
  const OdeModel nominal = with_output_channels(seen, data);
  check_is_view(nominal, data);
  if (!held_out.trajectories.empty()) check_is_view(nominal, held_out);
  check_number_range(data);
  check_number_range(held_out);
  check_are_others(data, held_out);
  Records records = prepared(nominal, data, held_out, options.decision);
  std::vector<Hint> hints = hints_on(nominal, records, options.decision.hints);
  if (withheld_by(hints) == Withheld::Answer)
    return withheld_answer(nominal, std::move(hints));
  const std::vector<Stage<Hypothesis>> hypotheses = hypotheses_of(options, hints);
  const OdeModel known = withheld_by(hints) == Withheld::Claims ? held(nominal) : nominal;
  const BoundRecords as_measured = records.find;
  preprocess(known, options, context.unhurried(), records);

  const RunContext searching = with_part_of_time(context, kFractionOfSearch);
  const Problem given{known, records.find, options, searching};
  given.memory->input_noise = noise_of_inputs(records.find.data);
  if (!hypotheses.empty() && has_unmeasured_states(nominal, records.find.data))
    given.memory->start =
        fitted_start(seen, known, as_measured.data, noise_of(as_measured),
                     with_part_of_time(context, kFractionOfStart));
  JudgedModel inputs = judge_holds(given, hypotheses);
  const RunContext unhurried = context.unhurried();
  const Problem problem{*inputs.model, records.find, options, unhurried, given.memory};
  const bool whole = left_out_line(inputs.judged.stages).empty();
  EvaluatedComposite evaluated = evaluated_on(
      records, problem, context, whole ? hypotheses : std::vector<Stage<Hypothesis>>(),
      std::move(inputs.judged));
  Diagnosis diagnosis = make_answer(problem, std::move(evaluated.judged),
                                    std::move(evaluated.gap), evaluated.evaluation);
  diagnosis.notes.insert(diagnosis.notes.end(), evaluated.withdrawn.begin(),
                         evaluated.withdrawn.end());
  diagnosis.notes.insert(diagnosis.notes.begin(), inputs.notes.begin(), inputs.notes.end());
  diagnosis.notes.insert(diagnosis.notes.begin(), records.notes.begin(), records.notes.end());
  if (const std::string line = left_out_line(diagnosis.stages); !line.empty())
    diagnosis.notes.push_back(line);
  diagnosis.hints.insert(diagnosis.hints.begin(), std::make_move_iterator(hints.begin()),
                         std::make_move_iterator(hints.end()));
  add_coefficient_hints(problem, diagnosis);
  diagnosis.augmented = without_output_channels(diagnosis.augmented, model);
  admit_verdict(diagnosis, options.decision, longest_record(problem.records.data).duration());
  return diagnosis;
}

}  // namespace lacuna
