// SPDX-License-Identifier: MIT
#include "explained_records.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "data/derivatives/golden_section.hpp"
#include "lacuna/data/records/marks.hpp"
#include "lacuna/effects/effects.hpp"
#include "trajectories/smoother/hidden_states.hpp"
#include "trajectories/smoother/outlier_check.hpp"

namespace lacuna {
namespace {

bool is_finite(const Dataset& data) {
  return std::all_of(data.trajectories.begin(), data.trajectories.end(),
                     [](const Trajectory& record) { return record.states.allFinite(); });
}

/// Records with states behind those that were measured.
BoundRecords with_further_states(const BoundRecords& records, Dataset data) {
  BoundRecords all{std::move(data), records.channels, {}};
  all.channels.resize(all.data.states.size(), {.measured = false});
  for (const Trajectory& record : all.data.trajectories)
    all.outliers.push_back(marks_of(record));
  return all;
}

/// The model on records, with noise of the kind that was found and without the summands that
/// the measurement has: these are taken on the path, which moves with them. Marked samples that
/// are outliers are left out.
Assimilation without_faults(const Assimilation& found, BoundRecords& records,
                            const std::vector<bool>& hidden, double outlying,
                            const RunContext& context) {
  Dataset& data = records.data;
  AssimilationOptions options;
  options.coloured = found.noise.coloured;
  options.hidden = hidden;
  Assimilation fit = assimilate_from_starts(found.model, records, options, context);
  OutlierCheck outliers = check_outliers(found.model.states(), fit, outlying);
  fit.omitted = std::move(outliers.outliers);
  if (outliers.any_false) fit = assimilate_from(found.model, data, fit, options, context);
  if (found.channel_terms.empty()) return fit;
  constexpr int kPasses = 4;  // what a filter of a third of the time scale takes away: 1 %
  records.outliers = fit.omitted;
  std::vector<Matrix> given;
  for (const Trajectory& record : data.trajectories) given.push_back(record.states);
  for (int pass = 0; pass < kPasses; ++pass) {
    for (std::size_t r = 0; r < fit.records.size(); ++r)
      data.trajectories[r].states = without_channel_terms(
          given[r], fit.records[r], found.model.variables(), found.channel_terms);
    if (!is_finite(data)) return fit;
    records = with_noise_anew(std::move(records));
    fit = assimilate(found.model, records, options, context);
  }
  return fit;
}

/// The strongest tone where nothing but tones depends on time.
const FittedEffect* strongest_tone(const OdeModel& nominal, const Explanation& explanation) {
  for (const Equation& equation : nominal.equations())
    for (const WeightedTerm& summand : equation)
      if (summand.term.expression().variables().contains("t")) return nullptr;
  const FittedEffect* strongest = nullptr;
  for (const FittedEffect& effect : explanation.effects) {
    if (!effect.candidate.form.variables().contains("t")) continue;
    if (!has_form(effect.candidate, "sin(2*pi*a*t+b)") &&
        !has_form(effect.candidate, "x*sin(2*pi*a*t+b)"))
      return nullptr;
    if (!strongest || std::abs(effect.coefficient) > std::abs(strongest->coefficient))
      strongest = &effect;
  }
  return strongest;
}

/// One record of some, with what is known of it.
BoundRecords record_of(const BoundRecords& records, std::size_t r) {
  BoundRecords one = records;
  one.data.trajectories = {records.data.trajectories[r]};
  if (!records.outliers.empty()) one.outliers = {records.outliers[r]};
  return one;
}

/// Where the parabola through f at x and h beside it on both sides is lowest, no more than h away.
template <class Function>
double lowest_of_parabola(const Function& f, double x, double h) {
  const double before = f(x - h), at = f(x), after = f(x + h);
  const double curvature = before - 2.0 * at + after;
  return curvature > 0.0 ? x + h * std::clamp(0.5 * (before - after) / curvature, -1.0, 1.0) : x;
}

/// The likeliest offset of the clock of one record, from 0 to a period.
double likeliest_offset(const OdeModel& nominal, const Explanation& explanation,
                        const HeldOutRecords& one, double period, const RunContext& context) {
  // Facts of the search: a tone has one likeliest phase in a period, which the grid finds to a
  // hundredth of it and parabolas to where it makes no difference.
  constexpr double kPlaces = 6.0, kWider = 60.0, kNearer = 600.0;
  const auto deviance_at = [&](double offset) {
    const Vector ahead = Vector::Constant(1, offset);
    BoundRecords given = one.given;
    given.data = with_clocks_ahead(std::move(given.data), ahead);
    const Dataset corrected = with_clocks_ahead(one.corrected, ahead);
    const auto explained =
        explained_records(nominal, explanation, {given, corrected, one.outlying}, context);
    return explained ? explained->fit.deviance : std::numeric_limits<double>::infinity();
  };
  double offset = least_on_grid(deviance_at, 0.0, period, period / kPlaces);
  for (const double parts : {kWider, kNearer})
    offset = lowest_of_parabola(deviance_at, offset, period / parts);
  return deviance_at(offset) < deviance_at(0.0) ? offset : 0.0;
}

}  // namespace

std::optional<ExplainedRecords> explained_records(const OdeModel& nominal,
                                                  const Explanation& explanation,
                                                  const HeldOutRecords& held_out,
                                                  const RunContext& context) {
  std::vector<Matrix> paths;
  for (const Trajectory& record : held_out.corrected.trajectories)
    paths.push_back(record.states);
  AugmentedProblem problem =
      augment(nominal, held_out.corrected, {}, explanation.effects, paths);
  if (!is_finite(problem.data)) return std::nullopt;
  BoundRecords records = with_further_states(held_out.given, std::move(problem.data));
  Assimilation fit =
      without_faults(explanation.fit, records, hidden_states(nominal, held_out.corrected),
                     held_out.outlying, context);
  if (!is_finite(records.data)) return std::nullopt;
  return ExplainedRecords{std::move(records), std::move(fit)};
}

Vector clock_offsets(const OdeModel& nominal, const Explanation& explanation,
                     const HeldOutRecords& held_out, const RunContext& context) {
  const std::size_t count = held_out.given.data.trajectories.size();
  Vector offsets = Vector::Zero(static_cast<Index>(count));
  const FittedEffect* tone = strongest_tone(nominal, explanation);
  if (!tone || !(tone->shapes[0] > 0.0)) return offsets;
  for (std::size_t r = 0; r < count; ++r) {
    const BoundRecords given = record_of(held_out.given, r);
    Dataset corrected = held_out.corrected;
    corrected.trajectories = {held_out.corrected.trajectories[r]};
    offsets[static_cast<Index>(r)] =
        likeliest_offset(nominal, explanation, {given, corrected, held_out.outlying},
                         1.0 / tone->shapes[0], context);
  }
  return offsets;
}

Dataset with_clocks_ahead(Dataset data, const Vector& offsets) {
  for (std::size_t r = 0; r < data.trajectories.size(); ++r)
    data.trajectories[r].time.array() += offsets[static_cast<Index>(r)];
  return data;
}

}  // namespace lacuna
