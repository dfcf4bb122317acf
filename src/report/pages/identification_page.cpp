// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "core/base/text.hpp"
#include "core/statistics/determined.hpp"
#include "diagnosis_sentences.hpp"
#include "folded_text.hpp"
#include "free_runs.hpp"
#include "readable.hpp"
#include "invariant_text.hpp"
#include "report/json/stage_json.hpp"
#include "report/pages/pages.hpp"
#include "report/plot/mathml.hpp"
#include "run_figures.hpp"

namespace lacuna {
namespace {

bool is_fitted(const EquationFit& fit) { return !fit.identity; }

bool lacks_terms(const IdentificationResult& result) {
  for (std::size_t k = 0; k < result.fit.size(); ++k)
    if (is_fitted(result.fit[k]) && result.model.equations()[k].empty()) return true;
  return false;
}

/// Names of the equations for which `holds` is true.
template <class Holds>
std::vector<std::string> equations_where(const IdentificationResult& result, Holds holds) {
  std::vector<std::string> names;
  for (const EquationFit& fit : result.fit)
    if (is_fitted(fit) && holds(fit))
      names.push_back(left_hand_side(fit.equation, result.model.evolution()));
  return names;
}

struct ModelSize {
  std::size_t terms = 0, equations = 0;
};

/// Identities are known and do not count.
ModelSize size_of(const IdentificationResult& result) {
  ModelSize size;
  for (std::size_t k = 0; k < result.fit.size(); ++k) {
    if (!is_fitted(result.fit[k])) continue;
    size.terms += result.model.equations()[k].size();
    ++size.equations;
  }
  return size;
}

/// "33 terms in 3 equations describe the record to its noise."
std::string sized(const ModelSize& size, const std::string& singular, const std::string& plural) {
  const auto counted = [](std::size_t count, const std::string& word) {
    return std::to_string(count) + " " + word + (count == 1 ? "" : "s");
  };
  return counted(size.terms, "term") + " in " + counted(size.equations, "equation") + " " +
         (size.terms == 1 ? singular : plural);
}

std::string worth_of(const ModelSize& size, ValidationVerdict verdict) {
  switch (verdict) {
    case ValidationVerdict::FitsToNoise:
      return sized(size, "describes the record to its noise.",
                   "describe the record to its noise.");
    case ValidationVerdict::Approximation:
      return sized(size, "describes the record roughly, not to its noise.",
                   "describe the record roughly, not to its noise.");
    case ValidationVerdict::WrongLibrary:
      return sized(size, "does not describe the record: it needs other terms.",
                   "do not describe the record: it needs other terms.");
    case ValidationVerdict::Incomplete:
      return sized(size, "was found; the search was cut before it could be judged.",
                   "were found; the search was cut before they could be judged.");
    case ValidationVerdict::Undecided:
      break;
  }
  return sized(size, "was found; the record does not show whether it holds.",
               "were found; the record does not show whether they hold.");
}

/// The headline of a validated model; the sentence with numbers is the first finding.
void report_verdict(const IdentificationResult& result, Page& page) {
  const Validation& validation = *result.validation;
  page.headline = worth_of(size_of(result), validation.verdict);
  page.findings = {validation.sentence};
  switch (validation.verdict) {
    case ValidationVerdict::FitsToNoise:
      page.tone = Tone::Good;
      break;
    case ValidationVerdict::WrongLibrary:
      page.tone = Tone::Bad;
      break;
    default:
      page.tone = Tone::Doubtful;
  }
}

void report_headline(const IdentificationReport& report, Page& page) {
  const IdentificationResult& result = report.result;
  const auto bad = equations_where(
      result, [](const EquationFit& fit) { return fit.fits_to_noise == false; });
  const auto unknown =
      equations_where(result, [](const EquationFit& fit) { return !fit.fits_to_noise; });
  if (lacks_terms(result)) {
    page.headline = std::string("An equation has no terms: no candidate explains its ") +
                    (result.model.is_map() ? "next value." : "derivative.");
    page.tone = Tone::Bad;
  } else if (result.validation) {
    report_verdict(result, page);
  } else if (!bad.empty()) {
    page.headline = "Equations were found, but not all fit to the noise: " + join(bad, ", ") +
                    (bad.size() == 1 ? " does not." : " do not.");
    page.tone = Tone::Doubtful;
  } else if (!unknown.empty() || result.adequacy.fits == Adequate::Undetermined) {
    page.headline = "Equations were found; how large the noise is cannot be estimated.";
  } else {
    page.headline = worth_of(size_of(result), ValidationVerdict::FitsToNoise);
  }
  if (report.sync && !report.sync->result.settled) page.tone = Tone::Doubtful;
}

std::vector<std::string> findings_of(const IdentificationResult& result) {
  std::vector<std::string> sentences;
  for (const EquationFit& fit : result.fit) {
    if (!is_fitted(fit)) continue;
    std::string text = left_hand_side(fit.equation, result.model.evolution()) + ": residual " +
                       format_number(fit.residual_rms, 3) + " of " +
                       format_number(fit.target_rms, 3) + " rms";
    if (fit.noise_floor) text += ", noise alone gives " + format_number(*fit.noise_floor, 3);
    if (fit.misfit)
      text += std::isfinite(*fit.misfit)
                  ? "; trajectories are off by " + format_number(*fit.misfit, 3) +
                        " times the noise"
                  : "; trajectories leave the range of numbers";
    sentences.push_back(text + ".");
  }
  for (const DeadTime& late : result.dead_times)
    sentences.push_back(dead_time_sentence(late, result.model.time_unit()) + ".");
  if (result.validation)
    sentences.insert(sentences.end(), result.validation->advice.begin(),
                     result.validation->advice.end());
  for (const Relation& relation : result.relations)
    sentences.push_back(relation_sentence(relation) + ".");
  if (const auto& region = result.trapping.region)
    sentences.push_back(trapping_sentence(result.model, *region) + ".");
  return sentences;
}

std::vector<Fact> facts_of(const IdentificationReport& report, const Dataset& data,
                           const std::vector<GapRecord>& runs) {
  const IdentificationResult& result = report.result;
  std::size_t terms = 0;
  for (const Equation& equation : result.model.equations()) terms += equation.size();
  std::vector<Fact> facts;
  facts.push_back({"Terms", std::to_string(terms),
                   "kept of " + std::to_string(result.trail.size()) + " candidates"});
  facts.push_back({"Data", std::to_string(data.samples()) + " samples",
                   std::to_string(data.trajectories.size()) +
                       (data.trajectories.size() == 1 ? " record" : " records")});
  if (!runs.empty())
    facts.push_back({"Free run", percent(relative_misfit(runs, false)),
                     "off after a mean period, of the spread"});
  if (report.sync)
    facts.push_back({"Synchronisation", percent(report.sync->result.relative),
                     report.sync->result.settled ? "relative error, settled"
                                                 : "relative error, did not settle"});
  for (Index k = 0; k < std::min<Index>(result.noise.size(), 3); ++k) {
    const Quantity& state = result.model.states()[static_cast<std::size_t>(k)];
    facts.push_back(
        {"Noise of " + state.name,
         format_number(result.noise[k], 2) + (state.unit.empty() ? "" : " " + state.unit),
         "standard deviation"});
  }
  return facts;
}

std::string interval_text(const WeightedTerm& summand) {
  if (!summand.ci95) return "-";
  const double half = (*summand.ci95)[1] / 2.0 - (*summand.ci95)[0] / 2.0;
  if (!is_determined(summand.coefficient, half)) return "not determined";
  const int digits = digits_of(summand.coefficient, half);
  return format_number((*summand.ci95)[0], digits) + " to " +
         format_number((*summand.ci95)[1], digits);
}

std::string with_unit_of_term(const std::string& unit) {
  return (unit.empty() ? "1" : unit) + " per unit of the term";
}

PageSection coefficients(const OdeModel& model) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t k = 0; k < model.equations().size(); ++k)
    for (const WeightedTerm& summand : model.equations()[k])
      rows.push_back({left_hand_side(model.states()[k].name, model.evolution()),
                      readable_formula(summand.term.name(), {}), coefficient_text(summand),
                      interval_text(summand),
                      with_unit_of_term(target_unit(model, static_cast<Index>(k)))});
  return {"Coefficients",
          table({"equation", "term", "coefficient", "95 % interval", "unit"}, rows)};
}

