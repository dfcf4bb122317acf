// SPDX-License-Identifier: MIT
// Every filter x regressor x pruner x derivative on Rossler data: how often the structure is
// exact, how far coefficients and synchronisation are off, how long it takes. Usage:
// study_rossler [OUTPUT_FOLDER] [DERIVATIVE] [--cells FOLDER]   (default build/studies/rossler)
// DERIVATIVE ("weak", "integral") leaves out all others.
#include <filesystem>
#include <iostream>
#include <map>

#include "cases.hpp"
#include "core/base/text.hpp"
#include "core/files/atomic_file.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/identify/bench/bench.hpp"
#include "report.hpp"
#include "support/parallel.hpp"
#include "support/settings.hpp"

namespace lacuna::benchmarks {
namespace {

/// One fit compared with the truth.
Score score(const Pipeline& pipeline, const Dataset& noisy, const Dataset& clean) {
  const BenchScore found = bench_score(pipeline, noisy, clean, test_system("rossler").model);
  return {*found.exact_structure, *found.coefficient_error, found.sync, found.seconds};
}

/// Records of one condition, one per draw, and the clean record they stem from.
struct Records {
  Dataset clean;
  std::vector<Dataset> exact, sampled;  ///< with and without derivatives
  /// By derivative, one per draw: with what a formulation leaves open chosen for the record
  /// once, as a differentiator that tries others takes longer than all compositions.
  std::map<std::string, std::vector<Stage<Formulation>>> formulations = {};

  const std::vector<Dataset>& draws(const std::string& derivative) const {
    return derivative == "exact" ? exact : sampled;
  }
};

Records make_records(const Condition& condition) {
  Records records{noisy_record({condition.samples, 0.0, 1}, 1), {}, {}};
  for (int draw = 0; draw < condition.draws; ++draw) {
    records.exact.push_back(noisy_record(condition, 1 + static_cast<std::uint64_t>(draw)));
    records.sampled.push_back(without_derivatives(records.exact.back()));
  }
  return records;
}

void choose_formulations(Records& records, const std::vector<Composition>& compositions) {
  for (const Composition& one : compositions) {
    auto& chosen = records.formulations[one.derivative];
    if (!chosen.empty()) continue;
    for (const Dataset& draw : records.draws(one.derivative))
      chosen.push_back(fitted_to(one.pipeline.formulation, draw));
  }
}

std::vector<Score> scores_of(const Composition& composition, const Records& records) {
  std::vector<Score> scores;
  const std::vector<Dataset>& draws = records.draws(composition.derivative);
  for (std::size_t i = 0; i < draws.size(); ++i) {
    Pipeline pipeline = composition.pipeline;
    pipeline.formulation = records.formulations.at(composition.derivative)[i];
    scores.push_back(score(pipeline, draws[i], records.clean));
  }
  return scores;
}

std::string name_of(const Composition& composition, const Condition& condition) {
  const std::vector<std::string> parts{composition.filter,
                                       composition.regressor,
                                       composition.pruner,
                                       composition.derivative,
                                       std::to_string(condition.samples),
                                       format_number(condition.noise)};
  return join(parts, " ");
}

int run(const StudyArguments& arguments) {
  const std::filesystem::path folder = arguments.folder_at(0);
  std::vector<Composition> compositions = all_compositions(default_registry());
  if (const std::string only = arguments.at(1); !only.empty())
    std::erase_if(compositions, [&](const Composition& one) { return one.derivative != only; });
  if (compositions.empty())
    throw ConfigError("study_rossler", "there is no derivative '" + arguments.at(1) + "'",
                      "see the columns of results/rossler.md");
  const std::vector<Condition> conditions = all_conditions();
  const std::size_t count = conditions.size();
  std::vector<Records> records;
  for (const Condition& condition : conditions) records.push_back(make_records(condition));
  for_all(records.size(), [&](std::size_t i) { choose_formulations(records[i], compositions); });
  Cells<std::vector<Score>> work;
  for (const Composition& composition : compositions)
    for (std::size_t i = 0; i < count; ++i)
      work.add(name_of(composition, conditions[i]),
               [&, i] { return scores_of(composition, records[i]); });
  const auto finished = run_cells(arguments.store(), work);
  if (!finished) return 0;
  std::vector<Cell> cells;
  for (std::size_t i = 0; i < finished->values.size(); ++i)
    cells.push_back({&compositions[i / count], conditions[i % count], finished->values[i]});
  std::filesystem::create_directories(folder);
  write_report(folder, cells, finished->origin);
  std::cout << compositions.size() << " compositions, " << cells.size() << " cells in "
            << format_number(finished->origin.seconds, 3) << " s; tables and picture in "
            << folder << '\n';
  return 0;
}

}  // namespace
}  // namespace lacuna::benchmarks

int main(int argc, char** argv) {
  return lacuna::benchmarks::study_main(
      {"rossler", "[OUTPUT_FOLDER] [DERIVATIVE]", lacuna::benchmarks::run}, argc, argv);
}
