// SPDX-License-Identifier: MIT
// Planned experiments beside standard ones of equal cost: how often they decide between rivals.
// Usage: study_experiments [OUTPUT_FOLDER] [DRAWS]     (default build/studies/experiments, 2)
#include <algorithm>
#include <cmath>
#include <iostream>
#include <iterator>

#include "core/base/text.hpp"
#include "loop.hpp"
#include "support/settings.hpp"
#include "support/table.hpp"

namespace lacuna::benchmarks {
namespace {

constexpr double kDecisive = 3.0;  // a log Bayes factor from which a rival is out

std::string of(int count, std::size_t all) {
  return std::to_string(count) + "/" + std::to_string(all);
}

int decided(const std::vector<LoopOutcome>& draws, std::size_t experiment) {
  return static_cast<int>(
      std::count_if(draws.begin(), draws.end(), [&](const LoopOutcome& one) {
        return one.margins.at(experiment) > kDecisive;
      }));
}

std::vector<std::string> row_of(const std::string& name,
                                const std::vector<LoopOutcome>& draws) {
  const auto old = static_cast<int>(
      std::count_if(draws.begin(), draws.end(), [](const LoopOutcome& one) {
        return one.old_margin > kDecisive;
      }));
  std::vector<std::string> row{name, of(old, draws.size())};
  for (std::size_t e = 0; e < std::size(kExperiments); ++e)
    row.push_back(of(decided(draws, e), draws.size()));
  return row;
}

double quantile(std::vector<double> values, double fraction) {
  if (values.empty()) return NAN;
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(fraction * double(values.size() - 1))];
}

/// Promised against obtained, over all draws.
std::string calibration(const std::vector<LoopOutcome>& all) {
  std::vector<double> factors, ratios, widths, seconds;
  int covered = 0, intervals = 0;
  for (const LoopOutcome& one : all) {
    seconds.push_back(one.seconds);
    covered += one.covered;
    intervals += one.intervals;
    widths.insert(widths.end(), one.widths.begin(), one.widths.end());
    if (!(one.promised > kDecisive)) continue;
    const double ratio = std::max(one.obtained, 1e-3) / one.promised;
    ratios.push_back(ratio);
    factors.push_back(std::max(ratio, 1.0 / ratio));
  }
  const auto number = [](double value) { return format_number(value, 3); };
  return "Log Bayes factor obtained over promised: median " + number(quantile(ratios, 0.5)) +
         ", factor between them: median " + number(quantile(factors, 0.5)) + ", 90 % below " +
         number(quantile(factors, 0.9)) + " (" + std::to_string(ratios.size()) +
         " plans).\nPromised intervals: the truth is in " + of(covered, intervals) +
         "; standard errors obtained over promised: median " + number(quantile(widths, 0.5)) +
         ", 10 % to 90 %: " + number(quantile(widths, 0.1)) + " to " +
         number(quantile(widths, 0.9)) + ".\nTime of a plan: median " +
         number(quantile(seconds, 0.5)) + " s, longest " + number(quantile(seconds, 1.0)) +
         " s on one thread.\n";
}

int run(const StudyArguments& arguments) {
  const std::size_t draws = arguments.count_at(1, 2);
  ResultTable table{{"rivals", "old record"}, {}};
  for (const char* name : kExperiments) table.header.push_back(name);
  std::vector<LoopOutcome> all;
  for (const RivalCase& rivals : rival_cases()) {
    std::vector<LoopOutcome> own;
    for (std::size_t draw = 0; draw < draws; ++draw) own.push_back(go_round(rivals, draw));
    table.rows.push_back(row_of(rivals.name, own));
    std::cout << rivals.name << ": " << table.rows.back()[1] << ", plan "
              << table.rows.back()[2] << std::endl;
    all.insert(all.end(), own.begin(), own.end());
  }
  table.rows.push_back(row_of("all", all));
  const std::string text =
      "# Planned experiments\n\nDraws in which the right model's log Bayes factor over its best "
      "rival is above 3: after an old record about the\nworking point alone, and with one more "
      "run: the planned one is the shortest that promises to decide in 95 %, the others are as\n"
      "long. Noise 1 % of what the whole range of the input gives, true parameters up to 20 % "
      "off.\n\n" +
      table.markdown() + "\n" + calibration(all) + "\n" + machine_description() + ", " +
      today() + ". Command: `study_experiments FOLDER " + std::to_string(draws) + "`\n";
  write_results(arguments.folder_at(0), "experiments", table.csv(), text);
  std::cout << text;
  return 0;
}

}  // namespace
}  // namespace lacuna::benchmarks

int main(int argc, char** argv) {
  return lacuna::benchmarks::study_main(
      {"experiments", "[OUTPUT_FOLDER] [DRAWS]", lacuna::benchmarks::run}, argc, argv);
}