/// Errors of both tests of a validation.
PageSection prediction_section(const Validation& validation) {
  std::vector<std::vector<std::string>> rows;
  for (const PredictionTest* test : {&validation.one_step, &validation.windows})
    for (const PredictionError& state : test->states)
      rows.push_back({format_number(test->horizon, 3), state.state,
                      format_number(state.error, 3),
                      (state.noise_estimated ? "" : "< ") + format_number(state.noise, 3),
                      format_number(state.motion, 3), percent(state.fraction())});
  return {"Predictions of samples held out",
          table({"ahead [" + validation.time_unit + "]", "state", "error", "noise",
                 "error without a model", "error beyond the noise"},
                rows)};
}

PageSection trail_section(const IdentificationResult& result) {
  std::vector<std::vector<std::string>> rows;
  for (const TrailEntry& entry : result.trail)
    rows.push_back({left_hand_side(entry.equation, result.model.evolution()),
                    readable_formula(entry.term, {}),
                    entry.kept ? "kept" : "removed by " + entry.stage, entry.quantity,
                    format_number(entry.value, 4),
                    entry.kept ? "" : format_number(entry.threshold, 4)});
  return {"What became of every candidate term",
          table({"equation", "term", "", "looked at", "value", "limit"}, rows),
          {},
          true};
}

