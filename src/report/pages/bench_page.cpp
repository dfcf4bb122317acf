// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/text.hpp"
#include "lacuna/report/reports.hpp"
#include "report/pages/pages.hpp"
#include "report/plot/heat_figure.hpp"

namespace lacuna {
namespace {

std::string composition_name(const BenchResult& result, std::size_t composition) {
  return join(result.parts[composition], " + ");
}

/// The fraction of exact structures, or without a truth the synchronisation error on a logarithmic
/// scale between the least and the largest.
HeatFigure heat_of(const BenchResult& result) {
  HeatFigure figure{"parts",
                    result.truth_known ? "Runs with exactly the true terms (%), by noise"
                                       : "Synchronisation error (%), by noise; darker is less",
                    {},
                    {},
                    {}};
  double low = std::numeric_limits<double>::infinity(), high = 0.0;
  for (const BenchCell& cell : result.cells)
    if (const auto sync = summary_of(cell).sync; sync && std::isfinite(*sync) && *sync > 0.0) {
      low = std::min(low, *sync);
      high = std::max(high, *sync);
    }
  for (const double noise : result.noise)
    figure.columns.push_back(format_number(100.0 * noise) + " %");
  for (std::size_t c = 0; c < result.parts.size(); ++c) {
    figure.rows.push_back(composition_name(result, c));
    auto& texts = figure.texts.emplace_back();
    auto& shades = figure.shades.emplace_back();
    for (std::size_t level = 0; level < result.noise.size(); ++level) {
      const BenchSummary summary = summary_of(result.cell(c, level));
      const std::optional<double> value = result.truth_known ? summary.exact_rate : summary.sync;
      const bool finite = value && std::isfinite(*value);
      texts.push_back(finite ? format_number(100.0 * *value, 3) : summary.terms ? "diverged" : "-");
      std::optional<double> shade;
      if (finite && result.truth_known) shade = *value;
      if (finite && !result.truth_known)
        shade = high > low ? 1.0 - std::log(std::max(*value, low) / low) / std::log(high / low)
                           : 1.0;
      shades.push_back(shade);
    }
  }
  return figure;
}

/// The numbers of format_csv() as cells.
Markup numbers_of(const BenchResult& result) {
  std::vector<std::string> heads = result.kinds;
  for (const char* name : {"noise %", "exact %", "coefficient error", "terms", "sync error %",
                           "time ms", "failed"})
    heads.emplace_back(name);
  std::vector<std::vector<std::string>> rows;
  const auto text = [](const std::optional<double>& value, double factor) {
    return value && std::isfinite(*value) ? format_number(factor * *value, 3) : "-";
  };
  for (const BenchCell& cell : result.cells) {
    const BenchSummary summary = summary_of(cell);
    std::vector<std::string> row = result.parts[cell.composition];
    for (const std::string& number :
         {format_number(100.0 * cell.noise), text(summary.exact_rate, 100.0),
          text(summary.coefficient_error, 1.0), text(summary.terms, 1.0),
          text(summary.sync, 100.0), text(summary.seconds, 1e3),
          std::to_string(cell.failures.size())})
      row.push_back(number);
    rows.push_back(std::move(row));
  }
  return table(heads, rows);
}

}  // namespace

Page bench_page(const BenchResult& result, const std::string& subject) {
  Page page;
  page.title = "Parts compared on " + subject;
  const std::size_t failed = static_cast<std::size_t>(
      std::count_if(result.cells.begin(), result.cells.end(),
                    [](const BenchCell& cell) { return !cell.failures.empty(); }));
  page.headline = std::to_string(result.parts.size()) + " compositions of " +
                  join(result.kinds, ", ") + " at " + std::to_string(result.noise.size()) +
                  (result.noise.size() == 1 ? " level of noise" : " levels of noise");
  page.tone = failed == 0 ? Tone::Good : Tone::Doubtful;
  if (const Admission cut = admission_of(result); !cut.stands()) {
    page.tone = Tone::Doubtful;
    page.findings.push_back("Incomplete: " + cut.why + "; " + cut.remedy + ".");
  }
  if (failed > 0)
    page.findings.push_back(std::to_string(failed) + " of " +
                            std::to_string(result.cells.size()) +
                            " cells have draws without a model.");
  page.sections.push_back({"Heat map", {}, {draw(heat_of(result))}});
  page.sections.push_back({"Numbers", numbers_of(result)});
  std::vector<std::string> failures;
  for (const BenchCell& cell : result.cells)
    if (!cell.failures.empty())
      failures.push_back(composition_name(result, cell.composition) + ": " +
                         cell.failures.front());
  if (!failures.empty()) page.sections.push_back({"Failures", bullets(failures)});
  return page;
}

}  // namespace lacuna
