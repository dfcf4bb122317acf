// SPDX-License-Identifier: MIT
// How often right structures are called wrong, and wrong ones adequate. Usage:
// study_adequacy [OUTPUT_FOLDER] [DRAWS] [--cells FOLDER]  (default build/studies/adequacy, 50)
#include <cmath>
#include <iostream>
#include <tuple>

#include "core/base/text.hpp"
#include "lacuna/trajectories/fit/fit.hpp"
#include "structures.hpp"
#include "support/grey_box.hpp"
#include "support/parallel.hpp"
#include "support/settings.hpp"
#include "support/table.hpp"

namespace lacuna::benchmarks {
namespace {

/// The right and the wrong structure fitted to one record.
struct Draw {
  int right = 0, wrong = 0;  ///< Adequate as a number
  double likelihood_ratio = 0.0;  ///< log of that of the right one over that of the wrong one
  double seconds = 0.0;

  auto fields() { return std::tie(right, wrong, likelihood_ratio, seconds); }
};

/// log-likelihood at the largest one over deviations of the noise, up to a constant.
double log_likelihood(const Fit& fit) {
  double sum = 0.0;
  for (const FitQuality& quality : fit.quality)
    sum -= static_cast<double>(quality.samples) * std::log(quality.rmse);
  return sum;
}

Draw draw_of(const StructurePair& pair, std::uint64_t number) {
  const Vector start = Eigen::Map<const Vector>(pair.start.data(),
                                                static_cast<Index>(pair.start.size()));
  const SystemModel right = parse_ode_system(pair.right, pair.name);
  const Dataset columns = support::grey_box_columns(right.model(), {.start = start,
                                                                    .step = pair.step,
                                                                    .samples = pair.samples,
                                                                    .noise = pair.noise,
                                                                    .seed = number});
  const SystemModel wrong = parse_ode_system(pair.wrong, pair.name);
  const double begin = thread_seconds();
  const auto fitted = [&](const SystemModel& system) {
    RunContext context;
    context.seed = number;
    const Dataset view = model_view(system.model(), columns, finite_differences());
    return fit(system, view, {}, {}, context);
  };
  const Fit a = fitted(right), b = fitted(wrong);
  return {static_cast<int>(a.adequacy.fits), static_cast<int>(b.adequacy.fits),
          log_likelihood(a) - log_likelihood(b), thread_seconds() - begin};
}

/// Counts of draws of one or of all pairs.
struct Counts {
  double draws = 0, refused = 0, untold = 0, apart = 0, adequate = 0, unclear = 0, ratio = 0,
         finite = 0;  ///< draws in which the wrong structure had a finite run

  void add(const Draw& draw) {
    constexpr double kApart = 10.0;  // likelihood ratio from which structures count as apart
    ++draws;
    refused += draw.right == static_cast<int>(Adequate::No) ? 1 : 0;
    untold += draw.right == static_cast<int>(Adequate::Undetermined) ? 1 : 0;
    if (std::isfinite(draw.likelihood_ratio)) {
      ratio += draw.likelihood_ratio;
      ++finite;
    }
    if (draw.likelihood_ratio <= std::log(kApart)) return;
    ++apart;
    adequate += draw.wrong == static_cast<int>(Adequate::Yes) ? 1 : 0;
    unclear += draw.wrong == static_cast<int>(Adequate::Undetermined) ? 1 : 0;
  }

  std::vector<std::string> row(const std::string& name) const {
    const auto percent = [](double part, double whole) {
      return whole > 0.0 ? format_number(100.0 * part / whole, 3) : std::string("-");
    };
    return {name,
            format_number(draws),
            percent(refused, draws),
            percent(untold, draws),
            format_number(ratio / finite, 3),
            format_number(apart),
            percent(adequate, apart),
            percent(unclear, apart)};
  }
};

ResultTable table_of(const std::vector<StructurePair>& pairs, const Finished<Draw>& finished) {
  ResultTable table{{"structure", "draws", "right refused %", "right undetermined %",
                     "mean log ratio", "wrong apart", "wrong adequate %",
                     "wrong undetermined %"},
                    {}};
  Counts all;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    Counts own;
    for (const Draw& draw : finished.group(k)) {
      own.add(draw);
      all.add(draw);
    }
    table.rows.push_back(own.row(pairs[k].name));
  }
  table.rows.push_back(all.row("all"));
  return table;
}

int run(const StudyArguments& arguments) {
  const std::size_t draws = arguments.count_at(1, 50);
  const std::vector<StructurePair> pairs = structure_pairs();
  Cells<Draw> cells;
  for (const StructurePair& pair : pairs)
    cells.add_draws(pair.name, draws,
                    [&](std::size_t number) { return draw_of(pair, number); });
  const auto finished = run_cells(arguments.store(), cells);
  if (!finished) return 0;
  const ResultTable table = table_of(pairs, *finished);
  write_results(arguments.folder_at(0), "adequacy", table.csv(),
                "# Adequacy of right and wrong structures\n\nOne record of 40 samples with "
                "white noise of 3 % of each output's standard deviation, fitted by the "
                "structure\nthat made it and by one that lacks something. refused: called "
                "inadequate at the stated level of 5 %. apart: draws in\nwhich the "
                "likelihood of the right "
                "structure is more than 10 times that of the wrong one.\n\n" +
                    table.markdown() + "\n" + finished->origin.machine + ", " +
                    finished->origin.day + ".\n");
  std::cout << table.markdown();
  return 0;
}

}  // namespace
}  // namespace lacuna::benchmarks

int main(int argc, char** argv) {
  return lacuna::benchmarks::study_main(
      {"adequacy", "[OUTPUT_FOLDER] [DRAWS]", lacuna::benchmarks::run}, argc, argv);
}
