// SPDX-License-Identifier: MIT
#include <cmath>

#include "core/base/text.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/report/reports.hpp"
#include "report/pages/readable.hpp"

namespace lacuna {
namespace {

/// Names with units, of the first model that has the input.
std::string heading_of(const PlanProblem& problem, const std::string& name) {
  for (const PlanModel& model : problem.models)
    for (const Quantity& input : model.system.inputs())
      if (input.name == name) return with_unit(name, input.unit);
  return name;
}

std::string csv_of(const PlanReport& report) {
  const PlanProblem& problem = report.problem;
  const bool numbered = report.plan.runs.size() > 1;
  const std::string unit = problem.models.front().system.symbolic().time_unit();
  std::string text = (numbered ? "trajectory," : "") + with_unit("t", unit == "1" ? "" : unit);
  for (const PlanInput& input : problem.inputs) text += "," + heading_of(problem, input.name);
  text += "\n";
  for (std::size_t r = 0; r < report.plan.runs.size(); ++r) {
    const Experiment& run = report.plan.runs[r].experiment;
    for (Index n = 0; n < run.time.size(); ++n) {
      text += (numbered ? std::to_string(r + 1) + "," : "") + format_number(run.time[n]);
      for (Index i = 0; i < run.inputs.cols(); ++i)
        text += "," + format_number(run.inputs(n, i));
      text += "\n";
    }
  }
  return text;
}

std::string c_array(const std::string& name, const Vector& values) {
  std::string text = "static const double " + name + "[" + std::to_string(values.size()) +
                     "] = {";
  constexpr Index kInALine = 6;
  for (Index n = 0; n < values.size(); ++n)
    text += (n % kInALine == 0 ? "\n  " : " ") + format_number(values[n]) + ",";
  return text + "\n};\n";
}

std::string c_of(const PlanReport& report) {
  std::string text = "/* Inputs of the planned experiment: times and held values. */\n";
  for (std::size_t r = 0; r < report.plan.runs.size(); ++r) {
    const Experiment& run = report.plan.runs[r].experiment;
    const std::string suffix =
        report.plan.runs.size() > 1 ? "_" + std::to_string(r + 1) : std::string();
    text += c_array("plan_time" + suffix, run.time);
    for (std::size_t i = 0; i < report.problem.inputs.size(); ++i)
      text += c_array("plan_" + report.problem.inputs[i].name + suffix,
                      run.inputs.col(static_cast<Index>(i)));
  }
  return text;
}

/// A head of lines KEY:VALUE, then one integer a line, -32767 at the low level and 32767 at the
/// high one.
std::string waveform_of(const PlanReport& report) {
  const char* here = "--format awg";
  if (report.problem.inputs.size() != 1 || report.plan.runs.size() != 1)
    throw ArgumentError(here, "a waveform has one input of one run", "write csv");
  if (report.problem.measurements)
    throw ArgumentError(here, "the times are not evenly spaced", "write csv");
  constexpr double kFull = 32767.0;
  const Experiment& run = report.plan.runs[0].experiment;
  const Vector u = run.inputs.col(0);
  const double low = u.minCoeff(), high = u.maxCoeff(), half = 0.5 * (high - low);
  std::string text = "File Format:1.10\nChannel Count:1\nSample Rate:" +
                     format_number(1.0 / report.problem.step) +
                     "\nHigh Level:" + format_number(high) + "\nLow Level:" +
                     format_number(low) + "\nData Type:\"short\"\nData Points:" +
                     std::to_string(u.size()) + "\nData:\n";
  for (const double value : u)
    text += std::to_string(half > 0.0 ? std::lround(kFull * ((value - low) / half - 1.0)) : 0) +
            "\n";
  return text;
}

}  // namespace

std::string format_inputs(const PlanReport& report, InputFormat format) {
  switch (format) {
    case InputFormat::Csv:
      return csv_of(report);
    case InputFormat::C:
      return c_of(report);
    case InputFormat::Waveform:
      break;
  }
  return waveform_of(report);
}

}  // namespace lacuna
