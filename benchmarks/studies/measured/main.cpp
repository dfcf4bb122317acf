// SPDX-License-Identifier: MIT
// Measured records end to end: the positioning system EMPS, the Silverbox oscillator and the
// coupled electric drives, read from the folder LACUNA_DATA. Usage: study_measured [OUTPUT_FOLDER]
// [--cells FOLDER]
#include <chrono>
#include <cmath>
#include <filesystem>

#include "core/base/text.hpp"
#include "diagnosed.hpp"
#include "drives.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/derivatives/differentiators.hpp"
#include "lacuna/data/formats/read.hpp"
#include "lacuna/identify/pipeline/presets.hpp"
#include "lacuna/records/binding/embedding.hpp"
#include "support/settings.hpp"
#include "support/table.hpp"
#include "trajectories/shooting/refine.hpp"

namespace lacuna::benchmarks {
namespace {

std::string seconds_since(std::chrono::steady_clock::time_point start) {
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  return format_number(time.count(), 3);
}

ParametrisedModel second_order(const std::string& q, const std::string& input,
                               const std::vector<std::pair<std::string, double>>& terms) {
  const Variables variables{{q, "v"}, {input}};
  Equation second;
  for (const auto& [term, coefficient] : terms)
    second.push_back({Term::parse(term, variables), coefficient});
  return with_free_coefficients(
      {{{q, ""}, {"v", ""}}, {{input, ""}}, {{{Term::parse("v", variables), 1.0}}, second}},
      {true, false});
}

std::vector<std::string> parameter_row(const std::string& name, double published,
                                       double found) {
  return {name, format_number(published, 4), format_number(found, 4),
          format_number(100.0 * (found / published - 1.0), 2)};
}

/// Mass, friction and offset from position and force.
std::string positioning(const std::filesystem::path& folder) {
  const Dataset record = read_dataset({(folder / "emps/emps_train.csv.gz").string()},
                                      {.states = {"q"}, .inputs = {"F"}});
  const auto start = std::chrono::steady_clock::now();
  const Refinement fit =
      refine(second_order("q", "F", {{"F", 0.01}, {"v", -1.0}, {"sign(v)", -0.1}, {"1", 0.0}}),
             record);
  const Vector p = fit.model.values() / fit.model.values()[0];
  const ResultTable table{
      {"parameter", "published", "found", "difference %"},
      {parameter_row("M [kg]", 95.11, 1.0 / fit.model.values()[0]),
       parameter_row("Fv [N s/m]", 203.5, -p[1]), parameter_row("Fc [N]", 20.39, -p[2]),
       parameter_row("offset [N]", -3.16, -p[3])}};
  return "## EMPS\n\nM q'' = F - Fv q' - Fc sign(q') - offset from position and force of the "
         "training record (24 841\nsamples); terms given.\n\n" +
         table.markdown() + "\n" + std::to_string(fit.windows.size()) + " windows, " +
         seconds_since(start) + " s.\n";
}

/// The linear resonator, and what identify() finds from no model.
std::string oscillator(const std::filesystem::path& folder) {
  const Dataset record = oscillator_record(folder);
  const Dataset train = rows(record, 40650, 65062), test = rows(record, 105712, 21688);
  const Dataset arrow = rows(record, 100, 40475), inside = rows(record, 100, 32000);
  const ParametrisedModel linear =
      second_order("y", "u", {{"u", 1.8e5}, {"v", -50.0}, {"y", -1.8e5}});
  const auto start = std::chrono::steady_clock::now();
  const Dataset embedded = embed(train, {{"y", 2}}, finite_differences({.order = 10}));
  const OdeModel found = identify(embedded, algorithm1()).model;
  const std::string time = seconds_since(start);
  ResultTable table{
      {"model", "multisine test mV", "arrow mV", "arrow without extrapolation mV"}, {}};
  const auto add = [&](const std::string& name, const OdeModel& model) {
    table.rows.push_back({name, simulation_error(model, test), simulation_error(model, arrow),
                          simulation_error(model, inside)});
  };
  add("linear", refine(linear, train).model.model());
  add("identified", found);
  return "## Silverbox\n\nAlgorithm 1 with its refinement on trajectories, monomials up to "
         "degree 3 in y, dy/dt and u, on the training part.\n\n" +
         table.markdown() + "\nFound (" + time + " s):\n\n```\n" + to_text(found, 6) +
         "\n```\n";
}

int run(const StudyArguments& arguments) {
  const std::string folder = arguments.measured_data();
  // Each uses all cores and tells its seconds.
  Cells<std::string> cells(Pace::OneByOne);
  cells.add("EMPS", [&] { return positioning(folder); });
  cells.add("Silverbox", [&] { return oscillator(folder); });
  cells.add("EMPS diagnosed", [&] { return diagnosed_positioning(folder); });
  cells.add("Silverbox diagnosed", [&] { return diagnosed_oscillator(folder); });
  cells.add("drives compared", [&] { return compared_drives(folder); });
  const auto finished = run_cells(arguments.store(folder), cells);
  if (!finished) return 0;
  write_page(arguments.folder_at(0), "measured",
             "# Measured records\n\n" + join(finished->values, "\n") + "\n" +
                 finished->origin.machine + ", " + finished->origin.day +
                 ". Seconds are of the clock. Command: `LACUNA_DATA=... study_measured FOLDER`\n");
  return 0;
}

}  // namespace
}  // namespace lacuna::benchmarks

int main(int argc, char** argv) {
  return lacuna::benchmarks::study_main(
      {"measured", "[OUTPUT_FOLDER]", lacuna::benchmarks::run}, argc, argv);
}
