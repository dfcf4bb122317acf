// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <tuple>

#include "core/base/text.hpp"
#include "core/statistics/determined.hpp"
#include "lacuna/report/pages/identification_report.hpp"
#include "readable.hpp"
#include "relation_text.hpp"

namespace lacuna {
namespace {

std::string indented(const std::string& text) {
  std::istringstream lines(text);
  std::string line, result;
  while (std::getline(lines, line)) result += "  " + line + "\n";
  return result;
}

std::string error_text(const WeightedTerm& summand) {
  if (!summand.standard_error) return "-";
  const bool known = is_determined(summand.coefficient, *summand.standard_error);
  return format_number(*summand.standard_error, 2) + (known ? "" : " (not determined)");
}

std::string coefficient_table(const OdeModel& model, bool full) {
  std::vector<std::array<std::string, 4>> rows{
      {"equation", "term", "coefficient", "standard error"}};
  for (std::size_t k = 0; k < model.equations().size(); ++k)
    for (const WeightedTerm& summand : model.equations()[k])
      rows.push_back({left_hand_side(model.states()[k].name, model.evolution()),
                      summand.term.name(), coefficient_text(summand, full),
                      error_text(summand)});
  std::array<std::size_t, 4> widths{};
  for (const auto& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], row[c].size());
  std::string table;
  for (const auto& row : rows) {
    // Signs stand in a column of their own.
    const bool is_signed = row[2].front() == '-' || &row == &rows.front();
    table += "  " + padded(row[0], widths[0] + 2) + padded(row[1], widths[1] + 2) +
             padded((is_signed ? "" : " ") + row[2], widths[2] + 3) + row[3] + "\n";
  }
  return table;
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

std::string validation_text(const Validation& validation) {
  const Index windows = validation.windows.windows;
  std::string text = "  " + validation.sentence + "\n  (on " +
                     std::to_string(validation.samples) + " samples " +
                     (validation.given      ? "of other records"
                      : validation.refitted ? "that were held out of the coefficients' fit"
                                            : "that were fitted") +
                     (windows > 0 ? ", in " + std::to_string(windows) + " windows" : "") +
                     ")\n";
  for (const std::string& advice : validation.advice) text += "  " + advice + "\n";
  return text;
}

/// "  dx/dt: x*y would be the next: chi squared - 3.2 (worth it from 17)".
std::string next_terms(const IdentificationResult& result) {
  std::string text;
  for (std::size_t i = 0; i < result.path.size(); ++i) {
    const PathStep& step = result.path[i];
    const bool first =
        i == 0 || result.path[i - 1].in_model || result.path[i - 1].equation != step.equation;
    if (step.in_model || !first) continue;
    text += "  d" + result.model.states()[static_cast<std::size_t>(step.equation)].name +
            "/dt: " + step.term + " would be the next: chi squared - " +
            format_number(step.gain, 3) + " (worth it from " + format_number(step.penalty, 3) +
            ")\n";
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

std::string format_text(const IdentificationReport& report, bool full) {
  const IdentificationResult& result = report.result;
  std::ostringstream out;
  out << "Equations\n"
      << indented(equations_text(result.model, full)) << "\nCoefficients [state unit"
      << (result.model.is_map() ? "" : " / " + result.model.time_unit()) << "]\n"
      << coefficient_table(result.model, full) << "\nFit\n";
  for (const EquationFit& fit : result.fit) out << fit_line(fit, result.model.evolution());
  if (result.validation) out << "\nVerdict\n" << validation_text(*result.validation);
  if (!result.relations.empty()) out << "\nRelations\n";
  for (const Relation& relation : result.relations)
    out << "  " << relation_sentence(relation) << "\n";
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
  for (const std::string& warning : result.warnings) out << "  " << warning << "\n";
  return out.str();
}

}  // namespace lacuna
