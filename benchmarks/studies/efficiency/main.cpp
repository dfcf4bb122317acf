// SPDX-License-Identifier: MIT
// Errors of refined coefficients in units of the Cramer-Rao bound. Usage:
// study_efficiency [OUTPUT_FOLDER] [DRAWS] [--cells FOLDER]
//                     (default build/studies/efficiency, 200)
#include <algorithm>
#include <cmath>
#include <iostream>

#include "core/base/text.hpp"
#include "support/refinement_draws.hpp"
#include "support/settings.hpp"
#include "support/table.hpp"

namespace lacuna::benchmarks {
namespace {

/// Median over the draws of the root mean square of error / bound over the coefficients.
double median_ratio(const RefinementDraws& cell, Vector RefinementDraw::*bound) {
  std::vector<double> ratios;
  for (const RefinementDraw& draw : cell.draws)
    ratios.push_back(draw.errors.cwiseQuotient(draw.*bound).norm() /
                     std::sqrt(static_cast<double>(draw.errors.size())));
  std::sort(ratios.begin(), ratios.end());
  return ratios[ratios.size() / 2];
}

/// Root mean square of error / bound over all draws: 1 for an efficient estimate.
double rms_ratio(const RefinementDraws& cell, Vector RefinementDraw::*bound) {
  double squares = 0.0, count = 0.0;
  for (const RefinementDraw& draw : cell.draws) {
    squares += draw.errors.cwiseQuotient(draw.*bound).squaredNorm();
    count += static_cast<double>(draw.errors.size());
  }
  return std::sqrt(squares / count);
}

ResultTable table_of(const std::vector<RefinementDraws>& cells) {
  ResultTable table{{"system", "samples", "noise %", "draws", "error / bound, median",
                     "error / bound, rms", "error / whole-record bound, median"},
                    {}};
  for (const RefinementDraws& cell : cells)
    table.rows.push_back({cell.condition.system, std::to_string(cell.condition.samples),
                          format_number(100.0 * cell.condition.noise, 3),
                          std::to_string(cell.draws.size()),
                          format_number(median_ratio(cell, &RefinementDraw::bound), 3),
                          format_number(rms_ratio(cell, &RefinementDraw::bound), 3),
                          format_number(median_ratio(cell, &RefinementDraw::whole_bound), 3)});
  return table;
}

int run(const StudyArguments& arguments) {
  const std::size_t draws = arguments.count_at(1, 200);
  const auto finished = run_refinements(arguments.store(), draws);
  if (!finished) return 0;
  const Origin& origin = finished->origin;
  const ResultTable table = table_of(finished->conditions);
  write_results(
      arguments.folder_at(0), "efficiency", table.csv(),
      "# Error of refined coefficients over the Cramer-Rao bound\n\nThe bound is that of the "
      "windows used, at the true model and the true noise; the last column holds the\nerror "
      "against the bound of the whole record as one window. An efficient estimate has 1 as "
      "root mean square.\n\n" +
          table.markdown() + "\n" + origin.machine + ", " + origin.day + ", " +
          format_number(origin.seconds, 3) + " s. Command: `study_efficiency FOLDER " +
          std::to_string(draws) + "`\n");
  std::cout << table.markdown();
  return 0;
}

}  // namespace
}  // namespace lacuna::benchmarks

int main(int argc, char** argv) {
  return lacuna::benchmarks::study_main(
      {"efficiency", "[OUTPUT_FOLDER] [DRAWS]", lacuna::benchmarks::run}, argc, argv);
}
