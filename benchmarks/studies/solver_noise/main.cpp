// SPDX-License-Identifier: MIT
// Identifies twelve flows from records as solvers write them: tolerances, interpolation between
// steps, fixed steps, printed digits. Usage:
// study_solver_noise [OUTPUT_FOLDER] [EFFECT_SIZE...] [--cells FOLDER]
//                    (default build/studies/solver_noise; effect sizes beside the default)
// study_solver_noise verdicts OUTPUT_FOLDER [--cells FOLDER]
//                    what is said of the models
#include <algorithm>
#include <filesystem>
#include <functional>
#include <iostream>
#include <span>
#include <vector>

#include "lacuna/core/atomic_file.hpp"
#include "lacuna/core/text.hpp"
#include "lacuna/pipeline/presets.hpp"
#include "lacuna/pruners/minor_terms.hpp"
#include "lacuna/selection/trajectory_selection.hpp"
#include "records.hpp"
#include "support/accuracy.hpp"
#include "support/parallel.hpp"
#include "support/settings.hpp"
#include "support/table.hpp"
#include "verdicts.hpp"

namespace lacuna::benchmarks {
namespace {

/// A preset with a size from which on terms count.
struct Method {
  std::string name;
  Pipeline pipeline;
};

Method method(const std::string& name, std::optional<double> effect_size = {}) {
  Pipeline pipeline = preset(name);
  if (!effect_size) return {name, std::move(pipeline)};
  const auto& refiner = dynamic_cast<const TrajectorySelection&>(*pipeline.refiner);
  TrajectorySelectionOptions options = refiner.options();
  options.negligible.effect_size = *effect_size;
  pipeline.refiner = TrajectorySelection{options};
  pipeline.pruner = MinorTerms{{.negligible = {.effect_size = *effect_size}}};
  return {name + ", effect size " + format_number(*effect_size), std::move(pipeline)};
}

/// What a method made of one record.
struct Outcome {
  bool exact = false;
  double error = 0.0, seconds = 0.0;

  auto fields() { return std::tie(exact, error, seconds); }
};

Outcome run(const Flow& flow, const Making& making, const Method& method) {
  const Dataset record = solver_record(flow, making);
  const double begin = thread_seconds();
  const IdentificationResult result = identify(record, method.pipeline);
  const ModelAccuracy accuracy = compare_models(result.model, flow.model);
  return {accuracy.exact_structure, accuracy.relative_error, thread_seconds() - begin};
}

/// What is identified: every flow by every method, from records of every making.
struct Plan {
  std::vector<Flow> flows;
  std::vector<Method> methods;
  std::vector<Making> makings;

  /// Records of one making, identified by each of the methods.
  std::size_t of_making() const { return flows.size() * methods.size(); }
};

CellWork<Outcome> cells_of(const Plan& plan) {
  CellWork<Outcome> cells;
  for (const Making& making : plan.makings)
    for (const Method& method : plan.methods)
      for (const Flow& flow : plan.flows)
        cells.names.push_back(flow.name + ", " + making.name + ", " + method.name);
  cells.work = [&plan](std::size_t i) {
    const std::size_t within = i % plan.of_making(), count = plan.flows.size();
    return run(plan.flows[within % count], plan.makings[i / plan.of_making()],
               plan.methods[within / count]);
  };
  return cells;
}

/// How many flows each method finds exactly.
std::vector<int> exact_of(const Plan& plan, std::span<const Outcome> outcomes) {
  std::vector<int> exact(plan.methods.size());
  for (std::size_t i = 0; i < outcomes.size(); ++i)
    exact[i / plan.flows.size()] += outcomes[i].exact ? 1 : 0;
  return exact;
}

std::vector<std::string> summary_row(const std::string& name, int records,
                                     const std::vector<int>& exact) {
  std::vector<std::string> row{name, std::to_string(records)};
  for (const int count : exact) row.push_back(std::to_string(count));
  return row;
}

ResultTable summary_of(const Plan& plan, const Finished<Outcome>& finished) {
  ResultTable summary{{"records by", "flows"}, {}};
  for (const Method& each : plan.methods) summary.header.push_back(each.name);
  const int flows = static_cast<int>(plan.flows.size());
  std::vector<int> totals(plan.methods.size());
  int records = 0;
  for (std::size_t k = 0; k < plan.makings.size(); ++k) {
    const Making& making = plan.makings[k];
    const auto exact = exact_of(plan, finished.part(k * plan.of_making(), plan.of_making()));
    summary.rows.push_back(summary_row(making.name, flows, exact));
    if (!making.counts) continue;
    records += flows;
    std::ranges::transform(totals, exact, totals.begin(), std::plus{});
  }
  summary.rows.push_back(summary_row("all but the two coarsest", records, totals));
  return summary;
}

ResultTable details_of(const Plan& plan, const Finished<Outcome>& finished) {
  ResultTable details{
      {"records by", "flow", "method", "exact", "coefficient error", "CPU seconds"}, {}};
  auto outcome = finished.values.begin();
  for (const Making& making : plan.makings)
    for (const Method& method : plan.methods)
      for (const Flow& flow : plan.flows) {
        details.rows.push_back({making.name, flow.name, method.name, outcome->exact ? "1" : "0",
                                format_number(outcome->error, 3),
                                format_number(outcome->seconds, 3)});
        ++outcome;
      }
  return details;
}

int run_study(const StudyArguments& arguments) {
  if (arguments.at(0) == "verdicts") return write_verdicts(arguments);
  const std::filesystem::path folder = arguments.folder_at(0);
  Plan plan{flows(), {method("algorithm1"), method("robust")}, makings()};
  for (std::size_t i = 1; i < arguments.places.size(); ++i)
    plan.methods.push_back(method("algorithm1", parse_number(arguments.at(i)).value_or(1e-3)));
  const auto finished = run_cells(arguments.store(), cells_of(plan));
  if (!finished) return 0;
  const ResultTable summary = summary_of(plan, *finished);
  std::filesystem::create_directories(folder);
  write_file_atomically(folder / "solver_noise.csv", details_of(plan, *finished).csv());
  write_file_atomically(
      folder / "solver_noise.md",
      "Records without measurement noise, as solvers write them: in how many of the flows "
      "exactly the true terms\nof all equations are found among monomials up to degree 3. "
      "Adaptive: Dormand and Prince's 5(4) pair with steps of its\nown, sampled by its "
      "interpolant. Lorenz, Rossler, memristor, Chua with a cubic, a linear chain of four, "
      "Sprott A,\nvan der Pol, FitzHugh-Nagumo, Duffing with an input, Lotka-Volterra, "
      "Brusselator, SIR.\n\nMade by `study_solver_noise FOLDER 0.0005 0.002` on " +
          finished->origin.day + ", " + finished->origin.machine + ".\n\n" +
          summary.markdown());
  std::cout << summary.markdown();
  return 0;
}

}  // namespace
}  // namespace lacuna::benchmarks

int main(int argc, char** argv) {
  return lacuna::benchmarks::study_main(
      {"solver_noise", "[verdicts] [OUTPUT_FOLDER] [EFFECT_SIZE...]",
       lacuna::benchmarks::run_study},
      argc, argv);
}
