// SPDX-License-Identifier: MIT
#include <algorithm>
#include <optional>

#include "core/base/text.hpp"
#include "folded_text.hpp"
#include "identification_details.hpp"
#include "lacuna/identify/journey/identify_records.hpp"
#include "readable.hpp"

namespace lacuna {
namespace {

/// Warnings on the first screen; the rest stand behind --explain.
constexpr std::size_t kShownWarnings = 2;

/// Lines of the first screen that equations may take: what is read, verdict, tests and two
/// warnings take the others. With half as many the 33 terms of the shipped record would lose
/// their intervals, with twice as many the verdict would leave the screen.
constexpr std::size_t kEquationLines = 20;

std::size_t lines_in(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

/// All equations, folded.
std::string equations_in(const OdeModel& model, const Digits& digits, Intervals intervals) {
  std::string text;
  for (Index k = 0; k < model.dimension(); ++k)
    text += "  " + equation_text(model, k, digits, intervals) + "\n";
  return folded(text);
}

/// What is shown of each equation of a model that is too long for a screen.
std::string sizes_of_equations(const OdeModel& model) {
  std::string text;
  for (std::size_t k = 0; k < std::min(model.equations().size(), kEquationLines - 1); ++k)
    text += "  " + left_hand_side(model.states()[k].name, model.evolution()) + ": " +
            std::to_string(model.equations()[k].size()) + " terms\n";
  if (model.equations().size() >= kEquationLines)
    text += "  and " + std::to_string(model.equations().size() - kEquationLines + 1) +
            " more equations\n";
  return text;
}

/// With intervals where they fit on the screen, else without, else how many terms there are.
std::string equations_section(const OdeModel& model, const TextOptions& options) {
  const std::string whole = equations_in(model, options.digits, Intervals::Shown);
  if (options.explain || lines_in(whole) <= kEquationLines)
    return (whole.find("+-") == std::string::npos ? "Equations\n" : "Equations (+- is 95 %)\n") +
           whole;
  const std::string plain = equations_in(model, options.digits, Intervals::Hidden);
  if (lines_in(plain) <= kEquationLines) return "Equations (intervals: --explain)\n" + plain;
  return "Equations (in full: --explain, --model-out FILE)\n" + sizes_of_equations(model);
}

/// "  u acts (0.0100 +- 0.0001) s after it is recorded" of each input that does.
std::string dead_times_in(const IdentificationResult& result) {
  std::string text;
  for (const DeadTime& late : result.dead_times)
    text += "  " + dead_time_sentence(late, result.model.time_unit()) + "\n";
  return text;
}

std::string tested_on(const Validation& validation) {
  const Index windows = validation.windows.windows;
  return "Tested on " + std::to_string(validation.samples) + " samples " +
         (validation.given      ? "of other records"
          : validation.refitted ? "held out of the fit"
                                : "that were fitted") +
         (windows > 0 ? ", in " + std::to_string(windows) + " windows" : "");
}

std::string sync_phrase(const SyncReport& report) {
  if (!report.verdict.sentence.empty()) return report.verdict.sentence;
  if (report.result.status != IntegrationStatus::Completed) return report.result.message;
  return "relative error " + percent(report.result.relative);
}

/// The verdict in place of that of a validation, where samples were too few for one.
std::string fits_line(const IdentificationResult& result) {
  const auto judged = [](const EquationFit& fit) { return fit.fits_to_noise.has_value(); };
  const auto fails = [](const EquationFit& fit) { return !fit.fits_to_noise.value_or(true); };
  if (std::none_of(result.fit.begin(), result.fit.end(), judged))
    return "Not tested: nothing was held out, and no equation was compared with its noise.\n";
  if (std::none_of(result.fit.begin(), result.fit.end(), fails))
    return "Each equation that was compared fits to the noise; nothing was held out.\n";
  std::string text;
  for (const EquationFit& fit : result.fit)
    if (fails(fit))
      text += (text.empty() ? "" : ", ") + left_hand_side(fit.equation, result.model.evolution());
  return text + ": above the noise; nothing was held out.\n";
}

std::string verdict_section(const IdentificationReport& report) {
  const std::optional<Validation>& validation = report.result.validation;
  std::string text = validation ? validation->sentence + "\n" + tested_on(*validation) + ".\n"
                                : fits_line(report.result);
  if (report.sync) text += "Synchronisation with the record: " + sync_phrase(*report.sync) + "\n";
  if (validation)
    for (const std::string& advice : validation->advice) text += "  " + advice + "\n";
  return text;
}

std::string warnings_section(const std::vector<std::string>& warnings) {
  std::string text = warnings.empty() ? "" : "\nWarnings\n";
  for (std::size_t i = 0; i < std::min(warnings.size(), kShownWarnings); ++i)
    text += "  " + warnings[i] + "\n";
  if (warnings.size() > kShownWarnings)
    text += "  " + std::to_string(warnings.size() - kShownWarnings) + " more\n";
  return text;
}

/// "y: x*z; z: x" of names of terms; a dash where there are none.
std::string listed(const std::vector<std::string>& names) {
  return names.empty() ? "-" : join(names, "; ");
}

/// The models of other structure as a table, with how likely they are.
std::string alternatives_section(const IdentificationReport& report) {
  if (!report.alternatives) return "";
  if (report.alternatives->empty())
    return "\nAlternatives: none that a term less, more or another would make\n";
  std::vector<std::vector<std::string>> rows{
      {"criterion", "weight", "held-out error", "without", "with"}};
  for (const AlternativeModel& one : *report.alternatives)
    rows.push_back({format_number(one.criterion, 3), percent(one.weight),
                    one.held_out ? percent(*one.held_out) : "", listed(one.without),
                    listed(one.with)});
  return "\nAlternatives that the record cannot distinguish from this model (criterion:\n"
         "  larger by 2 log likelihood and the penalty of terms)\n" +
         text_table(rows);
}

}  // namespace

std::string first_answer_text(const IdentificationResult& result, const TextOptions& options) {
  TextOptions brief = options;
  brief.explain = false;
  return "First answer, by regression; it is being refined and tested\n" +
         equations_section(result.model, brief) + "\n";
}

std::string format_text(const IdentificationReport& report, const TextOptions& options) {
  const std::string first = verdict_section(report) + "\n" +
                            equations_section(report.result.model, options) +
                            dead_times_in(report.result) + alternatives_section(report);
  if (options.explain) return first + details_text(report, options.digits);
  const std::string left_out = left_out_line(report.result.stages);
  return first + warnings_section(said_once(report.result.warnings)) +
         (left_out.empty() ? "" : "\nStages " + left_out + "\n") + "\nDetails: --explain\n";
}

IdentificationReport report_of(Identification found, Pipeline pipeline, std::string asked) {
  const Dataset& data = found.records.excerpt();
  IdentificationReport report{std::move(found.result), std::move(pipeline), std::move(asked)};
  if (found.verification)
    report.sync = SyncReport{std::move(found.verification->result),
                             data.states,
                             data.time_unit,
                             false,
                             std::move(found.verification->integrator),
                             std::move(found.verification->verdict)};
  return report;
}

std::string format_text(const Identification& found, const TextOptions& options) {
  return format_text(report_of(found, algorithm1()), options);
}

}  // namespace lacuna
