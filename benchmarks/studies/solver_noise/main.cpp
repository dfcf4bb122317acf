// SPDX-License-Identifier: MIT
// Identifies twelve flows from records as solvers write them: tolerances, interpolation between
// steps, fixed steps, printed digits. Usage:
// study_solver_noise [OUTPUT_FOLDER] [EFFECT_SIZE...] [--cells FOLDER]
//                    (default build/studies/solver_noise; effect sizes beside the default)
// study_solver_noise verdicts OUTPUT_FOLDER [--cells FOLDER]
//                    what is said of the models
#include <iostream>
#include <map>
#include <span>
#include <vector>

#include "core/base/text.hpp"
#include "lacuna/identify/pipeline/presets.hpp"
#include "lacuna/model/equations/ode_model.hpp"
#include "lacuna/regression/pruners.hpp"
#include "records.hpp"
#include "support/parallel.hpp"
#include "support/settings.hpp"
#include "support/table.hpp"
#include "trajectories/refiners/trajectory_selection.hpp"
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
  pipeline.refiner = trajectory_selection(options);
  pipeline.pruner = minor_terms({.negligible = {.effect_size = *effect_size}});
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

/// All records, made by each of the methods.
class Study {
 public:
  explicit Study(std::vector<Method> methods) : methods_(std::move(methods)) {}

  void add_cells(const Making& making, Cells<Outcome>& cells) const {
    cells.begin_group(making.name);
    for (const Flow& flow : flows_)
      for (const Method& each : methods_)
        cells.add(flow.name + " " + each.name, [&] { return run(flow, making, each); });
  }

  void add_rows(const Making& making, std::span<const Outcome> outcomes) {
    std::vector<std::string> row{making.name, std::to_string(flows_.size())};
    for (std::size_t m = 0; m < methods_.size(); ++m) {
      int exact = 0;
      for (std::size_t f = 0; f < flows_.size(); ++f) {
        const Outcome& outcome = outcomes[f * methods_.size() + m];
        exact += outcome.exact ? 1 : 0;
        details.rows.push_back({making.name, flows_[f].name, methods_[m].name,
                                outcome.exact ? "1" : "0", format_number(outcome.error, 3),
                                format_number(outcome.seconds, 3)});
      }
      row.push_back(std::to_string(exact));
      if (making.counts) totals_[m] += exact;
    }
    if (making.counts) records_ += static_cast<int>(flows_.size());
    summary.rows.push_back(std::move(row));
  }

  void add_total() {
    std::vector<std::string> row{"all but the two coarsest", std::to_string(records_)};
    for (std::size_t m = 0; m < methods_.size(); ++m) row.push_back(std::to_string(totals_[m]));
    summary.rows.push_back(std::move(row));
  }

  void write_header() {
    summary.header = {"records by", "flows"};
    for (const Method& each : methods_) summary.header.push_back(each.name);
    details.header = {"records by",        "flow",       "method", "exact",
                      "coefficient error", "CPU seconds"};
  }

  ResultTable summary, details;

 private:
  std::vector<Method> methods_;
  std::vector<Flow> flows_ = flows();
  std::map<std::size_t, int> totals_;
  int records_ = 0;
};

int run_study(const StudyArguments& arguments) {
  if (arguments.at(0) == "verdicts") return write_verdicts(arguments);
  std::vector<Method> methods{method("algorithm1"), method("robust")};
  for (std::size_t i = 1; i < arguments.places.size(); ++i)
    methods.push_back(method("algorithm1", parse_number(arguments.at(i)).value_or(1e-3)));
  Study study(std::move(methods));
  const std::vector<Making> all = makings();
  Cells<Outcome> cells;
  for (const Making& making : all) study.add_cells(making, cells);
  const auto finished = run_cells(arguments.store(), cells);
  if (!finished) return 0;
  study.write_header();
  for (std::size_t k = 0; k < all.size(); ++k) study.add_rows(all[k], finished->group(k));
  study.add_total();
  write_results(
      arguments.folder_at(0), "solver_noise", study.details.csv(),
      "Records without measurement noise, as solvers write them: in how many of the flows "
      "exactly "
      "the true terms\nof all equations are found among monomials up to degree 3. Adaptive: "
      "Dormand and Prince's 5(4) pair with steps of its\nown, sampled by its interpolant. "
      "Lorenz, "
      "Rossler, memristor, Chua with a cubic, a linear chain of four, Sprott A,\nvan der Pol, "
      "FitzHugh-Nagumo, Duffing with an input, Lotka-Volterra, Brusselator, SIR.\n\nMade by "
      "`study_solver_noise FOLDER 0.0005 0.002` on " +
          finished->origin.day + ", " + finished->origin.machine + ".\n\n" +
          study.summary.markdown());
  std::cout << study.summary.markdown();
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
