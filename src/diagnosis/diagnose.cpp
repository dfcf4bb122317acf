// SPDX-License-Identifier: MIT
#include "lacuna/diagnosis/diagnose.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "coefficient_changes.hpp"
#include "decision/carry_over.hpp"
#include "decision/substance.hpp"
#include "decision/window_refit.hpp"
#include "hypotheses/broken_identities.hpp"
#include "hypotheses/coloured_noise.hpp"
#include "hypotheses/free_input.hpp"
#include "hypotheses/polynomial_gap.hpp"
#include "hypotheses/search.hpp"
#include "lacuna/core/error.hpp"
#include "lacuna/core/text.hpp"
#include "lacuna/data/noise.hpp"
#include "lacuna/estimation/outlier_check.hpp"
#include "lacuna/numerics/significance.hpp"
#include "lacuna/records/bound_records.hpp"
#include "lacuna/records/gaps.hpp"

namespace lacuna {
namespace {

/// The steps of a diagnosis in their order.
class Workflow {
 public:
  Workflow(const OdeModel& nominal, const BoundRecords& records,
           const DiagnosisOptions& options, const RunContext& context)
      : nominal_(nominal),
        records_(records),
        data_(records.data),
        options_(options),
        context_(context),
        result_{Verdict::NoDiscrepancy, nominal, {}, {}, {}, {}, {}, nominal, {}, {}, {}} {}

  Diagnosis run(const Dataset& held_out) {
    bring_onto_records();
    SearchResult found = search();
    if (any_substantial(found.left) || !found.named.empty())
      found = or_coloured(std::move(found));
    found = or_broken_identities(std::move(found));
    conclude(found);
    gauge_on(held_out);
    hear_other_records(found, held_out);
    tell_of_memory();
    return std::move(result_);
  }

 private:
  void bring_onto_records() {
    context_.report("bringing the model onto the records", 0.0);
    given_ = assimilate(nominal_, data_, records_.outliers, AssimilationOptions{}, context_);
    OutlierCheck outliers = check_outliers(nominal_.states(), *given_);
    given_->omitted = std::move(outliers.outliers);
    result_.notes = std::move(outliers.notes);
    if (outliers.any_false)
      given_ = assimilate_from(nominal_, data_, *given_, AssimilationOptions{}, context_);
    if (!std::isfinite(given_->deviance))
      throw DataError(data_.trajectories.front().source,
                      "the model has no finite solution from one sample to the next",
                      "check that model and record have the same units, above all of time");
    result_.disagreement = locate(*given_, context_);
    fit_options_.free = free_coefficients(nominal_);
    fit_options_.priors = options_.tolerances;
    context_.report("fitting the nominal coefficients", 0.0);
    fit_nominal();
    fit_options_.passes = 8;
    if (std::isfinite(fitted_->deviance)) return;
    result_.notes.push_back(
        "these records do not tell the nominal coefficients, which are kept as they are");
    fit_options_.free.clear();
    fitted_ = given_;
  }

  void fit_nominal() {
    fitted_ = settled(assimilate_from(nominal_, data_, *given_, fit_options_, context_), data_,
                      fit_options_, context_);
  }

  /// What is missing on top of the model as it is fitted.
  SearchResult search() {
    constexpr Index kLines = 3;
    scope_ =
        make_scope(nominal_, data_, estimate_noise(data_), spectral_lines(*fitted_, kLines));
    SearchResult found =
        search_effects(data_, *fitted_, *scope_, fit_options_, options_, context_);
    if (any_substantial(found.left) && has_fault(found)) prefer_dynamics(found);
    if (any_substantial(found.left) && !found.named.empty())
      found.refitted = refit_over_windows(data_, fit_options_, found.explanation, context_);
    if (any_substantial(found.left) && !shows_the_motion(found)) or_free_input(found);
    return found;
  }

  static bool has_fault(const SearchResult& found) {
    return !found.explanation.fit.channel_terms.empty();
  }

  /// Whether an effect is one of the measurement.
  bool is_fault(const Stage<Effect>& effect) const {
    for (Index k = 0; k < nominal_.dimension(); ++k)
      for (const Candidate& candidate : effect->candidates(*scope_, k))
        if (candidate.place == Place::Channel) return true;
    return false;
  }

