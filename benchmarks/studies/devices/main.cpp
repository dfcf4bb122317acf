// SPDX-License-Identifier: MIT
// What the diagnosis says of devices and of small inputs after cases from the field, of which
// it is known what holds. Usage: study_devices [OUTPUT_FOLDER] [PART_OF_A_NAME]
// [--cells FOLDER], with LACUNA_DATA set.
#include <chrono>
#include <cmath>
#include <filesystem>

#include "cli/configuration/diagnosis_configuration.hpp"
#include "core/base/text.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/derivatives/differentiators.hpp"
#include "lacuna/diagnose/diagnose.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/records/binding/read_records.hpp"
#include "support/settings.hpp"
#include "support/table.hpp"

namespace lacuna::benchmarks {
namespace {

/// A record with a nominal model, and what holds.
struct Device {
  std::string model, find, check;  ///< below LACUNA_DATA; `check` may be empty
  std::string holds;
};

std::vector<Device> all_devices() {
  return {
      {"devices/two_tanks/start.ode", "devices/two_tanks/train.csv",
       "devices/two_tanks/test.csv", "coefficients only"},
      {"devices/two_tanks/nominal.ode", "devices/two_tanks/train.csv",
       "devices/two_tanks/test.csv", "coefficients only"},
      {"field/lattice/heater.ode", "field/lattice/steps_q.csv", "",
       "lag of Q of 20 s, lattice 0.3223"},
      {"field/lattice/heater.ode", "field/lattice/const_q.csv", "",
       "no name with Q, lattice 0.3223"},
      {"field/lattice/heater.ode", "field/lattice/null_q.csv", "", "nothing, lattice 0.3223"},
      {"field/lattice/heater.ode", "field/lattice/null_q4.csv", "", "nothing, lattice 0.3223"},
      {"field/lattice/heater.ode", "field/lattice/steps_fine.csv", "", "lag of Q of 20 s"},
      {"field/const_input/heater.ode", "field/const_input/heater.csv", "", "no name with Q"},
      {"field/twolevel/rc2.ode", "field/twolevel/square_1.csv", "field/twolevel/square_2.csv",
       "delay of part of a step, or cannot tell"},
      {"field/twolevel/rc2.ode", "field/twolevel/prbs_1.csv", "field/twolevel/prbs_2.csv",
       "delay of part of a step"},
      {"field/quarter/m.ode", "field/quarter/spike299.csv", "", "one spike"},
      {"field/trend/rack.ode", "field/trend/stroke.csv", "", "no trend"},
      {"field/noisy_input/pend.ode", "field/noisy_input/a.csv", "field/noisy_input/b.csv",
       "dry friction, noise of the input"},
      {"field/wall/one.ode", "field/wall/wall1.csv", "field/wall/wall2.csv", "second store"},
  };
}

/// What came of one.
struct Told {
  std::string verdict, names, failure;
  /// Nothing where there is no gap, as where the nominal model has no finite solution.
  std::optional<double> before = {}, after = {}, floor = {}, free_run = {};
  double seconds = 0.0;  ///< by the clock of the machine, whatever else runs there

  auto fields() {
    return std::tie(verdict, names, failure, before, after, floor, seconds, free_run);
  }
};

Told told_of(const std::filesystem::path& folder, const Device& device) {
  Told told;
  const auto start = std::chrono::steady_clock::now();
  try {
    const OdeModel model = read_model((folder / device.model).string());
    const auto read = [&](const std::string& path) {
      return path.empty()
                 ? Dataset{}
                 : read_records(model, {(folder / path).string()}, {}, finite_differences());
    };
    const Diagnosis found =
        diagnose(model, read(device.find), read(device.check),
                 diagnosis_options({}, default_registry()), RunContext{});
    told.verdict = to_string(found.verdict);
    std::vector<std::string> names;
    for (const NamedEffect& effect : found.effects)
      names.push_back(effect.name + " " + format_number(effect.coefficient, 4) + " * " +
                      effect.term);
    told.names = join(names, "; ");
    if (found.gap) {
      told.before = found.gap->before;
      told.after = found.gap->after;
      told.floor = found.gap->noise_floor;
      if (found.gap->free_after) told.free_run = found.gap->free_after->apart;
    }
  } catch (const Error& error) {
    told.failure = error.what();
  }
  told.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return told;
}

std::string percent(const std::optional<double>& fraction) {
  return fraction ? format_number(100.0 * *fraction, 3) : "";
}

std::string table_of(const std::vector<Device>& devices, const std::vector<Told>& all) {
  ResultTable table{{"record", "holds", "verdict", "names", "gap %, nominal", "after", "noise",
                     "free run, spreads", "seconds"},
                    {}};
  for (std::size_t i = 0; i < devices.size(); ++i) {
    const Told& told = all[i];
    table.rows.push_back({devices[i].find, devices[i].holds,
                          told.failure.empty() ? told.verdict : told.failure, told.names,
                          percent(told.before), percent(told.after), percent(told.floor),
                          told.free_run ? format_number(*told.free_run, 3) : "",
                          format_number(told.seconds, 3)});
  }
  return table.markdown();
}

int run(const StudyArguments& arguments) {
  const std::string folder = arguments.measured_data();
  std::vector<Device> devices;
  for (Device& device : all_devices())
    if (device.find.find(arguments.at(1)) != std::string::npos)
      devices.push_back(std::move(device));
  Cells<Told> cells(Pace::OneByOne);
  for (const Device& device : devices)
    cells.add(device.model + " " + device.find, [=] { return told_of(folder, device); });
  const auto finished = run_cells(arguments.store(folder), cells);
  if (!finished) return 0;
  write_page(arguments.folder_at(0), "devices",
             "# Devices\n\n" + table_of(devices, finished->values) + "\n" +
                 finished->origin.machine + ", " + finished->origin.day +
                 ". Gaps are those on records that chose nothing. Command: "
                 "`LACUNA_DATA=... study_devices FOLDER`\n");
  return 0;
}

}  // namespace
}  // namespace lacuna::benchmarks

int main(int argc, char** argv) {
  return lacuna::benchmarks::study_main(
      {"devices", "[OUTPUT_FOLDER] [PART_OF_A_NAME]", lacuna::benchmarks::run}, argc, argv);
}
