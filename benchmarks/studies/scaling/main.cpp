// SPDX-License-Identifier: MIT
// What identification costs against states, rows and candidate terms: time, memory, exponents.
// Usage: study_scaling [OUTPUT_FOLDER] [MOST_STATES] [MOST_ROWS]
//               (default build/studies/scaling 20 1000000)
//        study_scaling speed [OUTPUT_FOLDER]
//               a million rows with derivatives for benchmarks/peers/pysindy_speed.py, and
//               lacuna's times on them
//        study_scaling pieces [OUTPUT_FOLDER] [ROWS]
//               a file that is read in pieces (default 100000000 rows, 5.6 GB)
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <vector>

#include "core/base/text.hpp"
#include "core/files/atomic_file.hpp"
#include "lacuna/bases/bases.hpp"
#include "lacuna/data/long_records.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/identify/pipeline/presets.hpp"
#include "lacuna/model/equations/ode_model.hpp"
#include "report/plot/figure.hpp"
#include "studies/scaling/pieces.hpp"
#include "studies/scaling/records.hpp"
#include "support/lorenz96.hpp"
#include "support/meter.hpp"
#include "support/table.hpp"

namespace lacuna::benchmarks {
namespace {

namespace fs = std::filesystem;

/// One identification.
struct Task {
  RecordProblem problem;
  std::string preset = "algorithm1";
  int degree = 3;
  int threads = 1;
};

/// What it took.
struct Outcome {
  Task task;
  double size = 0.0;  ///< what the family varies: states, rows or terms
  Reading reading;
  bool exact = false;
};

/// Records of more samples than this are read in pieces from a file.
constexpr Index kInMemory = 1000000;

Pipeline pipeline_of(const Task& task) {
  Pipeline pipeline = preset(task.preset);
  pipeline.basis = monomials({.max_degree = task.degree});
  return pipeline;
}

Outcome run(const Task& task, double size, const fs::path& folder) {
  const Pipeline pipeline = pipeline_of(task);
  RunContext context;
  context.threads = task.threads;
  const bool in_memory = task.problem.rows <= kInMemory;
  const fs::path file = folder / "long.npy";
  Dataset data;
  if (in_memory)
    data = record_of(task.problem);
  else
    write_record(task.problem, file);
  const Meter meter;
  const IdentificationResult result =
      in_memory ? identify(data, pipeline, context)
                : identify(read_stream({file.string()}, file_roles(task.problem), context),
                           pipeline, context);
  const Reading reading = meter.read();
  fs::remove(file);
  std::cout << task.problem.name << ", " << size << ": " << reading.wall << " s" << std::endl;
  return {task, size, reading,
          compare_models(result.model, task.problem.model).exact_structure};
}

/// The same on one thread and on two.
void run_threads(Task task, double size, const fs::path& folder, std::vector<Outcome>& all) {
  for (const int threads : {1, 2}) {
    task.threads = threads;
    all.push_back(run(task, size, folder));
  }
}

std::vector<Outcome> against_states(Index most, const fs::path& folder) {
  std::vector<Outcome> all;
  for (const Index m : {5, 10, 20, 40, 64})
    for (const double noise : {0.001, 0.01})
      if (m <= most)
        run_threads({{"lorenz-96", lorenz96(m), 0.01, 20000, noise}, "algorithm1", 2},
                    static_cast<double>(m), folder, all);
  return all;
}

std::vector<Outcome> against_rows(Index most, const fs::path& folder) {
  std::vector<Outcome> all;
  for (Index rows = 1000; rows <= most; rows *= 10)
    for (const double noise : {0.0, 0.01})
      run_threads({{"lorenz", test_system("lorenz").model, 0.001, rows, noise}},
                  static_cast<double>(rows), folder, all);
  return all;
}

/// Terms of three states: 10, 20, 56, 165, 455 and 1771.
std::vector<Outcome> against_terms(const fs::path& folder) {
  std::vector<Outcome> all;
  for (const int degree : {2, 3, 5, 8, 12, 20}) {
    const double terms = (degree + 1) * (degree + 2) * (degree + 3) / 6.0;
    run_threads({{"lorenz", test_system("lorenz").model, 0.01, 20000, 0.0}, "sindy", degree},
                terms, folder, all);
  }
  return all;
}

/// Slope of log(time) against log(size) on one thread, by least squares over the largest sizes.
double exponent(const std::vector<Outcome>& outcomes, double noise) {
  constexpr std::size_t kLargest = 3;
  std::vector<std::pair<double, double>> points;
  for (const Outcome& outcome : outcomes)
    if (outcome.task.threads == 1 && outcome.task.problem.noise == noise)
      points.emplace_back(std::log(outcome.size), std::log(outcome.reading.wall));
  if (points.size() > kLargest) points.erase(points.begin(), points.end() - kLargest);
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (const auto& [size, time] : points) {
    x += size;
    y += time;
    xx += size * size;
    xy += size * time;
  }
  const auto n = static_cast<double>(points.size());
  return (n * xy - x * y) / (n * xx - x * x);
}

void add_rows(const std::string& family, const std::vector<Outcome>& outcomes,
              ResultTable& table) {
  for (const Outcome& o : outcomes)
    table.rows.push_back({family, format_number(o.size, 9), o.task.problem.name, o.task.preset,
                          std::to_string(o.task.problem.rows), std::to_string(o.task.degree),
                          format_number(100.0 * o.task.problem.noise),
                          std::to_string(o.task.threads), format_number(o.reading.wall, 3),
                          format_number(o.reading.cpu, 3),
                          format_number(o.reading.megabytes, 3), o.exact ? "yes" : "no"});
}

/// Times of a family at one noise, one thread.
Series curve(const std::string& label, const std::vector<Outcome>& outcomes, double noise) {
  std::vector<double> x, y;
  for (const Outcome& o : outcomes) {
    if (o.task.threads != 1 || o.task.problem.noise != noise) continue;
    x.push_back(o.size);
    y.push_back(o.reading.wall);
  }
  const auto n = static_cast<Index>(x.size());
  return {label, Eigen::Map<const Vector>(x.data(), n), Eigen::Map<const Vector>(y.data(), n)};
}

int run_study(const fs::path& folder, Index most_states, Index most_rows) {
  fs::create_directories(folder);
  const std::vector<Outcome> states = against_states(most_states, folder);
  const std::vector<Outcome> rows = against_rows(most_rows, folder);
  const std::vector<Outcome> terms = against_terms(folder);
  ResultTable table;
  table.header = {"against", "size",    "system", "preset", "rows", "degree",
                  "noise %", "threads", "wall s", "CPU s",  "MB",   "exact"};
  add_rows("states", states, table);
  add_rows("rows", rows, table);
  add_rows("terms", terms, table);
  write_file_atomically(folder / "scaling.csv", table.csv());
  LineFigure figure;
  figure.name = "scaling";
  figure.title = "Time of an identification, one thread";
  figure.x_label = "states, rows, terms";
  figure.y_label = "time / s";
  figure.logarithmic_x = figure.logarithmic_y = true;
  figure.series = {curve("states (1 % noise)", states, 0.01), curve("rows (1 %)", rows, 0.01),
                   curve("terms (no noise)", terms, 0.0)};
  figure.series[1].curve = Curve::Model;
  figure.series[2].curve = Curve::Before;
  write_file_atomically(folder / "scaling.svg", stand_alone(draw(figure)));
  write_file_atomically(
      folder / "scaling.md",
      "# Scaling\n\nIdentification inside the process; more than " +
          format_number(double(kInMemory), 7) +
          " rows are read in pieces from a file, which is counted, and written before, which "
          "is "
          "not.\nMB: what the run takes beside the record. Time grows with the power " +
          format_number(exponent(states, 0.01), 2) + " of the states and " +
          format_number(exponent(rows, 0.01), 2) +
          " of the rows (1 % noise), and with the power " +
          format_number(exponent(terms, 0.0), 2) +
          " of the terms (preset `sindy`),\neach over the three largest sizes.\n\nMade by "
          "`study_scaling FOLDER " +
          std::to_string(most_states) + " " + std::to_string(most_rows) + "` on " + today() +
          ", " + machine_description() + ".\n\n![times](scaling.svg)\n\n" + table.markdown());
  return 0;
}

/// Median time and memory of five fits.
struct Speed {
  double seconds = 0.0;
  double megabytes = 0.0;
  bool exact = true;
};

Speed speed_of(const Task& task, const Dataset& data) {
  constexpr int kRepeats = 5;
  RunContext context;
  context.threads = task.threads;
  Speed speed;
  std::vector<double> times;
  for (int repeat = 0; repeat < kRepeats; ++repeat) {
    const Meter meter;
    const auto result = identify(data, pipeline_of(task), context);
    const Reading reading = meter.read();
    times.push_back(reading.wall);
    speed.megabytes = reading.megabytes;
    speed.exact =
        speed.exact && compare_models(result.model, task.problem.model).exact_structure;
  }
  std::sort(times.begin(), times.end());
  speed.seconds = times[kRepeats / 2];
  return speed;
}

/// Fits with derivatives given, on one thread and on two.
int run_speed(const fs::path& folder) {
  fs::create_directories(folder);
  const RecordProblem problem{"lorenz", test_system("lorenz").model, 0.001, 1000000, 0.0, true};
  write_record(problem, folder / "lorenz.npy");
  const Dataset data = record_of(problem);
  ResultTable table;
  table.header = {"degree", "threads", "seconds", "MB", "exact"};
  for (const int degree : {3, 5})
    for (const int threads : {1, 2}) {
      const Speed speed = speed_of({problem, "sindy", degree, threads}, data);
      table.rows.push_back({std::to_string(degree), std::to_string(threads),
                            format_number(speed.seconds, 4), format_number(speed.megabytes, 3),
                            speed.exact ? "yes" : "no"});
    }
  write_file_atomically(folder / "speed.csv", table.csv());
  std::cout << table.csv();
  return 0;
}

int run_arguments(const std::vector<std::string>& arguments) {
  const auto text = [&](std::size_t place, const std::string& otherwise) {
    return place < arguments.size() ? arguments[place] : otherwise;
  };
  const auto number = [&](std::size_t place, double otherwise) {
    return static_cast<Index>(parse_number(text(place, "")).value_or(otherwise));
  };
  if (text(0, "") == "speed") return run_speed(text(1, "build/studies/scaling"));
  if (text(0, "") == "pieces")
    return run_pieces(text(1, "build/studies/scaling"), number(2, 1e8));
  return run_study(text(0, "build/studies/scaling"), number(1, 20), number(2, 1e6));
}

}  // namespace
}  // namespace lacuna::benchmarks

int main(int argc, char** argv) {
  try {
    return lacuna::benchmarks::run_arguments({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::cerr << "study_scaling: " << error.what() << '\n';
    return 2;
  }
}