  /// A fault of the measurement that leaves structure is not what is wrong, or not all of it:
  /// effects of the dynamics take its place where they alone explain most.
  void prefer_dynamics(SearchResult& found) const {
    DiagnosisOptions dynamics = options_;
    std::erase_if(dynamics.effects, [&](const auto& effect) { return is_fault(effect); });
    SearchResult other =
        search_effects(data_, *fitted_, *scope_, fit_options_, dynamics, context_);
    if (!closes_most(other)) return;
    other.rounds.insert(other.rounds.begin(), found.rounds.begin(), found.rounds.end());
    found = std::move(other);
  }

  /// Where structure is left the coefficients that hold over windows are the answer.
  void take_refitted(SearchResult& found) const {
    if (!found.refitted) return;
    found.explanation = std::move(*found.refitted);
    update_numbers(found.explanation, found.named);
  }

  Unexplained unexplained() const {
    const std::vector<EquationStructure> structure = test_structure(*fitted_, context_);
    return {data_,
            *fitted_,
            *scope_,
            fit_options_,
            options_,
            context_,
            structure.empty() ? 0 : structure.front().equation};
  }

  /// Where effects leave something over an input that was not measured may explain the records
  /// better. Effects that explain less than it get no name, whether it gets one or not.
  void or_free_input(SearchResult& found) const {
    const Unexplained problem = unexplained();
    const std::optional<RankedEffect> input = find_free_input(problem);
    if (!input || input->criterion > criterion_of(found.explanation)) return;
    if (stands_alone(*input, problem))
      found = name_free_input(*input, *fitted_, options_, std::move(found.rounds), context_);
    else
      found.named.clear();
  }

  bool any_substantial(const std::vector<EquationStructure>& left) const {
    return std::any_of(left.begin(), left.end(),
                       [&](const auto& s) { return is_substantial(s, options_); });
  }

  /// The other explanation: noise of the measurement that has a memory. It is taken when it
  /// explains the records better than the effects do; the search is repeated on top of it.
  SearchResult or_coloured(SearchResult found) {
    const Assimilation coloured = best_coloured();
    const double log_samples = std::log(static_cast<double>(coloured.used));
    const double price = 2.0 * static_cast<double>(coloured.noise.measured()) * log_samples;
    if (coloured.deviance + price >= criterion_of(found.explanation) + price_of_choice(found))
      return found;
    fitted_ = coloured;
    Assimilation start = *given_;
    start.noise = coloured.noise;
    given_ = assimilate_from(nominal_, data_, start, AssimilationOptions{}, context_);
    result_.disagreement = locate(*given_, context_);
    return search();
  }

  /// What it costs that each effect was the best of many candidates: 2 log(tried), as in the
  /// extended BIC (Chen and Chen, Biometrika 95 (2008)).
  static double price_of_choice(const SearchResult& found) {
    Index tried = 1;
    for (const Round& round : found.rounds) tried = std::max(tried, round.tried);
    return 2.0 * static_cast<double>(found.named.size()) * std::log(static_cast<double>(tried));
  }

  /// The criterion with what the choice of effects and noise with a memory cost.
  static double full_price(const SearchResult& found) {
    const NoiseModel& noise = found.explanation.fit.noise;
    const auto coloured =
        std::count_if(noise.coloured.begin(), noise.coloured.end(),
                      [](const auto& channel) { return channel.has_value(); });
    return criterion_of(found.explanation) + price_of_choice(found) +
           2.0 * static_cast<double>(coloured) *
               std::log(static_cast<double>(found.explanation.fit.used));
  }

  /// Yet another explanation: an identity does not hold in what was measured. It is an equation
  /// like others then, with a coefficient to fit, and the search is repeated.
  SearchResult or_broken_identities(SearchResult found) {
    auto broken = with_broken_identities(nominal_, data_, *given_, found.explanation.fit.noise,
                                         options_, context_);
    if (!broken) return found;
    const auto before = std::tuple(given_, fitted_, scope_, fit_options_.free);
    for (Index k = 0; k < nominal_.dimension(); ++k)
      if (broken->noise.disturbance[k] > 0.0 && given_->noise.disturbance[k] == 0.0)
        fit_options_.free.push_back({k, 0});
    const std::size_t more = fit_options_.free.size() - std::get<3>(before).size();
    given_ = std::move(broken);
    fit_nominal();
    SearchResult other = search();
    const double price =
        2.0 * static_cast<double>(more) * std::log(static_cast<double>(given_->used));
    if (full_price(other) + price < full_price(found)) {
      result_.disagreement = locate(*given_, context_);
      result_.notes.push_back(
          "the records contradict an identity: what is measured of a state and of its rate "
          "does "
          "not fit together, as with an offset or a gain of a sensor");
      return other;
    }
    std::tie(given_, fitted_, scope_, fit_options_.free) = before;
    return found;
  }

