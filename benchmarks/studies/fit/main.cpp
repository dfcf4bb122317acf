// SPDX-License-Identifier: MIT
// Models of known structure fitted to simulated records: how often the true numbers are found
// from starts off by a factor of 3, and how often the 95 % intervals contain them. Usage:
// study_fit [OUTPUT_FOLDER] [DRAWS] [RECORDS_FOLDER] [--cells FOLDER]
//                                                      (default build/studies/fit, 25, none)
#include <cmath>
#include <filesystem>
#include <iostream>

#include "core/base/random.hpp"
#include "core/base/text.hpp"
#include "core/files/atomic_file.hpp"
#include "lacuna/data/formats/write.hpp"
#include "lacuna/trajectories/fit/fit.hpp"
#include "problems.hpp"
#include "support/grey_box.hpp"
#include "support/parallel.hpp"
#include "support/settings.hpp"
#include "support/table.hpp"

namespace lacuna::benchmarks {
namespace {

constexpr double kNoise = 0.01;
constexpr double kOff = 3.0;

/// What one draw of noise and starts gave.
struct Draw {
  bool found = false;  ///< the minimum of the fit that starts from the truth
  int numbers = 0, with_interval = 0, inside = 0;
  double seconds = 0.0;

  auto fields() { return std::tie(found, numbers, with_interval, inside, seconds); }
};

SystemModel off_by(const SystemModel& system, Random& random) {
  std::vector<Parameter> parameters = system.parameters();
  for (Parameter& parameter : parameters)
    if (parameter.free) {
      parameter.value *= random.uniform() < 0.5 ? kOff : 1.0 / kOff;
      if (parameter.max) parameter.value = std::min(parameter.value, *parameter.max);
      if (parameter.min) parameter.value = std::max(parameter.value, *parameter.min);
    }
  return {system.symbolic(), std::move(parameters)};
}

Dataset record_of(const GreyBox& box, const OdeModel& truth, std::uint64_t draw) {
  return support::grey_box(truth, {.start = Eigen::Map<const Vector>(
                                       box.start.data(), static_cast<Index>(box.start.size())),
                                   .step = box.step,
                                   .samples = box.samples,
                                   .noise = kNoise,
                                   .seed = draw,
                                   .exact = box.exact});
}

/// @param number 1 and up.
Draw draw_of(const GreyBox& box, std::uint64_t number) {
  const SystemModel truth = parse_ode_system(box.text, box.name);
  const Dataset data = record_of(box, truth.model(), number);
  Random random(999 + number);
  const double begin = thread_seconds();
  const Fit found = fit(off_by(truth, random), data, {});
  Draw draw;
  draw.seconds = thread_seconds() - begin;
  const Fit best = fit(truth, data, {});
  draw.found = found.quality[0].rmse < 1.001 * best.quality[0].rmse;
  for (std::size_t i = 0; i < found.numbers.size(); ++i) {
    ++draw.numbers;
    const double value = best.numbers[i].start;
    const auto& interval = found.numbers[i].ci95;
    if (!interval) continue;
    ++draw.with_interval;
    draw.inside += value >= (*interval)[0] && value <= (*interval)[1] ? 1 : 0;
  }
  return draw;
}

ResultTable table_of(const std::vector<GreyBox>& boxes, const Finished<Draw>& finished) {
  ResultTable table{
      {"problem", "hidden", "draws", "found %", "intervals", "coverage %", "seconds"}, {}};
  double draws = 0, found = 0, intervals = 0, inside = 0;
  const auto percent = [](double part, double whole) {
    return format_number(100.0 * part / std::max(1.0, whole), 4);
  };
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    double own_found = 0, own_intervals = 0, own_inside = 0, seconds = 0;
    for (const Draw& draw : finished.group(k)) {
      own_found += draw.found ? 1 : 0;
      own_intervals += draw.found ? draw.with_interval : 0;
      own_inside += draw.found ? draw.inside : 0;
      seconds += draw.seconds;
    }
    const auto count = static_cast<double>(finished.group(k).size());
    table.rows.push_back({boxes[k].name, boxes[k].hidden ? "yes" : "no", format_number(count),
                          percent(own_found, count), format_number(own_intervals),
                          percent(own_inside, own_intervals),
                          format_number(seconds / count, 2)});
    draws += count;
    found += own_found;
    intervals += own_intervals;
    inside += own_inside;
  }
  table.rows.push_back({"all", "", format_number(draws), percent(found, draws),
                        format_number(intervals), percent(inside, intervals), ""});
  return table;
}

/// The record of the first draw of each problem, for another program.
void write_records(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder);
  std::string starts;
  for (const GreyBox& box : grey_boxes()) {
    const OdeModel truth = parse_ode(box.text, box.name);
    std::vector<std::string> numbers;
    for (const double value : box.start) numbers.push_back(format_number(value));
    starts += (starts.empty() ? "{" : ",\n") + ("\"" + box.name + "\": [") +
              join(numbers, ", ") + "]";
    write_file_atomically(folder / (box.name + ".ode"), box.text);
    write_csv(folder / (box.name + ".csv"),
              support::grey_box_columns(
                  truth, {.start = Eigen::Map<const Vector>(
                              box.start.data(), static_cast<Index>(box.start.size())),
                          .step = box.step,
                          .samples = box.samples,
                          .noise = kNoise,
                          .seed = 1}));
  }
  write_file_atomically(folder / "starts.json", starts + "}\n");
}

int run(const StudyArguments& arguments) {
  const std::size_t draws = arguments.count_at(1, 25);
  if (arguments.places.size() > 2) write_records(arguments.at(2));
  const std::vector<GreyBox> boxes = grey_boxes();
  Cells<Draw> cells;
  for (const GreyBox& box : boxes)
    cells.add_draws(box.name, draws, [&](std::size_t number) { return draw_of(box, number); });
  const auto finished = run_cells(arguments.store(), cells);
  if (!finished) return 0;
  const ResultTable table = table_of(boxes, *finished);
  write_results(
      arguments.folder_at(0), "fit", table.csv(),
      "# Models of known structure fitted to records\n\nEvery number starts off by a factor of "
      "3, up or down at random; white noise of 1 % of each output's standard\ndeviation. "
      "found: "
      "the minimum of the fit that starts from the truth (rmse within 0.1 %). coverage: 95 % "
      "intervals\nthat contain the truth, of the draws that were found.\n\n" +
          table.markdown() + "\n" + finished->origin.machine + ", " + finished->origin.day +
          ".\n");
  std::cout << table.markdown();
  return 0;
}

}  // namespace
}  // namespace lacuna::benchmarks

int main(int argc, char** argv) {
  return lacuna::benchmarks::study_main(
      {"fit", "[OUTPUT_FOLDER] [DRAWS] [RECORDS_FOLDER]", lacuna::benchmarks::run}, argc, argv);
}
