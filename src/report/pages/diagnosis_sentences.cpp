// SPDX-License-Identifier: MIT
#include "diagnosis_sentences.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>

#include "core/base/text.hpp"
#include "folded_text.hpp"
#include "lacuna/core/statistics/interval.hpp"
#include "lacuna/diagnose/hypotheses/composite_model.hpp"
#include "readable.hpp"

namespace lacuna {
namespace {

/// Coefficients further off than this are reported.
constexpr double kSignificant = 3.0;

/// Spreads of the states from where on their means are nearer than a run.
constexpr double kMeanIsNearer = 1.0;

const Quantity& state_of(const Diagnosis& diagnosis, Index equation) {
  return diagnosis.nominal.states()[static_cast<std::size_t>(equation)];
}

std::string rate_unit_of(const Diagnosis& diagnosis, Index equation) {
  return rate_unit(state_of(diagnosis, equation).unit, diagnosis.nominal.time_unit());
}

/// A fraction of something below which it says no more than that.
constexpr double kHardlyAny = 1e-3;

std::string fraction_of(double fraction) {
  return fraction < kHardlyAny ? "less than 0.1 %" : percent(fraction);
}

/// A number of a formula for people: a parameter to the digits that its error allows.
std::string readable_number(const std::string& text,
                            const std::vector<NamedParameter>& parameters) {
  const std::optional<double> value = parse_number(text);
  if (!value || text.size() <= 6) return text;
  if (*value == std::numbers::pi) return "pi";
  for (const NamedParameter& parameter : parameters)
    if (parameter.deviation && std::abs(parameter.value) == *value)
      return format_number(*value,
                           digits_of(*value, kNormalQuantile975 * *parameter.deviation));
  return format_number(*value, 4);
}

std::string hint_sentence(const Hint& hint) {
  return "Hint (" + to_string(hint.kind) + "): " + hint.message + ". Remedy: " + hint.remedy +
         ".";
}

/// What was gained on other records, and what has no name; or what is against names that leave
/// nothing.
std::string partly_explained(const Diagnosis& diagnosis) {
  if (diagnosis.remaining.equations.empty() && !diagnosis.reservations.empty())
    return "Partly explained: what is named leaves no significant structure in the records "
           "that "
           "were used, but " +
           diagnosis.reservations.front() + ".";
  if (diagnosis.remaining.equations.empty() && !diagnosis.twins.empty()) {
    std::vector<std::string> choices{names_in_places(diagnosis.effects, diagnosis.nominal)};
    for (const Twin& twin : diagnosis.twins) choices.push_back(twin.what);
    return "Explained but for the choice between " + join(choices, " and ") + ".";
  }
  const std::string rest =
      "Partly explained: effects are named, but significant structure is left";
  const auto& gap = diagnosis.gap;
  if (!gap || !(gap->after < gap->before) || !std::isfinite(gap->before)) return rest + ".";
  return rest + ": on other records the gap falls from " + percent(gap->before, "the motion") +
         " to " + percent(gap->after, "the motion") +
         " (noise alone: " + percent(gap->noise_floor) + ").";
}

std::string headline(const Diagnosis& diagnosis) {
  if (withheld_by(diagnosis.hints) == Withheld::Answer)
    return "No effect is sought: the records and the model do not fit together.";
  switch (diagnosis.verdict) {
    case Verdict::NoDiscrepancy:
      return "No discrepancy: the model fits the records to their noise.";
    case Verdict::CoefficientsOnly:
      return "No structure is missing; coefficients are off.";
    case Verdict::Explained:
      return "Explained: what is missing has a name, nothing significant is left.";
    case Verdict::PartlyExplained:
      return partly_explained(diagnosis);
    case Verdict::UnnamedStructure:
      if (withheld_by(diagnosis.hints) != Withheld::Nothing)
        return "Something is missing; no effect is named, the hint comes first.";
      if (diagnosis.gap && diagnosis.gap->free_after &&
          !(diagnosis.gap->free_after->apart <= kMeanIsNearer))
        return "No model yet: run freely, it leaves the records that were not used; what is "
               "missing has no name.";
      if (diagnosis.remaining.equations.empty())
        return "No structure is missing in the records that were used; on others a gap stays.";
      return "Something is missing that no known effect explains.";
    case Verdict::Undetermined:
      return "Undetermined: " + diagnosis.admission.why + ".";
    case Verdict::Incomplete:
      return "Not finished; " + diagnosis.admission.why + ".";
  }
  return "";
}

using Sentences = std::vector<std::string>;

/// The number of an effect that has such a name.
const NamedParameter* find_parameter(const NamedEffect& effect, const std::string& name) {
  for (const NamedParameter& parameter : effect.parameters)
    if (parameter.name == name) return &parameter;
  return nullptr;
}

/// ", a force of 0.8 rad/s^2" of friction that is written as a slope with an end; ", 8 before
/// and 5.4 from 11.16 +- 0.01 s on" of a coefficient that changes.
std::string known_by(const NamedEffect& effect, const std::string& unit,
                     const std::string& time_unit) {
  if (const NamedParameter* force = find_parameter(effect, "force"))
    return ", a force of " + format_number(force->value, 3) + (unit.empty() ? "" : " " + unit);
  const NamedParameter* before = find_parameter(effect, "before");
  const NamedParameter* after = find_parameter(effect, "after");
  const NamedParameter* time = find_parameter(effect, "time");
  if (!before || !after || !time) return "";
  return ", " + format_number(before->value, 4) + " before and " +
         format_number(after->value, 4) + " from " +
         with_error(time->value, kNormalQuantile975 * time->deviation.value_or(0.0)) +
         (time_unit.empty() ? "" : " " + time_unit) + " on";
}

void report_effect(const Diagnosis& diagnosis, const NamedEffect& effect, Sentences& out) {
  const bool acts = effect.place == Place::Rate;
  const std::string unit = acts ? rate_unit_of(diagnosis, effect.equation)
                                : state_of(diagnosis, effect.equation).unit;
  out.push_back((diagnosis.admission.stands() ? "" : "A candidate, no finding. ") +
                std::string(acts ? "Equation " : "Channel ") +
                state_name(diagnosis, effect.equation) + ": " + effect.description + " (" +
                effect.name + "), " +
                with_error(effect.coefficient, kNormalQuantile975 * effect.deviation) +
                (unit.empty() ? "" : " " + unit) + " * " +
                readable_formula(effect.term, effect.parameters) +
                known_by(effect, unit, diagnosis.nominal.time_unit()) + ", explains " +
                fraction_of(effect.gap_closed) + " of the disagreement (" +
                format_number(effect.sigma, 3) + " sigma).");
  for (const Alternative& other : effect.alternatives)
    if (other.probability >= 0.01 && other.term != effect.term)
      out.push_back(
          "  It might also be " + other.name + " " + readable_formula(other.term, {}) +
          (other.probability > effect.probability
               ? ", which the records do not distinguish from it: the plainer form leads."
               : " (probability " + percent(other.probability) + ")."));
}

void report_changes(const Diagnosis& diagnosis, Sentences& out) {
  // For people.
  constexpr int kMostChanges = 4;
  int off = 0;
  for (const CoefficientChange& change : diagnosis.coefficient_changes) {
    if (change.sigma < kSignificant) break;
    if (std::abs(change.estimated - change.nominal) < 1e-3 * std::abs(change.nominal)) continue;
    if (++off > kMostChanges) continue;
    out.push_back("Equation " + state_name(diagnosis, change.equation) +
                  ": the coefficient of " + readable_formula(change.term, {}) + " is " +
                  with_error(change.estimated, kNormalQuantile975 * change.deviation) +
                  ", not " + format_number(change.nominal, 6) + " (" +
                  format_number(change.sigma, 3) + " sigma).");
  }
  if (off > kMostChanges)
    out.push_back("And " + std::to_string(off - kMostChanges) +
                  " more (--json has all of them, and --explain the model).");
}

/// Two coefficients that are off together.
std::string combined_sentence(const Diagnosis& diagnosis, const CombinedChange& change) {
  return "Equation " + state_name(diagnosis, change.equation) + ": the coefficient of " +
         change.first + (change.weight < 0.0 ? " less " : " plus ") +
         format_number(std::abs(change.weight), 4) + " times that of " + change.second +
         " is " + with_error(change.estimated, kNormalQuantile975 * change.deviation) +
         ", not " + format_number(change.nominal, 6) + " (" + format_number(change.sigma, 3) +
         " sigma); how much each is off is not determined.";
}

/// Where the nominal model and the records disagree most, in a state or input.
std::string main_place(const Diagnosis& diagnosis, Index equation) {
  for (const Disagreement& entry : diagnosis.disagreement)
    if (entry.equation == equation)
      for (const Location& place : entry.where)
        if (!place.frequency)
          return ", mostly where " + place.variable + " is in " + format_number(place.low, 3) +
                 " .. " + format_number(place.high, 3);
  return "";
}

void report_remaining(const Diagnosis& diagnosis, Sentences& out) {
  for (const EquationStructure& left : diagnosis.remaining.details)
    out.push_back(
        "Equation " + state_of(diagnosis, left.equation).name + ": a rate of " +
        format_number(left.rms, 3) + " " + rate_unit_of(diagnosis, left.equation) + " rms (" +
        percent_of(left.relative, "its rate of change") + ") is unexplained" +
        (diagnosis.effects.empty() ? main_place(diagnosis, left.equation) : "") + ".");
}

void report_unnamed(const Diagnosis& diagnosis, const Unnamed& unnamed, Sentences& out) {
  std::string text =
      "Equation " + state_of(diagnosis, unnamed.equation).name + ": what is missing ";
  if (unnamed.variables.empty())
    text += "is no function of the variables that was found";
  else if (unnamed.periodic)
    text += "is periodic in time";
  else
    text += std::string("depends on ") + (unnamed.memory ? "earlier values of " : "") +
            join(unnamed.variables, " and ");
  if (unnamed.explained > 0.0)
    text += "; a curve explains " + percent(unnamed.explained) + " of it";
  if (!unnamed.formula.empty())
    text += ", and " + readable_formula(unnamed.formula, {}) +
            " as much: put it into the model and diagnose again";
  out.push_back(text + ".");
  if (unnamed.filled)
    out.push_back(std::string(unnamed.formula.empty() ? "A spline" : "This formula") +
                  " stands in the augmented model as a stop-gap: it describes the records and "
                  "explains nothing.");
}

std::string gap_sentence(const Gap& gap) {
  const std::string before = percent(gap.before, "the motion");
  const std::string after = percent(gap.after, "the motion");
  const std::string change =
      before == after
          ? "stays at " + after
          : (gap.after < gap.before ? "falls from " : "rises from ") + before + " to " + after;
  std::vector<std::string> records;
  for (const std::string& record : gap.records) records.push_back(short_name(record));
  return "On records not used (" + briefly(records, "; ") + ") the gap " + change +
         " (noise floor " + percent(gap.noise_floor) + ").";
}

}  // namespace

const std::string& state_name(const Diagnosis& diagnosis, Index equation) {
  return state_of(diagnosis, equation).name;
}

std::string readable_formula(const std::string& formula,
                             const std::vector<NamedParameter>& parameters) {
  std::string result;
  const auto is_word = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.';
  };
  for (std::size_t i = 0; i < formula.size();) {
    std::size_t end = i;
    while (end < formula.size() &&
           (is_word(formula[end]) ||
            (end > i && (formula[end] == '-' || formula[end] == '+') &&
             formula[end - 1] == 'e' && std::isdigit(static_cast<unsigned char>(formula[i])))))
      ++end;
    const std::string word = formula.substr(i, std::max<std::size_t>(end - i, 1));
    result += std::isdigit(static_cast<unsigned char>(word.front())) != 0
                  ? readable_number(word, parameters)
                  : word;
    i += word.size();
  }
  return result;
}