void add_pictures(const RunView& view, Page& page) {
  page.sections.push_back(
      {"Measured and modelled",
       element("p", Markup::text("The model runs freely in windows of one mean period, each "
                                 "from the initial state that fits best. Click a name to "
                                 "hide or show a curve.")),
       comparison_pictures(view)});
  page.sections.push_back({"Orbit", {}, orbit_pictures(view)});
  page.sections.push_back({"What the model leaves", {}, deviation_pictures(view)});
  page.sections.push_back({"At which frequencies", {}, spectrum_pictures(view), true});
}

}  // namespace

Page identification_page(const IdentificationReport& report, const Dataset& data) {
  const IdentificationResult& result = report.result;
  // The curves of a map between its samples would mean nothing.
  const std::vector<GapRecord> runs = result.model.is_map()
                                          ? std::vector<GapRecord>()
                                          : free_runs(result.model, data, result.noise);
  const RunView view{runs, data.states, data.time_unit, result.noise};
  Page page;
  page.title =
      "Identification of " +
      (data.trajectories.empty() ? "a record" : short_name(file_of(data.trajectories.front())));
  report_headline(report, page);
  const std::vector<std::string> findings = findings_of(result);
  page.findings.insert(page.findings.end(), findings.begin(), findings.end());
  page.facts = facts_of(report, data, runs);
  page.equations = equations_mathml(result.model);
  if (!runs.empty()) add_pictures(view, page);
  if (!data.states.empty()) show_first(page, "comparison_" + data.states.front().name);
  page.sections.push_back(coefficients(result.model));
  if (result.validation) page.sections.push_back(prediction_section(*result.validation));
  if (!result.warnings.empty())
    page.sections.push_back({"What to know", bullets(said_once(result.warnings))});
  page.sections.push_back(trail_section(result));
  page.sections.push_back({"Stages that were used",
                           element("code", Markup::text(format_pipeline(report.pipeline))),
                           {},
                           true});
  return page;
}

}  // namespace lacuna
