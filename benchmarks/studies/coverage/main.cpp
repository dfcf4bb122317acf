// SPDX-License-Identifier: MIT
// How often the 95 % intervals of the refinement contain the truth. Usage:
// study_coverage [OUTPUT_FOLDER] [DRAWS] [--cells FOLDER]
//                     (default build/studies/coverage, 200)
#include <algorithm>
#include <cmath>
#include <iostream>

#include "core/base/text.hpp"
#include "support/refinement_draws.hpp"
#include "support/settings.hpp"
#include "support/table.hpp"

namespace lacuna::benchmarks {
namespace {

std::string percent(double fraction) { return format_number(100.0 * fraction, 3); }

/// Fraction of all intervals of a cell that contain the truth.
double coverage(const RefinementDraws& cell) {
  double inside = 0.0, all = 0.0;
  for (const RefinementDraw& draw : cell.draws) {
    inside += static_cast<double>(
        (draw.errors.cwiseAbs().array() <= draw.half_widths.array()).count());
    all += static_cast<double>(draw.errors.size());
  }
  return inside / all;
}

/// The coefficient whose intervals contain the truth least often.
double worst_coverage(const RefinementDraws& cell) {
  Vector inside = Vector::Zero(cell.draws.front().errors.size());
  for (const RefinementDraw& draw : cell.draws)
    inside.array() +=
        (draw.errors.cwiseAbs().array() <= draw.half_widths.array()).cast<double>();
  return inside.minCoeff() / static_cast<double>(cell.draws.size());
}

double fraction_of(const RefinementDraws& cell, bool RefinementDraw::*property) {
  return static_cast<double>(std::count_if(cell.draws.begin(), cell.draws.end(),
                                           [&](const auto& d) { return d.*property; })) /
         static_cast<double>(cell.draws.size());
}

double mean_milliseconds(const RefinementDraws& cell) {
  double sum = 0.0;
  for (const RefinementDraw& draw : cell.draws) sum += draw.seconds;
  return 1e3 * sum / static_cast<double>(cell.draws.size());
}

ResultTable table_of(const std::vector<RefinementDraws>& cells) {
  ResultTable table{{"system", "samples", "noise %", "draws", "coverage %",
                     "worst coefficient %", "converged %", "called noise %", "time ms"},
                    {}};
  for (const RefinementDraws& cell : cells)
    table.rows.push_back({cell.condition.system, std::to_string(cell.condition.samples),
                          percent(cell.condition.noise), std::to_string(cell.draws.size()),
                          percent(coverage(cell)), percent(worst_coverage(cell)),
                          percent(fraction_of(cell, &RefinementDraw::converged)),
                          percent(fraction_of(cell, &RefinementDraw::fits_to_noise)),
                          format_number(mean_milliseconds(cell), 3)});
  return table;
}

int run(const StudyArguments& arguments) {
  const std::size_t draws = arguments.count_at(1, 200);
  const auto finished = run_refinements(arguments.store(), draws);
  if (!finished) return 0;
  const Origin& origin = finished->origin;
  const ResultTable table = table_of(finished->conditions);
  write_results(
      arguments.folder_at(0), "coverage", table.csv(),
      "# Coverage of the 95 % intervals of the refinement\n\nStructure given, coefficients "
      "start "
      "up to 10 % off, white noise of the stated share of each state's\nstandard deviation, "
      "noise estimated from the residuals. \"called noise\": share of draws whose residuals\n"
      "pass as noise.\n\n" +
          table.markdown() + "\n" + origin.machine + ", " + origin.day + ", " +
          format_number(origin.seconds, 3) + " s. Command: `study_coverage FOLDER " +
          std::to_string(draws) + "`\n");
  std::cout << table.markdown();
  return 0;
}

}  // namespace
}  // namespace lacuna::benchmarks

int main(int argc, char** argv) {
  return lacuna::benchmarks::study_main(
      {"coverage", "[OUTPUT_FOLDER] [DRAWS]", lacuna::benchmarks::run}, argc, argv);
}
