// SPDX-License-Identifier: MIT
// How often the diagnosis is right about systems whose truth is known. Usage:
//   study_hidden cases|power|alarm|reality|ordinary|smoothed|practice|decisions|export [FOLDER]
//   [PART_OF_A_NAME] [NOISE_LEVEL]
// cases: every hidden case at four noise levels; power: one case per family at three sizes of
// the effect; alarm: 500 records in which nothing is missing; reality: effects and complete
// systems in records as benches make them; ordinary: 500 of these in which nothing is missing;
// smoothed: effects and complete systems in records that somebody smoothed; practice: the cases
// in the folder `practice` of LACUNA_DATA; decisions: the cases at 1 % noise (for thresholds of
// smoothing, the smoothed ones too) with each threshold at half and at double its value (it
// goes on where its table in FOLDER ends).
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "decisions.hpp"
#include "hidden/support/cases.hpp"
#include "lacuna/config/diagnosis_configuration.hpp"
#include "lacuna/core/atomic_file.hpp"
#include "lacuna/data/write.hpp"
#include "lacuna/model/model_file.hpp"
#include "practice.hpp"
#include "report.hpp"
#include "trials.hpp"

namespace lacuna::benchmarks {
namespace {

std::vector<Trial> chosen_trials(const std::string& name) {
  if (name == "cases") return case_trials();
  if (name == "power") return power_trials();
  if (name == "alarm") return alarm_trials(500);
  if (name == "reality") return reality_trials();
  if (name == "ordinary") return ordinary_trials(500);
  if (name == "smoothed") return smoothed_trials();
  return {};
}

struct Arguments {
  std::string name;
  std::filesystem::path folder;
  std::string part, level;
};

using Results = std::pair<std::vector<Trial>, std::vector<Outcome>>;

Results results_of(const Arguments& given) {
  const DiagnosisOptions options = diagnosis_options({}, default_registry());
  if (given.name == "practice") {
    const char* data = std::getenv("LACUNA_DATA");
    if (data == nullptr) return {};
    return run_practice(std::filesystem::path(data) / "practice", given.part, options);
  }
  std::vector<Trial> trials = chosen_trials(given.name);
  std::erase_if(trials, [&](const Trial& trial) {
    return trial.hidden.name.find(given.part) == std::string::npos ||
           (!given.level.empty() && trial.level != std::stod(given.level));
  });
  std::vector<Outcome> outcomes = run_trials(trials, options);
  return {std::move(trials), std::move(outcomes)};
}

/// Writes the cases at a noise level (1 % where none is given) as files, one folder each.
int export_cases(const std::filesystem::path& folder, const std::string& part,
                 const std::string& level) {
  const double noise = level.empty() ? 0.01 : std::stod(level);
  for (const hidden::HiddenCase& hidden : hidden::all_cases()) {
    if (hidden.name.find(part) == std::string::npos) continue;
    const hidden::Records records = hidden::make_records(hidden, noise, 1);
    const std::filesystem::path place = folder / hidden.name;
    std::filesystem::create_directories(place);
    write_file_atomically(place / "model.json", format_model(hidden.nominal));
    write_csv(place / "find.csv", records.find);
    write_csv(place / "check.csv", records.check);
  }
  return 0;
}

int run(const Arguments& given) {
  if (given.name == "decisions") return run_decisions(given.folder, given.part);
  if (given.name == "export") return export_cases(given.folder, given.part, given.level);
  const auto start = std::chrono::steady_clock::now();
  const auto [trials, outcomes] = results_of(given);
  if (trials.empty()) {
    std::cerr << "there are no such trials; give cases, power, alarm, reality, ordinary, "
                 "smoothed or (with LACUNA_DATA set) practice\n";
    return 2;
  }
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  std::filesystem::create_directories(given.folder);
  write_tables(given.folder, given.name, trials, outcomes, time.count());
  std::cout << trials.size() << " trials in " << time.count() << " s; tables in "
            << given.folder << '\n';
  return 0;
}

}  // namespace
}  // namespace lacuna::benchmarks

int main(int argc, char** argv) {
  return lacuna::benchmarks::run({argc > 1 ? argv[1] : "",
                                  argc > 2 ? argv[2] : "build/studies/hidden",
                                  argc > 3 ? argv[3] : "", argc > 4 ? argv[4] : ""});
}
