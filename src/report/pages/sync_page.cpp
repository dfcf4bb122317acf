// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>

#include "core/base/text.hpp"
#include "lacuna/records/binding/model_view.hpp"
#include "readable.hpp"
#include "report/pages/pages.hpp"
#include "run_figures.hpp"

namespace lacuna {
namespace {

/// The slave beside the record, as far as it went.
std::vector<GapRecord> runs_of(const SyncReport& report, const Dataset& data) {
  std::vector<GapRecord> runs;
  for (std::size_t r = 0; r < report.result.states.size(); ++r) {
    const Matrix& slave = report.result.states[r];
    const Index n = slave.rows();
    if (n < 2) continue;
    const Trajectory& record = data.trajectories[r];
    Matrix measured = record.states.topRows(n);
    for (Index k = 0; k < measured.cols(); ++k)
      if (is_hidden(data, k))
        measured.col(k).setConstant(std::numeric_limits<double>::quiet_NaN());
    runs.push_back(
        {record.source, record.time.head(n), std::move(measured), Matrix(), slave, 0, n});
  }
  return runs;
}

Picture error_picture(const SyncReport& report, const Dataset& data) {
  LineFigure figure{"error",
                    "Distance of the slave from the record",
                    with_unit("time", report.time_unit),
                    "|slave - record|",
                    {}};
  figure.logarithmic_y = true;
  for (std::size_t r = 0; r < report.result.errors.size() && r < 6; ++r) {
    const Vector& error = report.result.errors[r];
    figure.series.push_back({short_name(data.trajectories[r].source),
                             data.trajectories[r].time.head(error.size()), error,
                             r == 0 ? Curve::Model : Curve::Other});
  }
  return draw(figure);
}

std::vector<Fact> facts_of(const SyncReport& report) {
  const SyncResult& result = report.result;
  std::vector<Fact> facts{{"Relative error", percent(result.relative), "mean over largest |x|"},
                          {"Median error", format_number(result.median, 3), ""}};
  if (result.error_over_noise)
    facts.push_back({"Error over noise", format_number(*result.error_over_noise, 3),
                     "about 1 where nothing is missing"});
  if (result.conditional_exponent)
    facts.push_back({"Conditional exponent",
                     format_number(*result.conditional_exponent, 2) + " 1/" + report.time_unit,
                     "below 0 the record determines the hidden states"});
  return facts;
}

}  // namespace

Page sync_page(const SyncReport& report, const Dataset& data) {
  const SyncVerdict& verdict = report.verdict;
  const std::vector<GapRecord> runs = runs_of(report, data);
  Page page;
  page.title = "Does the model hold on " +
               (data.trajectories.empty() ? "the record"
                                          : short_name(file_of(data.trajectories.front()))) +
               "?";
  page.headline = verdict.sentence;
  page.tone = verdict.holds ? Tone::Good : verdict.decided ? Tone::Bad : Tone::Doubtful;
  page.facts = facts_of(report);
  if (runs.empty()) return page;
  const RunView view{runs,
                     report.states,
                     report.time_unit,
                     report.result.noise,
                     "",
                     "slave that the record drives"};
  page.sections.push_back({"Error over time", {}, {error_picture(report, data)}});
  page.sections.push_back({"Record and slave", {}, comparison_pictures(view)});
  page.sections.push_back({"What the slave is off", {}, deviation_pictures(view)});
  page.sections.push_back({"Orbit", {}, orbit_pictures(view)});
  return page;
}

}  // namespace lacuna
