// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "core/base/text.hpp"
#include "folded_text.hpp"
#include "lacuna/report/reports.hpp"

namespace lacuna {
namespace {

std::string number_or(const std::optional<double>& value, double factor,
                      const std::string& otherwise) {
  return value && std::isfinite(*value) ? format_number(factor * *value, 3) : otherwise;
}

/// What cells are ranked by: most exact structures, least error of coefficients or, without a
/// truth, of synchronisation.
std::pair<double, double> rank_of(const BenchCell& cell) {
  const BenchSummary summary = summary_of(cell);
  constexpr double kLast = std::numeric_limits<double>::infinity();
  if (!summary.terms) return {1.0, kLast};
  if (!summary.exact_rate) return {0.0, summary.sync.value_or(kLast)};
  return {-*summary.exact_rate, summary.coefficient_error.value_or(kLast)};
}

std::string drawn(const BenchCell& cell) {
  return std::to_string(cell.scores.size() + cell.failures.size());
}

std::vector<std::string> head_of(const BenchResult& result) {
  std::vector<std::string> head = result.kinds;
  if (result.truth_known)
    for (const char* name : {"exact %", "coefficient error"}) head.emplace_back(name);
  for (const char* name : {"terms", "sync error %", "time ms", "draws", "failed"})
    head.emplace_back(name);
  return head;
}

std::vector<std::string> row_of(const BenchResult& result, std::size_t composition,
                                std::size_t level) {
  const BenchCell& cell = result.cell(composition, level);
  const BenchSummary summary = summary_of(cell);
  std::vector<std::string> row = result.parts[composition];
  if (result.truth_known) {
    row.push_back(number_or(summary.exact_rate, 100.0, "-"));
    row.push_back(number_or(summary.coefficient_error, 1.0, "-"));
  }
  row.push_back(number_or(summary.terms, 1.0, "-"));
  row.push_back(number_or(summary.sync, 100.0, cell.scores.empty() ? "-" : "diverged"));
  row.push_back(number_or(summary.seconds, 1e3, "-"));
  row.push_back(drawn(cell));
  row.push_back(std::to_string(cell.failures.size()));
  return row;
}

std::string table_of(const BenchResult& result, std::size_t level) {
  std::vector<std::size_t> order(result.parts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return rank_of(result.cell(a, level)) < rank_of(result.cell(b, level));
  });
  std::vector<std::vector<std::string>> rows{head_of(result)};
  for (const std::size_t composition : order) rows.push_back(row_of(result, composition, level));
  return text_table(rows);
}

/// A field of a CSV line, in quotes where it has a comma, a quote or a new line.
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string csv_line(const std::vector<std::string>& fields) {
  std::vector<std::string> quoted;
  for (const std::string& field : fields) quoted.push_back(csv_field(field));
  return join(quoted, ",") + "\n";
}

std::string failures_of(const BenchResult& result) {
  std::string text;
  for (const BenchCell& cell : result.cells)
    if (!cell.failures.empty())
      text += "  " + join(result.parts[cell.composition], " + ") + ", noise " +
              format_number(100.0 * cell.noise) + " %: " + cell.failures.front() + "\n";
  return text.empty() ? text : "\nFailed (the first of each):\n" + text;
}

/// "3 of 8 cells", with draws that a limit left out; none where there is none.
std::vector<StageDone> cells_left_out(const BenchResult& result) {
  if (result.complete()) return {};
  const auto cut = std::count_if(result.cells.begin(), result.cells.end(),
                                 [](const BenchCell& cell) { return !cell.done; });
  return {{std::to_string(cut) + " of " + std::to_string(result.cells.size()) + " cells", false,
           kTimeIsUp}};
}

}  // namespace

Admission admission_of(const BenchResult& result) {
  return admit({.claim = Claim::Fits, .stages = cells_left_out(result)});
}

std::string format_text(const BenchResult& result) {
  std::string text;
  if (const Admission cut = admission_of(result); !cut.stands())
    text = "Incomplete: " + cut.why + "; " + cut.remedy + ".\n\n";
  for (std::size_t level = 0; level < result.noise.size(); ++level)
    text += (level > 0 ? "\n" : "") + std::string("Noise ") +
            format_number(100.0 * result.noise[level]) + " % of each state:\n" +
            table_of(result, level);
  return text + failures_of(result);
}

std::string format_csv(const BenchResult& result) {
  std::vector<std::string> head = result.kinds;
  for (const char* name : {"noise %", "draws", "failed", "exact structure rate",
                           "coefficient error", "terms", "sync error %", "time ms", "failure"})
    head.emplace_back(name);
  std::string text = csv_line(head);
  for (const BenchCell& cell : result.cells) {
    const BenchSummary summary = summary_of(cell);
    std::vector<std::string> row = result.parts[cell.composition];
    row.push_back(format_number(100.0 * cell.noise));
    row.push_back(drawn(cell));
    row.push_back(std::to_string(cell.failures.size()));
    row.push_back(number_or(summary.exact_rate, 1.0, ""));
    row.push_back(number_or(summary.coefficient_error, 1.0, ""));
    row.push_back(number_or(summary.terms, 1.0, ""));
    row.push_back(number_or(summary.sync, 100.0, cell.scores.empty() ? "" : "diverged"));
    row.push_back(number_or(summary.seconds, 1e3, ""));
    row.push_back(cell.failures.empty() ? "" : cell.failures.front());
    text += csv_line(row);
  }
  return text;
}

}  // namespace lacuna
