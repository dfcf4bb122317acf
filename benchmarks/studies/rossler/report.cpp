// SPDX-License-Identifier: MIT
#include "report.hpp"

#include <algorithm>
#include <iostream>
#include <limits>
#include <map>

#include "core/base/text.hpp"
#include "core/files/atomic_file.hpp"
#include "lacuna/identify/pipeline/presets.hpp"
#include "support/table.hpp"

namespace lacuna::benchmarks {
namespace {

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

std::vector<double> collect(const Cell& cell, double (*value)(const Score&)) {
  std::vector<double> values;
  for (const Score& score : cell.scores) values.push_back(value(score));
  return values;
}

double exact_rate(const Cell& cell) {
  const auto exact = std::count_if(cell.scores.begin(), cell.scores.end(),
                                   [](const Score& s) { return s.exact_structure; });
  return static_cast<double>(exact) / static_cast<double>(cell.scores.size());
}

std::string sync_text(const Cell& cell) {
  std::vector<double> values;
  for (const Score& score : cell.scores)
    if (score.sync) values.push_back(*score.sync);
  if (values.size() < cell.scores.size()) return "diverged";
  return format_number(100.0 * median(values), 3);
}

ResultTable full_table(const std::vector<Cell>& cells) {
  ResultTable table{
      {"filter", "regressor", "pruner", "derivative", "samples", "noise %", "draws",
       "exact structure rate", "coefficient error", "sync error %", "time ms"},
      {}};
  for (const Cell& cell : cells)
    table.rows.push_back(
        {cell.composition->filter, cell.composition->regressor, cell.composition->pruner,
         cell.composition->derivative, std::to_string(cell.condition.samples),
         format_number(100.0 * cell.condition.noise), std::to_string(cell.condition.draws),
         format_number(exact_rate(cell), 3),
         format_number(
             median(collect(cell, [](const Score& s) { return s.coefficient_error; })), 3),
         sync_text(cell),
         format_number(1e3 * median(collect(cell, [](const Score& s) { return s.seconds; })),
                       3)});
  return table;
}

/// Synchronisation error of a model that diverged: ranks last in a median.
constexpr double kDiverged = std::numeric_limits<double>::infinity();

/// What is pooled in the summary: one row for regressor and pruner, one column for derivative
/// and noise; filters and numbers of samples are pooled.
struct Summary {
  std::vector<std::string> rows, columns;
  std::map<std::pair<std::string, std::string>, std::vector<double>> rates;
  std::map<std::string, std::vector<double>> milliseconds, coefficient_errors, sync_errors;
};

void add_once(std::vector<std::string>& names, const std::string& name) {
  if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

Summary summarise(const std::vector<Cell>& cells) {
  Summary summary;
  for (const Cell& cell : cells) {
    const std::string row = cell.composition->regressor + " + " + cell.composition->pruner;
    const std::string column =
        cell.composition->derivative + " " + format_number(100.0 * cell.condition.noise) + " %";
    add_once(summary.rows, row);
    add_once(summary.columns, column);
    summary.rates[{row, column}].push_back(exact_rate(cell));
    for (const Score& score : cell.scores) {
      summary.milliseconds[row].push_back(1e3 * score.seconds);
      summary.coefficient_errors[row].push_back(score.coefficient_error);
      summary.sync_errors[row].push_back(100.0 * score.sync.value_or(kDiverged));
    }
  }
  return summary;
}

/// "irls-l1 + minor-terms" of "irls-l1[ceres] + minor-terms".
std::string without_inner(std::string row) {
  const std::size_t open = row.find('['), close = row.find(']');
  return open == std::string::npos ? row : row.erase(open, close - open + 1);
}

bool same_rates(const Summary& summary, const std::string& a, const std::string& b) {
  return std::all_of(summary.columns.begin(), summary.columns.end(), [&](const auto& column) {
    return summary.rates.at({a, column}) == summary.rates.at({b, column});
  });
}

void append(std::vector<double>& values, const std::vector<double>& more) {
  values.insert(values.end(), more.begin(), more.end());
}

/// Inner solvers that find the same structures in every cell share a row, "irls-l1[any]".
Summary folded(Summary all) {
  Summary result{{}, all.columns, all.rates, {}, {}, {}};
  for (const std::string& row : all.rows) {
    const std::string base = without_inner(row);
    const bool alike = std::all_of(all.rows.begin(), all.rows.end(), [&](const auto& other) {
      return without_inner(other) != base || same_rates(all, row, other);
    });
    std::string name = row;
    if (alike && base != row)
      name.replace(row.find('['), row.find(']') - row.find('[') + 1, "[any]");
    for (const std::string& column : all.columns)
      result.rates[{name, column}] = all.rates.at({row, column});
    add_once(result.rows, name);
    append(result.milliseconds[name], all.milliseconds.at(row));
    append(result.coefficient_errors[name], all.coefficient_errors.at(row));
    append(result.sync_errors[name], all.sync_errors.at(row));
  }
  return result;
}

/// The row of the default's stages.
std::string default_row() {
  const Pipeline pipeline = algorithm1();
  return std::string(pipeline.regressor->info().name) + " + " +
         std::string(pipeline.pruner->info().name);
}

/// The best numbers of a column stand out; all of them where they are the same.
void mark_best(ResultTable& table, std::size_t column, bool largest) {
  const auto value = [&](const auto& row) { return *parse_number(row[column]); };
  const auto [low, high] =
      std::minmax_element(table.rows.begin(), table.rows.end(),
                          [&](const auto& a, const auto& b) { return value(a) < value(b); });
  const double worst = value(largest ? *low : *high), best = value(largest ? *high : *low);
  if (worst == best) return;
  for (auto& row : table.rows)
    if (value(row) == best) row[column] = "**" + row[column] + "**";
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

ResultTable summary_table(const Summary& summary) {
  ResultTable table{{"regressor + pruner"}, {}};
  table.header.insert(table.header.end(), summary.columns.begin(), summary.columns.end());
  for (const char* name : {"coefficient error", "sync error %", "time ms"})
    table.header.push_back(name);
  for (const std::string& row : summary.rows) {
    std::vector<std::string> cells{row == default_row() ? row + " (default)" : row};
    for (const std::string& column : summary.columns)
      cells.push_back(format_number(100.0 * mean(summary.rates.at({row, column})), 3));
    for (const auto* values :
         {&summary.coefficient_errors, &summary.sync_errors, &summary.milliseconds})
      cells.push_back(format_number(median(values->at(row)), 3));
    table.rows.push_back(std::move(cells));
  }
  for (std::size_t column = 1; column < table.header.size(); ++column)
    mark_best(table, column, column <= summary.columns.size());
  return table;
}

/// Exact runs (%) of all compositions that share a part: one row for each, one column for each
/// noise; the best composition of the part in brackets.
ResultTable part_table(const std::vector<Cell>& cells, const std::string& part,
                       std::string Composition::* name) {
  std::vector<std::string> rows, columns;
  std::map<std::pair<std::string, std::string>,
           std::map<const Composition*, std::vector<double>>>
      rates;
  for (const Cell& cell : cells) {
    const std::string row = cell.composition->*name;
    const std::string column = format_number(100.0 * cell.condition.noise) + " %";
    add_once(rows, row);
    add_once(columns, column);
    rates[{row, column}][cell.composition].push_back(exact_rate(cell));
  }
  ResultTable table{{part}, {}};
  table.header.insert(table.header.end(), columns.begin(), columns.end());
  for (const std::string& row : rows) {
    std::vector<std::string> texts{row};
    for (const std::string& column : columns) {
      double sum = 0.0, best = 0.0;
      const auto& compositions = rates.at({row, column});
      for (const auto& [composition, own] : compositions) {
        sum += mean(own);
        best = std::max(best, mean(own));
      }
      texts.push_back(
          format_number(100.0 * sum / static_cast<double>(compositions.size()), 3) + " (" +
          format_number(100.0 * best, 3) + ")");
    }
    table.rows.push_back(std::move(texts));
  }
  return table;
}

std::string heat_map_data(const Summary& summary) {
  std::string text;
  for (const std::string& row : summary.rows) {
    for (const std::string& column : summary.columns)
      text += format_number(100.0 * mean(summary.rates.at({row, column})), 4) + " ";
    text += "\n";
  }
  return text;
}

/// Labels of an axis; gnuplot reads them as formats, in which a percent sign is doubled.
std::string tics(const std::vector<std::string>& names) {
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::string label;
    for (const char c : names[i]) label += c == '%' ? std::string("%%") : std::string(1, c);
    parts.push_back("\"" + label + "\" " + std::to_string(i));
  }
  return "(" + join(parts, ", ") + ")";
}

std::string heat_map_script(const Summary& summary) {
  const std::size_t rows = summary.rows.size(), columns = summary.columns.size();
  const std::size_t width = 520 + 60 * columns, height = 260 + 24 * rows;
  const auto fraction = [](double part, std::size_t whole) {
    return std::to_string(part / static_cast<double>(whole));
  };
  return "set terminal svg size " + std::to_string(width) + "," + std::to_string(height) +
         " font 'sans,12' background 'white'\nset output 'rossler.svg'\n"
         "set title 'Rossler, 20 candidate terms: runs with exactly the true terms (%)'\n"
         "set lmargin at screen " +
         fraction(390.0, width) + "\nset rmargin at screen 1-" + fraction(100.0, width) +
         "\nset bmargin at screen " + fraction(200.0, height) + "\nset tmargin at screen 1-" +
         fraction(40.0, height) + "\nset xtics rotate by 35 right " + tics(summary.columns) +
         "\nset ytics " + tics(summary.rows) + "\nset yrange [" + std::to_string(rows) +
         "-0.5:-0.5]\nset xrange [-0.5:" + std::to_string(columns) +
         "-0.5]\nset cbrange [0:100]\n"
         "set palette defined (0 '#f7f7f7', 50 '#92c5de', 100 '#4393c3')\n"
         "set tics scale 0\nunset key\nset colorbox\n"
         "plot 'rossler.dat' matrix with image pixels, \\\n"
         "  'rossler.dat' matrix using 1:2:(sprintf('%.0f', $3)) with labels font ',11'\n";
}

}  // namespace

void write_report(const std::filesystem::path& folder, const std::vector<Cell>& cells,
                  const Origin& origin) {
  const Summary summary = folded(summarise(cells));
  write_file_atomically(folder / "rossler.csv", full_table(cells).csv());
  write_file_atomically(folder / "rossler.dat", heat_map_data(summary));
  write_file_atomically(folder / "rossler.gp", heat_map_script(summary));
  write_file_atomically(
      folder / "rossler.md",
      "Share of runs (%) with exactly the true terms; Rossler (a = b = 0.2, c = 5.7), h = "
      "0.05, 20 "
      "candidate terms, every filter x\nregressor x pruner x derivative; 1000 and 4000 "
      "samples are pooled.\n\nMade by "
      "`study_rossler` on " +
          origin.day + ", " + origin.machine + ", in " + format_number(origin.seconds, 3) +
          " s.\n\n## Parts\n\nMean over all compositions with a part, in brackets the best of "
          "them.\n\n" +
          part_table(cells, "derivative", &Composition::derivative).markdown() + "\n" +
          part_table(cells, "filter", &Composition::filter).markdown() +
          "\n## Regressors and pruners\n\nColumns: derivative and noise; filters are pooled. "
          "Errors and time: medians over all runs of a row; what a\nformulation chooses for a "
          "record is chosen once and not in the time. The best of a column is bold; [any]: "
          "inner\nsolvers that find the same.\n\n" +
          summary_table(summary).markdown());
  if (!render_with_gnuplot(folder / "rossler.gp"))
    std::cerr << "no picture: gnuplot is not installed (package gnuplot-nox)\n";
}

}  // namespace lacuna::benchmarks
