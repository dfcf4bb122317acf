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
// each threshold at half and at double its value; export: the records of these, as files.
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

/// Those of systems with such a name, at a level of noise where one is given.
std::vector<Trial> with_part(std::vector<Trial> trials, const std::string& part,
                             const std::string& level) {
  std::erase_if(trials, [&](const Trial& trial) {
    return trial.hidden.name.find(part) == std::string::npos ||
           (!level.empty() && trial.level != std::stod(level));
  });
  return trials;
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
  const std::vector<Trial> trials = with_part(chosen_trials(given.at(0)), part, level);
  for (const Trial& trial : trials)
    add_reported(cells, trial, [=] { return run_trial(trial, options); });
  return trials;
}

/// Writes the records of trials with such a name as files, one folder each, by sets of trials.
int export_trials(const std::filesystem::path& folder, const std::string& part,
                  const std::string& level) {
  for (const char* set : {"cases", "reality", "ordinary", "smoothed", "twins"})
    for (const Trial& trial : with_part(chosen_trials(set), part, level)) {
      const hidden::Records records = make_records(trial.hidden, trial.level, trial.seed);
      const std::filesystem::path place = folder / set / name_of(trial);
      std::filesystem::create_directories(place);
      write_file_atomically(place / "model.json", format_model(trial.hidden.nominal));
      write_csv(place / "find.csv", records.find);
      write_csv(place / "check.csv", records.check);
    }
  return 0;
}

int run(const StudyArguments& given) {
  const std::string name = given.at(0);
  const std::filesystem::path folder = given.folder_at(1);
  if (name == "export") return export_trials(folder, given.at(2), given.at(3));
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
