// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <sstream>
#include <tuple>

#include "core/base/text.hpp"
#include "folded_text.hpp"
#include "identification_details.hpp"
#include "readable.hpp"
#include "invariant_text.hpp"

namespace lacuna {
namespace {

std::string indented(const std::string& text) {
  std::istringstream lines(text);
  std::string line, result;
  while (std::getline(lines, line)) result += "  " + line + "\n";
  return result;
}

std::string coefficient_table(const OdeModel& model, const Digits& digits) {
  std::vector<std::vector<std::string>> rows{{"equation", "term", "coefficient", "+-"}};
  for (std::size_t k = 0; k < model.equations().size(); ++k)
    for (const WeightedTerm& summand : model.equations()[k]) {
      const std::string number = coefficient_text(summand, digits);
      const std::string half = half_text(summand);
      // Signs stand in a column of their own.
      rows.push_back({with_unit(left_hand_side(model.states()[k].name, model.evolution()),
                                target_unit(model, static_cast<Index>(k))),
                      summand.term.name(), (number.front() == '-' ? "" : " ") + number,
                      half.empty() ? "-" : half});
    }
  return text_table(rows);
}

std::string fit_line(const EquationFit& fit, Evolution evolution) {
  std::string line = "  " + left_hand_side(fit.equation, evolution) + ": ";
  if (fit.identity) return line + "known without a fit\n";
  line += "residual rms " + format_number(fit.residual_rms, 3) + " of " +
          format_number(fit.target_rms, 3) + ", " + std::to_string(fit.rows) + " rows";
  if (fit.noise_floor)
    line += ", measurement noise alone gives " + format_number(*fit.noise_floor, 2);
  if (fit.misfit)
    line += std::isfinite(*fit.misfit)
                ? ", trajectories off by " + format_number(*fit.misfit, 3) + " x noise"
                : ", trajectories leave the range of numbers";
  if (fit.fits_to_noise) line += *fit.fits_to_noise ? ": fits to the noise" : ": does not fit";
  return line + "\n";
}

std::string noise_text(const IdentificationResult& result) {
  std::vector<std::string> parts;
  for (Index k = 0; k < result.noise.size(); ++k) {
    const Quantity& state = result.model.states()[static_cast<std::size_t>(k)];
    parts.push_back(state.name + " " + format_number(result.noise[k], 2) +
                    (state.unit.empty() ? "" : " " + state.unit));
  }
  return "  " + join(parts, ", ") + "\n";
}

/// Why a term is not in the model although its gain is above its penalty: the number of the
/// stage that removed it.
std::string removal_reason(const IdentificationResult& result, const std::string& equation,
                           const std::string& term) {
  for (const TrailEntry& entry : result.trail)
    if (!entry.kept && entry.equation == equation && entry.term == term)
      return entry.quantity + " is " + format_number(entry.value, 3) + ", the limit " +
             format_number(entry.threshold, 3);
  return "it did not stay in the search for the best set of terms";
}

/// "  dx/dt: x*y would come next; it lowers chi squared by 3.2, less than its penalty of 17".
std::string next_term(const IdentificationResult& result, const PathStep& step) {
  const std::string& state = result.model.states()[static_cast<std::size_t>(step.equation)].name;
  const std::string gain = format_number(step.gain, 3), penalty = format_number(step.penalty, 3);
  const std::string begin = "  " + left_hand_side(state, result.model.evolution()) + ": " +
                            step.term + " would come next; it lowers chi squared by " + gain;
  if (step.gain < step.penalty) return begin + ", less than its penalty of " + penalty + "\n";
  return begin + " (its penalty is " + penalty +
         ") and is left out for another reason: " + removal_reason(result, state, step.term) +
         "\n";
}

std::string next_terms(const IdentificationResult& result) {
  std::string text;
  for (std::size_t i = 0; i < result.path.size(); ++i) {
    const PathStep& step = result.path[i];
    const bool first =
        i == 0 || result.path[i - 1].in_model || result.path[i - 1].equation != step.equation;
    if (!step.in_model && first) text += next_term(result, step);
  }
  return text;
}

/// "  2. x^2 0.0703 (limit 0.0849)".
std::string removal_line(const TrailEntry& entry) {
  return "      " + std::to_string(entry.step) + ". " + padded(entry.term, 16) + " " +
         padded(format_number(entry.value, 3), 10) + " limit " +
         format_number(entry.threshold, 3) + "\n";
}

/// Removed terms of one equation, stage by stage, in the order of removal.
std::string removals_of(std::vector<TrailEntry> removed) {
  std::stable_sort(removed.begin(), removed.end(), [](const auto& a, const auto& b) {
    return std::tie(a.stage, a.step) < std::tie(b.stage, b.step);
  });
  std::string text, heading;
  for (const TrailEntry& entry : removed) {
    const std::string stage = "    removed by " + entry.stage + ", " + entry.quantity + ":\n";
    if (stage != heading) text += stage;
    heading = stage;
    text += removal_line(entry);
  }
  return text;
}

std::string trail_of(const IdentificationResult& result, const std::string& equation) {
  std::vector<TrailEntry> removed;
  std::size_t candidates = 0;
  for (const TrailEntry& entry : result.trail) {
    if (entry.equation != equation) continue;
    ++candidates;
    if (!entry.kept) removed.push_back(entry);
  }
  const std::size_t kept = candidates - removed.size();
  return "  " + left_hand_side(equation, result.model.evolution()) + ": " +
         std::to_string(candidates) + " candidates, " + std::to_string(kept) + " kept\n" +
         removals_of(std::move(removed));
}

}  // namespace

std::string details_text(const IdentificationReport& report, const Digits& digits) {
  const IdentificationResult& result = report.result;
  std::ostringstream out;
  out << "\nCoefficients (+- is 95 %)\n" << coefficient_table(result.model, digits) << "\nFit\n";
  for (const EquationFit& fit : result.fit) out << fit_line(fit, result.model.evolution());
  if (!result.relations.empty()) out << "\nRelations\n";
  for (const Relation& relation : result.relations)
    out << "  " << relation_sentence(relation) << "\n";
  if (const auto& region = result.trapping.region)
    out << "\nBounded\n  " << trapping_sentence(result.model, *region) << "\n";
  if (result.library_alone)
    out << "\nThe library alone does not reach the noise; it gives\n"
        << indented(to_text(*result.library_alone, 5));
  if (result.noise.size() > 0)
    out << "\nMeasurement noise (standard deviation)\n" << noise_text(result);
  out << "\nTerms\n";
  for (const EquationFit& fit : result.fit)
    if (!fit.identity) out << trail_of(result, fit.equation);
  out << next_terms(result);
  if (report.sync) out << "\n" << format_text(*report.sync);
  if (const std::string line = left_out_line(result.stages); !line.empty())
    out << "\nStages\n  " << line << "\n";
  if (!result.warnings.empty()) out << "\nWarnings\n";
  for (const std::string& warning : said_once(result.warnings)) out << "  " << warning << "\n";
  return out.str();
}

}  // namespace lacuna