  Assimilation best_coloured() const {
    context_.report("fitting noise with a memory", 0.0);
    Assimilation start = *fitted_;
    start.noise = with_coloured_noise(*fitted_, context_);
    return assimilate_from(fitted_->model, data_, start, fit_options_, context_);
  }

  void conclude(SearchResult& found) {
    result_.rounds = found.rounds;
    const bool left = any_substantial(found.left);
    if (left && !closes_most(found)) {
      found.named.clear();
      found.explanation = {{}, *fitted_};
      found.left = test_structure(*fitted_, context_);
      result_.unnamed = describe_unnamed(unexplained(), options_.fill_gap, found.explanation);
    } else if (left) {
      take_refitted(found);
      if (options_.fill_gap) fill_what_is_left(found);
    }
    result_.effects = found.named;
    final_ = found.explanation;
    result_.noise = final_.fit.noise;
    result_.coefficient_changes =
        coefficient_changes(nominal_, final_.fit, fit_options_.free.size());
    set_remaining(found.left);
    result_.verdict = verdict(left);
    result_.augmented =
        result_.verdict == Verdict::NoDiscrepancy ? nominal_ : with_intervals(final_.fit);
  }

  /// A stop-gap beside the named effects, which keep their names and get new coefficients.
  void fill_what_is_left(SearchResult& found) {
    auto filled = with_polynomials(unexplained(), found.left, found.explanation);
    if (!filled) return;
    found.explanation = std::move(*filled);
    update_numbers(found.explanation, found.named);
    result_.notes.push_back(
        "polynomials fill, as a stop-gap, what the named effects leave; they stand in the "
        "augmented model and explain nothing");
  }

  /// Whether the effects take away more than half of the disturbances, or leave no more than a
  /// tenth (of the square) of the gap in windows; less is no explanation.
  bool closes_most(const SearchResult& found) const {
    if (found.named.empty()) return false;
    const Vector rates = rate_rms(*fitted_);
    const double before = total_disturbance(*fitted_, rates);
    const double after = total_disturbance(found.explanation.fit, rates);
    return after < 0.5 * before || shows_the_motion(found);
  }

  /// Whether the effects leave no more than a tenth of the square of the gap in windows: what
  /// lasts is theirs, whatever happens within a step.
  bool shows_the_motion(const SearchResult& found) const {
    constexpr double kTenth = 0.1;
    if (found.named.empty()) return false;
    const Explanation& explanation = found.refitted ? *found.refitted : found.explanation;
    return Substance(*fitted_, data_, fit_options_, context_).gap(explanation.fit) < kTenth;
  }

  void tell_of_memory() {
    const auto& coloured = result_.noise.coloured;
    if (std::none_of(coloured.begin(), coloured.end(),
                     [](const auto& c) { return c.has_value(); }))
      return;
    const std::string channels = channels_with_memory(result_.noise, nominal_);
    result_.notes.push_back("the measurement noise has a memory" +
                            (channels.empty() ? "" : " (" + channels + ")") +
                            ", which explains the records better than any effect with white "
                            "noise");
  }

  void gauge_on(const Dataset& held_out) {
    result_.gap.reset();
    Gap gap = gauge(nominal_, final_, held_out, context_);
    if (gap.diverged > 0)
      result_.notes.push_back(
          "on the records that were not used, models have no finite solution "
          "in " +
          std::to_string(gap.diverged) + " windows; they are left out of the gap");
    if (std::isfinite(gap.before) && std::isfinite(gap.after)) result_.gap = std::move(gap);
  }