DiagnosisSentences sentences_of(const Diagnosis& diagnosis) {
  DiagnosisSentences all;
  for (const Hint& hint : diagnosis.hints) all.hints.push_back(hint_sentence(hint));
  all.headline = headline(diagnosis);
  for (const NamedEffect& effect : diagnosis.effects)
    report_effect(diagnosis, effect, all.findings);
  for (const NamedEffect& effect : diagnosis.minor_effects) {
    Sentences said;
    report_effect(diagnosis, effect, said);
    all.notes.push_back(said.front());  // whatever else it might be
  }
  if (diagnosis.verdict == Verdict::CoefficientsOnly || !diagnosis.effects.empty())
    report_changes(diagnosis, all.findings);
  if (diagnosis.combined_change)
    all.findings.push_back(combined_sentence(diagnosis, *diagnosis.combined_change));
  for (const SmallestEffect& least : diagnosis.smallest_effects)
    all.findings.push_back("Equation " + state_of(diagnosis, least.equation).name +
                           ": a missing rate would have been seen from " +
                           format_number(least.rate, 2) + " " +
                           rate_unit_of(diagnosis, least.equation) + " rms on (" +
                           percent(least.relative) + " of its rate of change).");
  if (diagnosis.remaining.structure) report_remaining(diagnosis, all.findings);
  if (diagnosis.unnamed) report_unnamed(diagnosis, *diagnosis.unnamed, all.findings);
  if (diagnosis.gap) all.findings.push_back(gap_sentence(*diagnosis.gap));
  for (const std::string& note : said_once(diagnosis.notes)) all.notes.push_back(note + ".");
  return all;
}

}  // namespace lacuna
