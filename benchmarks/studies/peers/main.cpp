// SPDX-License-Identifier: MIT
// Writes noisy records of known systems for other programs to identify, and what lacuna makes
// of them. benchmarks/peers/pysindy_fits.py adds PySINDy and the table. Usage: study_peers
// [OUTPUT_FOLDER]      (default build/studies/peers)
#include <algorithm>
#include <array>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <vector>

#include "core/base/text.hpp"
#include "core/files/atomic_file.hpp"
#include "lacuna/bases/bases.hpp"
#include "lacuna/data/formats/write.hpp"
#include "lacuna/dynamics/integration/integrators.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/identify/pipeline/presets.hpp"
#include "lacuna/model/equations/ode_model.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/trajectories/refiners.hpp"
#include "support/table.hpp"

namespace lacuna::benchmarks {
namespace {

constexpr int kDraws = 5;
constexpr int kRepeats = 3;
constexpr int kDegree = 3;

struct Case {
  const char* system;
  double step;
  Index samples;
};
const std::vector<Case> kCases = {{"lorenz", 0.01, 1000},
                                  {"rossler", 0.05, 2000},
                                  {"fitzhugh-nagumo", 0.5, 1000},
                                  {"van-der-pol", 0.05, 1000}};
const std::vector<double> kNoise = {0.0, 0.001, 0.01, 0.05, 0.1};

struct Method {
  std::string name;
  Pipeline pipeline;
};

/// Every preset, and what the default one has before it goes to the trajectories.
std::vector<Method> methods() {
  std::vector<Method> all;
  for (const Preset& entry : presets()) all.push_back({entry.name, preset(entry.name)});
  all.push_back({"algorithm1 without refinement", algorithm1()});
  all.back().pipeline.refiner = no_refiner();
  for (Method& method : all) method.pipeline.basis = monomials({.max_degree = kDegree});
  return all;
}

/// Seconds of processor time, the median of repeated fits: the clock of the wall counts others.
double seconds_of_fit(const Dataset& record, const Pipeline& pipeline) {
  std::array<double, kRepeats> seconds;
  for (double& once : seconds) {
    const std::clock_t start = std::clock();
    identify(record, pipeline);
    once = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  }
  std::nth_element(seconds.begin(), seconds.begin() + kRepeats / 2, seconds.end());
  return seconds[kRepeats / 2];
}

/// Appends what a method makes of a record to the table.
void fit(const Method& method, const Dataset& record, const OdeModel& truth,
         std::vector<std::string> row, ResultTable& table) {
  const ModelAccuracy accuracy = compare_models(identify(record, method.pipeline).model, truth);
  row.insert(row.end(), {"lacuna " + method.name, accuracy.exact_structure ? "1" : "0",
                         format_number(accuracy.relative_error, 4),
                         format_number(seconds_of_fit(record, method.pipeline), 3)});
  table.rows.push_back(std::move(row));
}

void run_case(const Case& which, const std::filesystem::path& folder, ResultTable& table) {
  const TestSystem& system = test_system(which.system);
  write_model(folder / (system.name + ".json"), system.model);
  const Dataset clean =
      record_of(system.model, dopri87(), system.start, which.step, which.samples);
  for (const double noise : kNoise) {
    const int draws = noise == 0.0 ? 1 : kDraws;
    for (int draw = 1; draw <= draws; ++draw) {
      const Dataset record = add_relative_noise(clean, noise, static_cast<std::uint64_t>(draw));
      const std::string file = system.name + "_" + format_number(100.0 * noise, 3) + "_" +
                               std::to_string(draw) + ".csv";
      write_csv(folder / file, record);
      for (const Method& method : methods())
        fit(method, record, system.model,
            {system.name, format_number(100.0 * noise, 3), std::to_string(draw), file}, table);
    }
  }
}

int run(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  ResultTable table{{"system", "noise %", "draw", "file", "method", "exact structure",
                     "coefficient error", "seconds"},
                    {}};
  for (const Case& which : kCases) run_case(which, folder, table);
  write_file_atomically(folder / "lacuna.csv", table.csv());
  std::cout << table.rows.size() << " fits; records and lacuna.csv in " << folder << '\n';
  return 0;
}

}  // namespace
}  // namespace lacuna::benchmarks

int main(int argc, char** argv) {
  try {
    return lacuna::benchmarks::run(argc > 1 ? argv[1] : "build/studies/peers");
  } catch (const std::exception& error) {
    std::cerr << "study_peers: " << error.what() << '\n';
    return 2;
  }
}
