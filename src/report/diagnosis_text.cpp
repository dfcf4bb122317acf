// SPDX-License-Identifier: MIT
// The answer in sentences that can be pasted into a letter.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <sstream>

#include "lacuna/core/text.hpp"
#include "lacuna/report/diagnosis_report.hpp"

namespace lacuna {
namespace {

/// Coefficients further off than this are told of.
constexpr double kTold = 3.0;

const Quantity& state_of(const Diagnosis& diagnosis, Index equation) {
  return diagnosis.nominal.states()[static_cast<std::size_t>(equation)];
}

std::string percent(double share) {
  return format_number(100.0 * share, std::abs(share) < 0.995 ? 2 : 3) + " %";
}

/// A share of something, where less than a thousandth says no more than that.
std::string share_of(double share) { return share < 1e-3 ? "less than 0.1 %" : percent(share); }

/// Unit of a rate of change: "rad/s per s", "V/s".
std::string rate_unit(const Diagnosis& diagnosis, Index equation) {
  const std::string& unit = state_of(diagnosis, equation).unit;
  return (unit.empty() ? "1" : unit) + "/" + diagnosis.nominal.time_unit();
}

/// Significant digits that the error of a number allows.
int digits_of(double value, double error) {
  if (!(error > 0.0) || value == 0.0) return 4;
  const double digits = std::ceil(std::log10(std::abs(value) / error)) + 1.0;
  return static_cast<int>(std::min(std::max(2.0, digits), 8.0));
}

/// The number and its error, to the digits that the error allows.
std::string with_error(double value, double deviation) {
  const double error = 1.96 * deviation;
  if (error == 0.0) return format_number(value, 4);
  return format_number(value, digits_of(value, error)) + " +- " + format_number(error, 2);
}

/// A number of a formula for people: a parameter to the digits that its error allows.
std::string readable_number(const std::string& text,
                            const std::vector<NamedParameter>& parameters) {
  const std::optional<double> value = parse_number(text);
  if (!value || text.size() <= 6) return text;
  if (*value == std::numbers::pi) return "pi";
  for (const NamedParameter& parameter : parameters)
    if (parameter.deviation && std::abs(parameter.value) == *value)
      return format_number(*value, digits_of(*value, 1.96 * *parameter.deviation));
  return format_number(*value, 4);
}

/// A formula with its numbers for people; all digits are in the JSON.
std::string readable(const std::string& formula,
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

void write_hint(const Hint& hint, std::ostream& out) {
  out << "Hint (" << to_string(hint.kind) << "): " << hint.message
      << ". Remedy: " << hint.remedy << ".\n";
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
      return "Partly explained: effects are named, but significant structure is left.";
    case Verdict::UnnamedStructure:
      if (withheld_by(diagnosis.hints) != Withheld::Nothing)
        return "Something is missing; no effect is named, the hint comes first.";
      return "Something is missing that no known effect explains.";
  }
  return "";
}

void write_effect(const Diagnosis& diagnosis, const NamedEffect& effect, std::ostream& out) {
  out << "Equation " << state_of(diagnosis, effect.equation).name << ": " << effect.description
      << " (" << effect.name << "), " << with_error(effect.coefficient, effect.deviation) << " "
      << rate_unit(diagnosis, effect.equation) << " * "
      << readable(effect.term, effect.parameters) << ", explains "
      << share_of(effect.gap_closed) << " of the disagreement ("
      << format_number(effect.sigma, 3) << " sigma).\n";
  for (const Alternative& other : effect.alternatives)
    if (other.probability >= 0.01 && other.term != effect.term)
      out << (other.probability > effect.probability ? "  By likelihood alone it would be "
                                                     : "  It might also be ")
          << other.name << " " << readable(other.term, {}) << " (probability "
          << percent(other.probability) << ").\n";
}

void write_changes(const Diagnosis& diagnosis, std::ostream& out) {
  constexpr int kMost = 4;
  int written = 0;
  for (const CoefficientChange& change : diagnosis.coefficient_changes) {
    if (change.sigma < kTold || written == kMost) break;
    if (std::abs(change.estimated - change.nominal) < 1e-3 * std::abs(change.nominal)) continue;
    ++written;
    out << "Equation " << state_of(diagnosis, change.equation).name << ": the coefficient of "
        << change.term << " is " << with_error(change.estimated, change.deviation) << ", not "
        << format_number(change.nominal, 6) << " (" << format_number(change.sigma, 3)
        << " sigma).\n";
  }
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

void write_unnamed(const Diagnosis& diagnosis, std::ostream& out) {
  for (const EquationStructure& left : diagnosis.remaining.details) {
    out << "Equation " << state_of(diagnosis, left.equation).name << ": a rate of "
        << format_number(left.rms, 3) << " " << rate_unit(diagnosis, left.equation) << " rms ("
        << percent(left.relative) << " of its rate of change) is unexplained";
    if (diagnosis.effects.empty()) out << main_place(diagnosis, left.equation);
    out << ".\n";
  }
}

void write_description(const Diagnosis& diagnosis, const Unnamed& unnamed, std::ostream& out) {
  const std::string& state = state_of(diagnosis, unnamed.equation).name;
  out << "Equation " << state << ": what is missing ";
  if (unnamed.variables.empty())
    out << "is no function of the variables that was found";
  else if (unnamed.periodic)
    out << "is periodic in time";
  else
    out << "depends on " << (unnamed.memory ? "earlier values of " : "")
        << join(unnamed.variables, " and ");
  if (unnamed.explained > 0.0)
    out << "; a curve explains " << percent(unnamed.explained) << " of it";
  out << ".\n";
  if (unnamed.filled)
    out << "A spline stands in the augmented model as a stop-gap: it describes the records and "
           "explains nothing.\n";
}

void write_gap(const Gap& gap, std::ostream& out) {
  const std::string before = percent(gap.before), after = percent(gap.after);
  out << "On records not used (" << join(gap.records, ", ") << ") the gap ";
  if (before == after)
    out << "stays at " << after;
  else
    out << (gap.after < gap.before ? "falls" : "rises") << " from " << before << " to "
        << after;
  out << " (noise floor " << percent(gap.noise_floor) << ").\n";
}

}  // namespace

std::string format_text(const Diagnosis& diagnosis) {
  std::ostringstream out;
  for (const Hint& hint : diagnosis.hints) write_hint(hint, out);
  out << headline(diagnosis) << "\n";
  for (const NamedEffect& effect : diagnosis.effects) write_effect(diagnosis, effect, out);
  if (diagnosis.verdict == Verdict::CoefficientsOnly || !diagnosis.effects.empty())
    write_changes(diagnosis, out);
  if (diagnosis.remaining.structure) write_unnamed(diagnosis, out);
  if (diagnosis.unnamed) write_description(diagnosis, *diagnosis.unnamed, out);
  if (diagnosis.gap) write_gap(*diagnosis.gap, out);
  for (const std::string& note : diagnosis.notes) out << "Note: " << note << ".\n";
  return out.str();
}

}  // namespace lacuna
