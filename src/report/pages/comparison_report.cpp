// SPDX-License-Identifier: MIT
#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/base/json.hpp"
#include "folded_text.hpp"
#include "lacuna/report/reports.hpp"
#include "readable.hpp"

namespace lacuna {
namespace {

std::string verdict_of(const AttractorMeasure& measure) {
  if (!measure.agree) return "not judged: " + measure.note;
  return *measure.agree ? "pass" : "FAIL";
}

}  // namespace

bool ComparisonReport::agree() const {
  const auto is = [](bool wanted) {
    return [wanted](const AttractorMeasure& measure) { return measure.agree == wanted; };
  };
  return std::none_of(measures.begin(), measures.end(), is(false)) &&
         std::any_of(measures.begin(), measures.end(), is(true));
}

Admission ComparisonReport::admission() const {
  VerdictBasis basis;
  for (const AttractorMeasure& measure : measures) {
    if (measure.agree == false) return {};
    if (measure.left_out) basis.stages.push_back({measure.name, false, kTimeIsUp});
  }
  return admit(basis);
}

std::string format_text(const ComparisonReport& report) {
  const Admission admission = report.admission();
  std::vector<std::vector<std::string>> rows{{"measure", report.first, report.second, ""}};
  for (const AttractorMeasure& measure : report.measures) {
    const bool known = measure.agree.has_value();
    rows.push_back({with_unit(measure.name, measure.unit),
                    known ? with_error(measure.first, measure.first_half) : "-",
                    known ? with_error(measure.second, measure.second_half) : "-",
                    verdict_of(measure)});
  }
  const bool judged =
      std::any_of(report.measures.begin(), report.measures.end(),
                  [](const AttractorMeasure& measure) { return measure.agree.has_value(); });
  const std::string verdict =
      !admission.stands() ? "Incomplete: " + admission.why + "; " + admission.remedy + "."
      : report.agree()    ? "They agree: one attractor as far as these show."
      : judged            ? "They do not agree in all measures."
                          : "Undecided: no measure could be judged.";
  std::string text =
      verdict + "\n\n" + text_table(rows) +
      "\nNumbers are means of five blocks +- 95 %. Spectrum and density are Hellinger's "
      "distances: blocks of one record to one another, then blocks of different records.\n";
  for (const std::string& note : report.notes) text += "Note: " + note + "\n";
  return text;
}

std::string format_json(const ComparisonReport& report) {
  using Json = nlohmann::ordered_json;
  Json json{{"format", "lacuna.comparison/1"},
            {"first", report.first},
            {"second", report.second},
            {"agree", report.agree()},
            {"incomplete", !report.admission().stands()},
            {"measures", Json::array()}};
  for (const AttractorMeasure& m : report.measures)
    json["measures"].push_back(
        {{"name", m.name},
         {"unit", m.unit},
         {"first", m.first},
         {"first_ci95", {m.first - m.first_half, m.first + m.first_half}},
         {"second", m.second},
         {"second_ci95", {m.second - m.second_half, m.second + m.second_half}},
         {"agree", m.agree ? Json(*m.agree) : Json()},
         {"note", m.note}});
  json["notes"] = report.notes;
  return json_lines(json);
}

}  // namespace lacuna
