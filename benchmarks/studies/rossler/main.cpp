// SPDX-License-Identifier: MIT
// Every filter x regressor x pruner x derivative on Rossler data: how often the structure is
// exact, how far coefficients and synchronisation are off, how long it takes. Usage:
// study_rossler [OUTPUT_FOLDER]      (default build/studies/rossler)
#include <chrono>
#include <filesystem>
#include <iostream>

#include "cases.hpp"
#include "lacuna/core/atomic_file.hpp"
#include "lacuna/core/text.hpp"
#include "lacuna/dynamics/runge_kutta.hpp"
#include "lacuna/dynamics/synchroniser.hpp"
#include "lacuna/systems/test_systems.hpp"
#include "report.hpp"
#include "support/accuracy.hpp"
#include "support/parallel.hpp"

namespace lacuna::benchmarks {
namespace {

/// One fit held against the truth.
Score score(const Composition& composition, const Dataset& noisy, const Dataset& clean) {
  const auto start = std::chrono::steady_clock::now();
  const IdentificationResult result = identify(noisy, composition.pipeline);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;

  Score score;
  score.seconds = time.count();
  const ModelAccuracy accuracy = compare_models(result.model, test_system("rossler").model);
  score.exact_structure = accuracy.exact_structure;
  score.coefficient_error = accuracy.largest_error;
  const SyncResult sync = synchronise(result.model, clean, Rk4{});
  if (sync.status == IntegrationStatus::Completed) score.sync = sync.relative;
  return score;
}

/// Records of one condition, one per draw, and the clean record they stem from.
struct Records {
  Dataset clean;
  std::vector<Dataset> exact, sampled;  ///< with and without derivatives
};

Records make_records(const Condition& condition) {
  Records records{noisy_record({condition.samples, 0.0, 1}, 1), {}, {}};
  for (int draw = 0; draw < condition.draws; ++draw) {
    records.exact.push_back(noisy_record(condition, 1 + static_cast<std::uint64_t>(draw)));
    records.sampled.push_back(without_derivatives(records.exact.back()));
  }
  return records;
}

Cell run_cell(const Composition& composition, const Condition& condition,
              const Records& records) {
  Cell cell{&composition, condition, {}};
  const auto& draws = composition.derivative == "exact" ? records.exact : records.sampled;
  for (const Dataset& draw : draws)
    cell.scores.push_back(score(composition, draw, records.clean));
  return cell;
}

/// All cells, spread over the processor's cores; the order of the result is fixed.
std::vector<Cell> run_all(const std::vector<Composition>& compositions) {
  const std::vector<Condition> conditions = all_conditions();
  std::vector<Records> records;
  for (const Condition& condition : conditions) records.push_back(make_records(condition));

  std::vector<Cell> cells(compositions.size() * conditions.size());
  for_all(cells.size(), [&](std::size_t i) {
    const std::size_t condition = i % conditions.size();
    cells[i] = run_cell(compositions[i / conditions.size()], conditions[condition],
                        records[condition]);
  });
  return cells;
}

int run(const std::filesystem::path& folder) {
  const Registry registry = default_registry();
  const auto start = std::chrono::steady_clock::now();
  const std::vector<Composition> compositions = all_compositions(registry);
  const std::vector<Cell> cells = run_all(compositions);
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;

  std::filesystem::create_directories(folder);
  write_report(folder, cells, time.count());
  std::cout << compositions.size() << " compositions, " << cells.size() << " cells in "
            << format_number(time.count(), 3) << " s; tables and picture in " << folder << '\n';
  return 0;
}

}  // namespace
}  // namespace lacuna::benchmarks

int main(int argc, char** argv) {
  try {
    return lacuna::benchmarks::run(argc > 1 ? argv[1] : "build/studies/rossler");
  } catch (const std::exception& error) {
    std::cerr << "study_rossler: " << error.what() << '\n';
    return 2;
  }
}
