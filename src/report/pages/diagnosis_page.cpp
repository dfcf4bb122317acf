// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/text.hpp"
#include "diagnosis_sentences.hpp"
#include "lacuna/core/statistics/interval.hpp"
#include "readable.hpp"
#include "report/pages/pages.hpp"
#include "report/plot/mathml.hpp"
#include "run_figures.hpp"

namespace lacuna {
namespace {

constexpr std::size_t kMostRows = 24;  // of a figure; all are in the tables

Tone tone_of(const Diagnosis& diagnosis) {
  if (withheld_by(diagnosis.hints) != Withheld::Nothing) return Tone::Bad;
  switch (diagnosis.verdict) {
    case Verdict::NoDiscrepancy:
    case Verdict::CoefficientsOnly:
    case Verdict::Explained:
      return Tone::Good;
    case Verdict::PartlyExplained:
    case Verdict::Undetermined:
    case Verdict::Incomplete:
      return Tone::Doubtful;
    case Verdict::UnnamedStructure:
      return diagnosis.remaining.equations.empty() ? Tone::Doubtful : Tone::Bad;
  }
  return Tone::Bad;
}

std::vector<Fact> facts_of(const Diagnosis& diagnosis) {
  std::vector<Fact> facts;
  if (diagnosis.gap) {
    const Gap& gap = *diagnosis.gap;
    facts.push_back({"Gap before", percent(gap.before), "of the spread, on records not used"});
    facts.push_back(
        {"Gap after", percent(gap.after), "noise alone: " + percent(gap.noise_floor)});
  }
  for (const NamedEffect& effect : diagnosis.effects)
    facts.push_back({(diagnosis.admission.stands() ? "" : "Candidate: ") + effect.name,
                     format_number(effect.sigma, 3) + " sigma",
                     "probability " + percent(effect.probability) + ", explains " +
                         percent(effect.gap_closed)});
  if (!diagnosis.remaining.equations.empty())
    facts.push_back({"Residual", format_number(diagnosis.remaining.sigma, 3) + " sigma",
                     "significant structure"});
  return facts;
}

/// Terms of the augmented model that the nominal one does not have.
TermNames fresh_terms(const Diagnosis& diagnosis) {
  TermNames fresh;
  for (Index k = 0; k < diagnosis.augmented.dimension(); ++k)
    for (const WeightedTerm& summand :
         diagnosis.augmented.equations()[static_cast<std::size_t>(k)])
      if (k >= diagnosis.nominal.dimension() ||
          diagnosis.nominal.coefficient(k, summand.term.name()) == 0.0)
        fresh.emplace(k, summand.term.name());
  return fresh;
}

std::vector<Picture> place_pictures(const Diagnosis& diagnosis) {
  std::vector<Picture> pictures;
  for (const Disagreement& entry : diagnosis.disagreement) {
    const std::string& state = state_name(diagnosis, entry.equation);
    RowFigure figure{"where_" + state,
                     "Equation " + state + ": where the nominal model and the records disagree",
                     "significance [sigma]",
                     {}};
    for (const Location& place : entry.where) {
      if (figure.rows.size() == kMostRows) break;
      const std::string label = place.frequency
                                    ? "frequency " + format_number(*place.frequency, 3) +
                                          " 1/" + diagnosis.nominal.time_unit()
                                    : place.variable + " in " + format_number(place.low, 3) +
                                          " .. " + format_number(place.high, 3);
      figure.rows.push_back({label, place.sigma, {}, {}, format_number(place.sigma, 3), false});
    }
    if (!figure.rows.empty()) pictures.push_back(draw(figure));
  }
  return pictures;
}

/// Changes relative to the nominal value with their intervals.
std::vector<Picture> change_pictures(const Diagnosis& diagnosis) {
  RowFigure figure{"coefficients",
                   "Estimated coefficients beside the nominal ones",
                   "change [% of the nominal value]",
                   {},
                   true};
  for (const CoefficientChange& change : diagnosis.coefficient_changes) {
    if (change.nominal == 0.0 || figure.rows.size() == kMostRows) continue;
    const auto relative = [&](double value) {
      return 100.0 * (value - change.nominal) / std::abs(change.nominal);
    };
    const auto interval = change.ci95();
    figure.rows.push_back({state_name(diagnosis, change.equation) + ": " +
                               readable_formula(change.term, {}),
                           relative(change.estimated), relative(interval[0]),
                           relative(interval[1]), format_number(change.sigma, 2) + " sigma",
                           change.sigma >= 3.0});
  }
  if (figure.rows.empty()) return {};
  return {draw(figure)};
}

Markup change_table(const Diagnosis& diagnosis) {
  std::vector<std::vector<std::string>> rows;
  for (const CoefficientChange& change : diagnosis.coefficient_changes) {
    const double half = kNormalQuantile975 * change.deviation;
    rows.push_back({state_name(diagnosis, change.equation),
                    readable_formula(change.term, {}),
                    format_number(change.nominal, 6), with_error(change.estimated, half),
                    format_number(change.sigma, 3)});
  }
  return table({"equation", "term", "nominal", "estimated", "sigma"}, rows);
}

/// The quantity that most rivals with a number were judged by.
std::string common_quantity(const std::vector<Rival>& rivals) {
  std::map<std::string, int> counts;
  for (const Rival& rival : rivals)
    if (rival.criterion) ++counts[rival.quantity];
  const auto most =
      std::max_element(counts.begin(), counts.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == counts.end() ? "" : most->first;
}

/// What each composite model was worse by than the best, the best first.
std::vector<Picture> rival_pictures(const Diagnosis& diagnosis) {
  const std::string quantity = common_quantity(diagnosis.rivals);
  std::map<std::string, const Rival*> best;  // of each composite model, its least number
  for (const Rival& rival : diagnosis.rivals) {
    if (!rival.criterion || rival.quantity != quantity) continue;
    const Rival*& known = best[readable_formula(rival.composite, {})];
    if (known == nullptr || rival.value < known->value) known = &rival;
  }
  std::vector<std::pair<double, std::string>> ranked;
  for (const auto& [composite, rival] : best) ranked.emplace_back(rival->value, composite);
  std::sort(ranked.begin(), ranked.end());
  if (ranked.size() < 2) return {};
  RowFigure figure{"rivals",
                   "Composite models of the records: how much worse than the best",
                   quantity + " above the least",
                   {}};
  for (const auto& [value, composite] : ranked) {
    if (figure.rows.size() == kMostRows) break;
    const double worse = value - ranked.front().first;
    figure.rows.push_back(
        {composite, worse, {}, {}, "+ " + format_number(worse, 4), best.at(composite)->taken});
  }
  return {draw(figure)};
}

Markup rival_table(const Diagnosis& diagnosis) {
  std::vector<std::vector<std::string>> rows;
  for (const Rival& rival : diagnosis.rivals)
    rows.push_back({rival.taken ? "taken" : "not taken", rival.hypothesis,
                    readable_formula(rival.composite, {}),
                    rival.rule.empty() ? rival.quantity + " " + format_number(rival.value, 6) +
                                             " against " + format_number(rival.threshold, 6)
                                       : rival.rule});
  return table({"", "hypothesis", "composite model", "what decided"}, rows);
}

Vector noise_of(const Diagnosis& diagnosis) {
  Vector noise = Vector::Zero(diagnosis.nominal.dimension());
  for (Index k = 0; k < noise.size(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    if (at < diagnosis.noise.measurement.size())
      noise[k] = diagnosis.noise.measurement[at].value_or(0.0);
  }
  return noise;
}

/// The state that the answer is about: of the first effect, else where it disagrees most.
Index main_state(const Diagnosis& diagnosis) {
  if (!diagnosis.effects.empty()) return diagnosis.effects.front().equation;
  return diagnosis.disagreement.empty() ? 0 : diagnosis.disagreement.front().equation;
}

void add_runs(const Diagnosis& diagnosis, Page& page) {
  if (!diagnosis.gap || diagnosis.gap->runs.empty()) return;
  const RunView view{diagnosis.gap->runs,
                     diagnosis.nominal.states(),
                     diagnosis.nominal.time_unit(),
                     noise_of(diagnosis),
                     "nominal model",
                     "augmented model"};
  page.sections.push_back(
      {"Measured and modelled, before and after",
       element("p", Markup::text("Records that were not used to find anything. Both models "
                                 "run freely " +
                                 stretch_text(view) +
                                 ", each from the initial state that fits best. Click "
                                 "a name to hide or show a curve.")),
       comparison_pictures(view)});
  page.sections.push_back({"What the models leave", {}, deviation_pictures(view)});
  page.sections.push_back({"At which frequencies", {}, spectrum_pictures(view), true});
}

}  // namespace

Page diagnosis_page(const Diagnosis& diagnosis) {
  const DiagnosisSentences sentences = sentences_of(diagnosis);
  Page page;
  page.title = "Diagnosis: what the model lacks";
  page.headline = sentences.headline;
  page.tone = tone_of(diagnosis);
  const bool hints_first = withheld_by(diagnosis.hints) != Withheld::Nothing;
  if (hints_first) page.first = sentences.hints;
  page.findings = sentences.findings;
  page.facts = facts_of(diagnosis);
  page.equations = equations_mathml(diagnosis.augmented, fresh_terms(diagnosis));
  std::vector<std::string> known = sentences.notes;
  if (!hints_first) known.insert(known.begin(), sentences.hints.begin(), sentences.hints.end());
  page.sections.push_back({"What to know", bullets(known)});
  add_runs(diagnosis, page);
  page.sections.push_back({"Where they disagree", {}, place_pictures(diagnosis)});
  page.sections.push_back(
      {"Coefficients", change_table(diagnosis), change_pictures(diagnosis)});
  page.sections.push_back({"Rivals", {}, rival_pictures(diagnosis)});
  page.sections.push_back(
      {"Every composite model that was judged", rival_table(diagnosis), {}, true});
  show_first(page, "deviation_" + state_name(diagnosis, main_state(diagnosis)));
  // A heading over nothing says less than none.
  std::erase_if(page.sections, [](const PageSection& section) {
    return section.content.empty() && section.pictures.empty();
  });
  return page;
}

}  // namespace lacuna
