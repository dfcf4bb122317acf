// SPDX-License-Identifier: MIT
// How often the diagnosis is right about systems whose truth is known. Usage:
//   study_hidden cases|power|alarm [OUTPUT_FOLDER] [PART_OF_A_NAME] [NOISE_LEVEL]
// cases: every hidden case at four noise levels; power: one case per family at three sizes of
// the effect; alarm: 500 records in which nothing is missing.
#include <chrono>
#include <filesystem>
#include <iostream>

#include "report.hpp"
#include "trials.hpp"

namespace lacuna::benchmarks {
namespace {

std::vector<Trial> chosen_trials(const std::string& name) {
  if (name == "cases") return case_trials();
  if (name == "power") return power_trials();
  if (name == "alarm") return alarm_trials(500);
  return {};
}

int run(const std::string& name, const std::filesystem::path& folder, const std::string& part,
        const std::string& level) {
  std::vector<Trial> trials = chosen_trials(name);
  std::erase_if(trials, [&](const Trial& trial) {
    return trial.hidden.name.find(part) == std::string::npos ||
           (!level.empty() && trial.level != std::stod(level));
  });
  if (trials.empty()) {
    std::cerr << "there are no such trials; give cases, power or alarm\n";
    return 2;
  }
  const auto start = std::chrono::steady_clock::now();
  const std::vector<Outcome> outcomes = run_trials(trials, default_registry());
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  std::filesystem::create_directories(folder);
  write_tables(folder, name, trials, outcomes, time.count());
  std::cout << trials.size() << " trials in " << time.count() << " s; tables in " << folder
            << '\n';
  return 0;
}

}  // namespace
}  // namespace lacuna::benchmarks

int main(int argc, char** argv) {
  return lacuna::benchmarks::run(argc > 1 ? argv[1] : "",
                                 argc > 2 ? argv[2] : "build/studies/hidden",
                                 argc > 3 ? argv[3] : "", argc > 4 ? argv[4] : "");
}
