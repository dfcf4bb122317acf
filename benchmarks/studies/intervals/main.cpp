// SPDX-License-Identifier: MIT
// How often 95 % intervals by profiles contain the truth under laws of noise. Usage:
// study_intervals [OUTPUT_FOLDER] [DRAWS] [--cells FOLDER]  (default build/studies/intervals, 100)
#include <cmath>
#include <iostream>
#include <tuple>

#include "cases.hpp"
#include "core/base/text.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/derivatives/differentiators.hpp"
#include "lacuna/data/records/marks.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/records/binding/model_view.hpp"
#include "lacuna/trajectories/fit/fit.hpp"
#include "support/parallel.hpp"
#include "support/settings.hpp"
#include "support/table.hpp"

namespace lacuna::benchmarks {
namespace {

/// What one draw gave; counts of its parameters.
struct Draw {
  int numbers = 0, inside = 0;
  int one_sided = 0;  ///< with a limit on one side, of those with an interval
  int without = 0;    ///< neither interval nor limit
  bool failed = false, converged = false;
  double seconds = 0.0;

  auto fields() {
    return std::tie(numbers, inside, one_sided, without, failed, converged, seconds);
  }
};

/// NaN as missing samples.
void mark_missing(Dataset& data) {
  for (Trajectory& run : data.trajectories) {
    run.marks = Matrix::Zero(run.samples(), run.states.cols());
    for (Index i = 0; i < run.states.size(); ++i)
      if (std::isnan(run.states.data()[i])) {
        run.marks.data()[i] = number_of(Mark::Missing);
        run.states.data()[i] = 0.0;
      }
  }
}

Draw draw_of(const IntervalCase& one, MeasuredBy noise, std::uint64_t number) {
  IntervalDraw drawn = interval_draw(one, noise, number);
  mark_missing(drawn.columns);
  const SystemModel system = parse_ode_system(drawn.model, one.name);
  FitOptions options;
  options.effort = Thoroughness::Full;
  RunContext context;
  context.seed = number;
  Draw draw;
  draw.numbers = static_cast<int>(drawn.truth.size());
  const double begin = thread_seconds();
  try {
    const Fit found =
        fit(system, model_view(system.model(), drawn.columns, finite_differences()), {},
            options, context);
    draw.converged = found.converged;
    if (found.numbers.size() != drawn.truth.size())
      throw ArgumentError("study_intervals", "a number without a truth was fitted", "");
    for (std::size_t i = 0; i < found.numbers.size(); ++i) {
      const FittedParameter& estimate = found.numbers[i];
      const double truth = drawn.truth[i];
      const bool is_one_sided = estimate.at_least || estimate.at_most;
      draw.one_sided += is_one_sided ? 1 : 0;
      draw.without += !estimate.ci95 && !is_one_sided ? 1 : 0;
      if (estimate.ci95)
        draw.inside += truth >= (*estimate.ci95)[0] && truth <= (*estimate.ci95)[1] ? 1 : 0;
      else if (is_one_sided)
        draw.inside += truth >= estimate.at_least.value_or(truth) &&
                               truth <= estimate.at_most.value_or(truth)
                           ? 1
                           : 0;
    }
  } catch (const Error&) {
    draw.failed = true;
  }
  draw.seconds = thread_seconds() - begin;
  return draw;
}

std::vector<std::string> row_of(const IntervalCase& one, const char* noise,
                                std::span<const Draw> draws) {
  double intervals = 0, inside = 0, one_sided = 0, without = 0, failed = 0, converged = 0,
         seconds = 0;
  for (const Draw& draw : draws) {
    seconds += draw.seconds;
    failed += draw.failed ? 1 : 0;
    if (draw.failed) continue;
    converged += draw.converged ? 1 : 0;
    intervals += draw.numbers - draw.without;
    inside += draw.inside;
    one_sided += draw.one_sided;
    without += draw.without;
  }
  const auto count = static_cast<double>(draws.size());
  const double share = inside / intervals;
  return {one.name,
          noise,
          format_number(count),
          format_number(intervals),
          format_number(100.0 * share, 3),
          format_number(100.0 * std::sqrt(share * (1.0 - share) / intervals), 2),
          format_number(one_sided),
          format_number(without),
          format_number(failed),
          format_number(100.0 * converged / count, 3),
          format_number(seconds / count, 3)};
}

int run(const StudyArguments& arguments) {
  const std::size_t draws = arguments.count_at(1, 100);
  const std::vector<IntervalCase> cases = interval_cases();
  Cells<Draw> cells;
  for (const IntervalCase& one : cases)
    for (std::size_t noise = 0; noise < kMeasuredBy.size(); ++noise)
      cells.add_draws(one.name + " " + kMeasuredBy.at(noise), draws, [&one, noise](std::size_t k) {
        return draw_of(one, static_cast<MeasuredBy>(noise), k);
      });
  const auto finished = run_cells(arguments.store(), cells);
  if (!finished) return 0;
  ResultTable table{{"system", "noise", "draws", "intervals", "covered %", "+- %", "one-sided",
                     "none", "failed", "converged %", "seconds"},
                    {}};
  for (std::size_t k = 0; k < cases.size() * kMeasuredBy.size(); ++k)
    table.rows.push_back(row_of(cases[k / kMeasuredBy.size()],
                                kMeasuredBy.at(k % kMeasuredBy.size()), finished->group(k)));
  write_results(
      arguments.folder_at(0), "intervals", table.csv(),
      "# Coverage of 95 % intervals by profiles of the likelihood\n\nStructure and law of the "
      "noise given, sizes of the noise estimated, parameters start up to 20 % off "
      "([design](../design.md)).\nFailed draws count as no interval. +-: one standard error of "
      "the share, were intervals independent.\n\n" +
          table.markdown() + "\n" + finished->origin.machine + ", " + finished->origin.day +
          ", " + format_number(finished->origin.seconds, 3) +
          " s. Command: `study_intervals FOLDER " + std::to_string(draws) + "`\n");
  std::cout << table.markdown();
  return 0;
}

}  // namespace
}  // namespace lacuna::benchmarks

int main(int argc, char** argv) {
  return lacuna::benchmarks::study_main(
      {"intervals", "[OUTPUT_FOLDER] [DRAWS]", lacuna::benchmarks::run}, argc, argv);
}