  /// What makes other records worse is no effect; neither is what they do not show where noise
  /// that is not independent seems to show it.
  void hear_other_records(SearchResult& found, const Dataset& held_out) {
    const CarryOver carried = carry_over(final_, result_.gap);
    if (carried == CarryOver::Refuted) {
      withdraw_names(found, "worse; what fails there gets no name");
      gauge_on(held_out);
    } else if (carried == CarryOver::Little && mostly_repeats(records_)) {
      withdraw_names(found,
                     "hardly; most samples repeat the one before (coarse quantisation), and "
                     "what they show beyond that gets no name");
      gauge_on(held_out);
    } else if (carried == CarryOver::Little) {
      result_.verdict = Verdict::PartlyExplained;
      result_.remaining.structure = true;
      result_.notes.push_back(
          "most of the gap on the records that were not used stays: the names hold for the "
          "records that were used, or something else acts in the others");
    }
  }

  /// @param others how the model fits the records that were not used.
  void withdraw_names(SearchResult& found, const std::string& others) {
    std::vector<std::string> names;
    for (const NamedEffect& effect : found.named)
      names.push_back(effect.name + " in " +
                      nominal_.states()[static_cast<std::size_t>(effect.equation)].name);
    result_.notes.push_back(
        "with " + join(names, ", ") +
        " the model fits the records that were used better and the others " + others);
    found.named.clear();
    found.explanation = {{}, *fitted_};
    found.left = test_structure(*fitted_, context_);
    conclude(found);
  }

  void set_remaining(const std::vector<EquationStructure>& left) {
    result_.remaining = {};
    for (const EquationStructure& structure : left) {
      result_.remaining.sigma = std::max(result_.remaining.sigma, structure.sigma);
      if (!is_substantial(structure, options_)) continue;
      result_.remaining.equations.push_back(structure.equation);
      result_.remaining.details.push_back(structure);
    }
    result_.remaining.structure = !result_.remaining.equations.empty();
  }

  Verdict verdict(bool left) const {
    if (!result_.effects.empty()) return left ? Verdict::PartlyExplained : Verdict::Explained;
    if (left) return Verdict::UnnamedStructure;
    return coefficients_off() ? Verdict::CoefficientsOnly : Verdict::NoDiscrepancy;
  }

  /// Whether the fit of the coefficients is a significant gain, and of substance in some
  /// equation.
  bool coefficients_off() const {
    const double gain = given_->deviance - fitted_->deviance;
    const auto free = static_cast<double>(fit_options_.free.size());
    if (sigma_of_gain(gain, free, 1.0) < options_.significance) return false;
    return largest_rate_change(nominal_, *fitted_) >= options_.substance;
  }

  const OdeModel& nominal_;
  const BoundRecords& records_;
  const Dataset& data_;
  const DiagnosisOptions& options_;
  const RunContext& context_;
  AssimilationOptions fit_options_;
  std::optional<Assimilation> given_, fitted_;
  std::optional<Scope> scope_;
  Explanation final_{{}, {nominal_}};
  Diagnosis result_;
};

}  // namespace

std::string to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::NoDiscrepancy:
      return "no-discrepancy";
    case Verdict::CoefficientsOnly:
      return "coefficients-only";
    case Verdict::Explained:
      return "explained";
    case Verdict::PartlyExplained:
      return "partly-explained";
    case Verdict::UnnamedStructure:
      return "unnamed-structure";
  }
  return "";
}

Diagnosis diagnose(const OdeModel& nominal, const Dataset& data, const Dataset& held_out,
                   const DiagnosisOptions& options, const RunContext& context) {
  if (lacks_input_columns(data) || lacks_input_columns(held_out))
    return diagnose(nominal, with_input_columns(data), with_input_columns(held_out), options,
                    context);
  const UsableRecords records = usable_records(data);
  const UsableRecords others =
      held_out.trajectories.empty() ? UsableRecords{} : usable_records(held_out);
  const auto [find, check] = held_out.trajectories.empty()
                                 ? split_in_time(records.data)
                                 : SplitRecords{records.data, others.data};
  Diagnosis result = Workflow(nominal, observed(find), options, context).run(check);
  std::vector<std::string> notes = records.notes;
  for (const std::string& note : others.notes) notes.push_back("held-out records: " + note);
  result.notes.insert(result.notes.begin(), notes.begin(), notes.end());
  return result;
}

}  // namespace lacuna
