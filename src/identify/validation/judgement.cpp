// SPDX-License-Identifier: MIT
#include "judgement.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/text.hpp"
#include "lacuna/core/base/stages_done.hpp"

namespace lacuna {
namespace {

/// What a test says of one state.
enum class Finding {
  Within,  ///< the error is noise
  Above,   ///< it is more
  Hidden,  ///< it may be noise of which the samples show nothing
  Blind,   ///< there is no motion to be explained beyond the noise
};

/// The noise with what chance and its estimate add.
double with_chance(double noise, const PredictionError& state,
                   const ValidationOptions& options) {
  return noise * (1.0 + options.noise_slack + options.scatter / std::sqrt(2.0 * state.freedom));
}

/// Whether errors that are hardly above the noise are no noise because neighbours have them in
/// common.
bool has_structure(const PredictionError& state, const ValidationOptions& options) {
  return state.error >
             state.noise * (1.0 + options.structure / std::sqrt(2.0 * state.freedom)) &&
         state.correlation * std::sqrt(state.freedom) > options.scatter;
}

Finding finding_of(const PredictionError& state, const ValidationOptions& options) {
  const double most = with_chance(state.noise, state, options);
  if (!std::isfinite(state.error)) return Finding::Above;
  const double sure =
      std::max(state.noise_estimated ? most : 0.0, options.resolution * state.motion);
  if (state.error > std::max(sure, most) || has_structure(state, options))
    return Finding::Above;
  if (state.motion <= most) return Finding::Blind;
  return state.error <= sure ? Finding::Within : Finding::Hidden;
}

struct Findings {
  Index within = 0, above = 0, hidden = 0;
  double fraction = 0.0;  ///< the largest of those that are above
};

double freedom_of(const PredictionTest& test) {
  double freedom = 0.0;
  for (const PredictionError& state : test.states) freedom += state.freedom;
  return freedom;
}

bool says_something(const PredictionTest& test, const ValidationOptions& options) {
  return freedom_of(test) >= options.least_freedom;
}

/// Whether a model has no solution in most windows.
bool is_lost(const PredictionTest& test) {
  return test.windows > 0 && 2 * test.lost > test.windows;
}

/// What is found of those states that a test is meant for.
template <class Predicate>
Findings findings_of(const PredictionTest& test, const ValidationOptions& options,
                     Predicate counts) {
  Findings all;
  for (const PredictionError& state : test.states) {
    if (!(state.freedom >= 1.0) || !counts(state)) continue;
    const Finding finding = finding_of(state, options);
    all.within += finding == Finding::Within;
    all.hidden += finding == Finding::Hidden;
    all.above += finding == Finding::Above;
    if (finding == Finding::Above) all.fraction = std::max(all.fraction, state.fraction());
  }
  return all;
}

/// Errors of one step beside large noise are no measure of a model, which is there to predict:
/// their fraction counts only where there are no windows that say something.
Findings joined(const Findings& one_step, const std::optional<Findings>& windows) {
  if (!windows) return one_step;
  return {one_step.within + windows->within, one_step.above + windows->above,
          one_step.hidden + windows->hidden, windows->fraction};
}

/// What is found of states in both tests, as far as these say something.
Findings findings_in(const Validation& validation, const ValidationOptions& options,
                     const std::optional<std::string>& state = std::nullopt) {
  const bool steps = says_something(validation.one_step, options);
  const bool windows = says_something(validation.windows, options);
  // What is no noise and not of the model, of solvers, digits and the interpolation between
  // steps, does not add up: one step shows it, and windows show what the model is off by.
  const auto any = [&](const PredictionError& one) { return !state || one.state == *state; };
  const auto counts_in_steps = [&](const PredictionError& one) {
    return any(one) && (!windows || one.noise_estimated || !std::isfinite(one.error));
  };
  return joined(
      steps ? findings_of(validation.one_step, options, counts_in_steps) : Findings{},
      windows ? std::optional(findings_of(validation.windows, options, any)) : std::nullopt);
}

/// Each state by itself.
std::vector<AdequacyPart> parts_of(const Validation& validation,
                                   const ValidationOptions& options, bool lost) {
  std::vector<AdequacyPart> parts;
  const auto add = [&](const PredictionError& state) {
    const auto known = std::find_if(parts.begin(), parts.end(), [&](const AdequacyPart& part) {
      return part.name == state.state;
    });
    if (known != parts.end()) return;
    const Findings found = findings_in(validation, options, state.state);
    const Adequate fits = lost || found.above > 0 ? Adequate::No
                          : found.hidden > 0      ? Adequate::Undetermined
                          : found.within > 0      ? Adequate::Yes
                                                  : Adequate::Undetermined;
    parts.push_back({state.state, fits, validation.samples, state.noise_estimated});
  };
  for (const PredictionError& state : validation.windows.states) add(state);
  for (const PredictionError& state : validation.one_step.states) add(state);
  return parts;
}

/// The worst state of a test.
const PredictionError* worst_of(const PredictionTest& test) {
  const PredictionError* worst = nullptr;
  for (const PredictionError& state : test.states)
    if (state.freedom >= 1.0 && (!worst || state.fraction() > worst->fraction()))
      worst = &state;
  return worst;
}

/// Whether an error is best given in deviations of the noise.
bool is_near_noise(const PredictionError& state) {
  return state.noise_estimated && state.noise > 0.0 && state.error < 3.0 * state.noise;
}

/// "1.02 times the noise of x" or "0.02 % of the motion of x".
std::string size_of(const PredictionError& state, bool in_noise) {
  if (in_noise)
    return format_number(state.error / state.noise, 3) + " times the noise of " + state.state;
  return percent_of(state.fraction(), "the motion of " + state.state);
}

/// Errors of the tests that say something, all on one scale.
std::string numbers_of(const Validation& validation, const ValidationOptions& options) {
  std::vector<std::pair<std::string, const PredictionError*>> worst_states;
  const auto add = [&](const PredictionTest& test, const std::string& what) {
    const PredictionError* worst = says_something(test, options) ? worst_of(test) : nullptr;
    if (worst) worst_states.emplace_back(what, worst);
  };
  add(validation.one_step, "one step ahead the error is");
  add(validation.windows, "over " + format_number(validation.windows.horizon, 3) +
                              (validation.time_unit.empty() ? "" : " " + validation.time_unit) +
                              " it is");
  const bool in_noise = std::all_of(worst_states.begin(), worst_states.end(),
                                    [](const auto& one) { return is_near_noise(*one.second); });
  std::vector<std::string> parts;
  for (const auto& [what, state] : worst_states)
    parts.push_back(what + " " + size_of(*state, in_noise));
  return join(parts, ", ");
}

/// What the numbers say of a model, before it is asked whether that may be said.
struct Opinion {
  ValidationVerdict verdict = ValidationVerdict::Undecided;
  std::string begin = {};    ///< of the sentence
  std::string numbers = {};  ///< with what belongs to them
  Adequate whole = Adequate::Undetermined;
  std::vector<Doubt> doubts = {};  ///< why records show nothing
};

/// Whether the samples of the tests are those that were fitted: none were held out.
bool is_on_fitted(const Validation& validation) {
  return !validation.given && !validation.refitted;
}

std::string too_few(const Validation& validation) {
  const std::string count = std::to_string(validation.samples) + " samples";
  return is_on_fitted(validation)
             ? "no part of the record could be held out, and on the " + count +
                   " that were fitted the tests show too little"
             : "only " + count + " are held out";
}

Opinion in_doubt(const std::string& why) { return {.doubts = {{why}}}; }

Opinion opinion_of(const Findings& found, const ValidationOptions& options,
                   const Validation& validation) {
  const std::string numbers = numbers_of(validation, options);
  if (found.above > 0 && found.fraction > options.wrong_fraction)
    return {ValidationVerdict::WrongLibrary, "Wrong library",
            "these terms cannot describe the record; " + numbers, Adequate::No};
  if (found.above > 0 && found.fraction < options.small_fraction)
    return {ValidationVerdict::Approximation,
            "Fits, but for " + percent_of(found.fraction, "the motion"), numbers, Adequate::No};
  if (found.above > 0)
    return {ValidationVerdict::Approximation, "An approximation", numbers, Adequate::No};
  if (found.within + found.hidden == 0)
    return in_doubt(std::string("nothing in the samples ") +
                    (is_on_fitted(validation) ? "" : "held out ") + "moves beyond their noise");
  if (found.hidden > 0)
    return in_doubt("how large the noise of the samples is they do not show; " + numbers);
  if (is_on_fitted(validation))
    return in_doubt("no part of the record could be held out; on what was fitted, " + numbers);
  return {ValidationVerdict::FitsToNoise, "Fits to the noise", numbers, Adequate::Yes};
}

Opinion opinion_of(const ValidationOptions& options, bool lost, const Validation& validation) {
  if (lost)
    return {ValidationVerdict::WrongLibrary, "Wrong library",
            "in most windows the model has no finite solution", Adequate::No};
  if (!says_something(validation.one_step, options) &&
      !says_something(validation.windows, options))
    return in_doubt(too_few(validation));
  return opinion_of(findings_in(validation, options), options, validation);
}

/// Those of a search that could change a verdict: none where the model fits. What a quick run
/// leaves out nobody expects of it; that no terms would do is a claim about all that are known.
std::vector<StageDone> deciding(std::vector<StageDone> stages, ValidationVerdict verdict) {
  if (verdict != ValidationVerdict::Approximation && verdict != ValidationVerdict::WrongLibrary)
    return {};
  if (verdict != ValidationVerdict::WrongLibrary)
    std::erase_if(stages, [](const StageDone& stage) { return stage.why == kIsQuick; });
  return stages;
}

Admission admission_of(const Opinion& opinion, const std::vector<StageDone>& stages,
                       const Validation& validation) {
  const bool fits = opinion.verdict == ValidationVerdict::FitsToNoise;
  // The test that has more windows in which no run began.
  const auto failing = [](const PredictionTest& test) {
    return test.windows > 0
               ? static_cast<double>(test.unstarted) / static_cast<double>(test.windows)
               : 0.0;
  };
  const PredictionTest& test = failing(validation.windows) >= failing(validation.one_step)
                                   ? validation.windows
                                   : validation.one_step;
  return admit({.claim = fits ? Claim::Fits : Claim::WrongStructure,
                .stages = deciding(stages, opinion.verdict),
                .windows = test.windows,
                .unstarted = test.unstarted,
                .doubts = opinion.doubts});
}

}  // namespace

void judge(const ValidationOptions& options, Validation& validation,
           const std::vector<StageDone>& stages) {
  const bool lost = is_lost(validation.one_step) || is_lost(validation.windows);
  const Opinion opinion = opinion_of(options, lost, validation);
  const Admission admission = admission_of(opinion, stages, validation);
  Adequate whole = opinion.whole;
  switch (admission.standing) {
    case Standing::Stands:
      validation.verdict = opinion.verdict;
      validation.sentence = opinion.begin + ": " + opinion.numbers + ".";
      break;
    case Standing::Incomplete:
      validation.verdict = ValidationVerdict::Incomplete;
      validation.sentence = "Incomplete: " + admission.why + "; " + admission.remedy +
                            "; by now " + opinion.numbers + ".";
      break;
    case Standing::Undetermined:
      whole = Adequate::Undetermined;
      validation.verdict = ValidationVerdict::Undecided;
      validation.sentence = "Undecided whether the model holds: " + admission.why +
                            (admission.remedy.empty() ? "" : "; " + admission.remedy) + ".";
      break;
  }
  validation.adequacy = {whole, parts_of(validation, options, lost)};
}

}  // namespace lacuna
