// SPDX-License-Identifier: MIT
// How often the diagnosis is right about systems whose truth is known. Usage:
//   study_hidden cases|power|alarm|reality|ordinary|smoothed|twins|benches|nulls|sensors|
//   practice|decisions|export [FOLDER] [PART_OF_A_NAME] [NOISE_LEVEL] [--cells FOLDER]
// cases: every hidden case at four noise levels; power: one case per family at three sizes of
// the effect; alarm: 500 records in which nothing is missing; reality: effects and complete
// systems in records as benches make them; ordinary: 500 of these in which nothing is missing;
// smoothed: effects and complete systems in records that somebody smoothed; twins: devices as
// benches have them, and as many that lack nothing; benches: where a wrong name is likely;
// nulls: devices that lack nothing on benches with faults; sensors: devices behind sensors that
// show the states of other times; practice: the cases in the folder `practice` of LACUNA_DATA;
// decisions: the cases at 1 % noise (for thresholds of smoothing, the smoothed ones too) with
// each threshold at half and at double its value.
#include <cstdlib>
#include <filesystem>
#include <iostream>

#include "cli/configuration/diagnosis_configuration.hpp"
#include "core/files/atomic_file.hpp"
#include "decisions.hpp"
#include "hidden/support/cases.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/formats/write.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "practice.hpp"
#include "report.hpp"
#include "support/settings.hpp"
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
  if (name == "twins") return twin_trials(20);
  return {};
}

/// The trials that are asked for. @param cells gets one for each of them.
std::vector<Trial> trials_of(const StudyArguments& given, Cells<Outcome>& cells) {
  const DiagnosisOptions options = diagnosis_options({}, default_registry());
  const std::string part = given.at(2), level = given.at(3);
  const char* data = std::getenv("LACUNA_DATA");
  if (given.at(0) == "practice" && data != nullptr)
    return practice_trials(std::filesystem::path(data) / "practice", part, options, cells);
  if (given.at(0) == "benches") return bench_trials(6, part, options, cells);
  if (given.at(0) == "nulls") return null_trials(8, part, options, cells);
  if (given.at(0) == "sensors") return sensor_trials(part, options, cells);
  std::vector<Trial> trials = chosen_trials(given.at(0));
  std::erase_if(trials, [&](const Trial& trial) {
    return trial.hidden.name.find(part) == std::string::npos ||
           (!level.empty() && trial.level != std::stod(level));
  });
  for (const Trial& trial : trials)
    add_reported(cells, trial, [=] { return run_trial(trial, options); });
  return trials;
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

int run(const StudyArguments& given) {
  const std::string name = given.at(0);
  const std::filesystem::path folder = given.folder_at(1);
  if (name == "export") return export_cases(folder, given.at(2), given.at(3));
  if (name == "decisions") return run_decisions(folder, given.at(2), given.store(name));
  Cells<Outcome> cells;
  const std::vector<Trial> trials = trials_of(given, cells);
  if (trials.empty())
    throw ConfigError("study_hidden", "there are no such trials",
                      "give cases, power, alarm, reality, ordinary, smoothed, twins, benches, "
                      "nulls, sensors or (with LACUNA_DATA set) practice");
  const auto finished = run_cells(given.store(name), cells);
  if (!finished) return 0;
  write_tables(folder, name, trials, *finished);
  std::cout << trials.size() << " trials in " << finished->origin.seconds << " s; tables in "
            << folder << '\n';
  return 0;
}

}  // namespace
}  // namespace lacuna::benchmarks

int main(int argc, char** argv) {
  return lacuna::benchmarks::study_main(
      {"hidden",
       "cases|power|alarm|reality|ordinary|smoothed|twins|benches|nulls|sensors|practice|"
       "decisions|export "
       "[FOLDER] [PART_OF_A_NAME] [NOISE_LEVEL]",
       lacuna::benchmarks::run, 1},
      argc, argv);
}
