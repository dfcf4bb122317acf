// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>

#include "answers.hpp"
#include "assignments.hpp"
#include "command.hpp"
#include "core/base/random.hpp"
#include "core/base/text.hpp"
#include "data_options.hpp"
#include "lacuna/data/formats/write.hpp"
#include "lacuna/dynamics/integration/simulate.hpp"
#include "lacuna/dynamics/test_systems/test_systems.hpp"
#include "lacuna/records/binding/read_records.hpp"
#include "model/equations/output_values.hpp"
#include "records/channels/shown_holds.hpp"

namespace lacuna::cli {
namespace {

struct SimulateArguments : SimulateRequest {
  std::string output = "-";
  RunOptions run;
};

Vector parse_start(const OdeModel& model, const std::string& text) {
  const std::vector<std::string> parts = split_list(text);
  if (static_cast<Index>(parts.size()) != model.dimension())
    throw ConfigError("--x0 " + text,
                      std::to_string(parts.size()) + " numbers for " +
                          std::to_string(model.dimension()) + " states",
                      "give one number per state, in the order of the model");
  Vector start(model.dimension());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto number = parse_number(parts[i]);
    if (!number || !std::isfinite(*number))
      throw ConfigError("--x0 " + text, "'" + parts[i] + "' is not a number", "give a number");
    start[static_cast<Index>(i)] = *number;
  }
  return start;
}

/// Where a test system starts; null for a model of a file.
const Vector* start_of_test_system(const ModelSource& source) {
  std::error_code unreadable;
  if (source.given || std::filesystem::exists(source.path, unreadable)) return nullptr;
  const std::vector<TestSystem>& all = test_systems();
  const auto found = std::find_if(all.begin(), all.end(), [&](const TestSystem& system) {
    return system.name == source.path;
  });
  return found == all.end() ? nullptr : &found->start;
}

/// The initial values that the model itself has, or those of the test system that it is.
Vector initial_values(const OdeModel& model, const ModelSource& source) {
  if (const Vector* known = start_of_test_system(source)) return *known;
  Vector start(model.dimension());
  std::vector<std::string> without;
  for (Index k = 0; k < model.dimension(); ++k) {
    const auto& initial = model.initial()[static_cast<std::size_t>(k)];
    if (initial)
      start[k] = initial->value;
    else
      without.push_back(model.states()[static_cast<std::size_t>(k)].name);
  }
  if (!without.empty())
    throw ConfigError("--x0", "the model has no initial value of " + join(without, ", "),
                      "give --x0 with one number per state, or `initial` in the model");
  return start;
}

/// From `first` on the times of a record, up to `last`.
Vector times_within(const Vector& record, double first, double last) {
  const auto begin = std::upper_bound(record.begin(), record.end(), first);
  const auto count = std::upper_bound(begin, record.end(), last) - begin;
  Vector times(count + 1);
  times << first, record.segment(begin - record.begin(), count);
  return times;
}

[[noreturn]] void refuse_without(const std::string& option) {
  throw ConfigError(option, "nothing says it where no record of inputs is given",
                    "give " + option + " with a number");
}

/// When the output is wanted. What is not given is taken from the initial values, which hold at
/// `begin`, and the times of the input record.
/// @param known times of the input record; null where there is none.
Vector parse_times(const SimulateRequest& options, bool is_map, std::optional<double> begin,
                   const Vector* known) {
  constexpr double kStepOfMaps = 1.0;  // a fact, by definition
  if (options.times) return *options.times;
  if (!options.t_end && known == nullptr) refuse_without("--t-end");
  const double start = begin ? *begin : known != nullptr ? (*known)[0] : 0.0;
  const double first = options.t_start.value_or(start);
  const double last = options.t_end ? *options.t_end : (*known)[known->size() - 1];
  const bool own_step = options.step || is_map;
  if (!own_step && known == nullptr) refuse_without("--dt");
  const double step = options.step.value_or(kStepOfMaps), span = last - first;
  if (!(step > 0.0) || !(span > 0.0) || !std::isfinite(span / step))
    throw ConfigError("--dt, --t-end", "the step and the duration must be above 0",
                      "give --t-end later than --t-start and --dt above 0");
  if (!own_step) return times_within(*known, first, last);
  if (span / step > 1e9)
    throw ConfigError("--dt, --t-end", "this asks for more than 1e9 samples",
                      "take a longer --dt or an earlier --t-end");
  const auto steps = static_cast<Index>(std::floor(span / step * (1.0 + 1e-12) + 1e-9));
  return sample_times(first, step, steps + 1);
}

/// The input file in the inputs of the model; its first record is the one.
Dataset input_records(const OdeModel& model, const SimulateRequest& options) {
  if (options.inputs.empty())
    throw ConfigError("--input-data", "the model has inputs but no record of them is given",
                      "give a file with a column for each input");
  DataOptions data = options.data;
  data.time = options.input_time;
  check_map(data, column_names(model));
  const ColumnRoles roles = common_roles(data);
  if (!options.inputs.tables.empty())
    return inputs_of_table(model, options.inputs.tables.front(), roles);
  return read_inputs(model, options.inputs.paths.front(), roles);
}

/// What is to be said of the inputs: how they were read, and where the simulation goes beyond
/// them.
std::vector<std::string> notes_on_inputs(const Vector& times, const Dataset& record) {
  const Vector& time = record.trajectories.front().time;
  const double begin = time[0], end = time[time.size() - 1];
  std::vector<std::string> notes = record.notes;
  if (times[0] < begin)
    notes.push_back("the input record begins at " + format_number(begin, 6) +
                    "; before that its first value holds");
  if (times[times.size() - 1] > end)
    notes.push_back("the input record ends at " + format_number(end, 6) +
                    "; from there on its last value holds");
  return notes;
}

/// What was simulated and the inputs at its times.
struct Run {
  Solution orbit;
  Matrix inputs;  ///< n x p
  std::vector<std::string> notes = {};
};

Matrix inputs_at(const Vector& times, RecordInput& inputs, Index count) {
  Matrix values(times.size(), count);
  Vector row(count);
  for (Index i = 0; i < times.size(); ++i) {
    inputs(times[i], row.data());
    values.row(i) = row.transpose();
  }
  return values;
}

/// The times behind one at which the initial values hold.
/// @throws ConfigError where the simulation begins before it.
Vector from_initial_time(double begin, const Vector& times) {
  if (times[0] < begin)
    throw ConfigError("--t-start",
                      "the initial values of the model hold at t = " + format_number(begin) +
                          ", behind the begin of the simulation",
                      "begin there or later, or give --x0");
  Vector all(times.size() + 1);
  all << begin, times;
  return all;
}

Run without_first_row(Run run) {
  const Index rows = run.orbit.time.size() - 1;
  run.orbit.time = run.orbit.time.tail(rows).eval();
  run.orbit.states = run.orbit.states.bottomRows(rows).eval();
  run.inputs = run.inputs.bottomRows(run.inputs.rows() - 1).eval();
  return run;
}

/// @param record of the inputs; null for a model without.
Run run_from(const Vector& start, const Vector& times, const OdeModel& model,
             const Integrator& integrator, const Dataset* record, const RunContext& context) {
  if (record == nullptr)
    return {simulate(model, integrator, start, times, context), Matrix(times.size(), 0)};
  const OdeModel driven = with_shown_holds(model, *record);
  RecordInput inputs(record->trajectories.front(), driven.inputs());
  Solution orbit =
      simulate(DrivenModel{driven, inputs, inputs.breaks()}, integrator, start, times, context);
  return {std::move(orbit), inputs_at(times, inputs, static_cast<Index>(model.inputs().size())),
          notes_on_inputs(times, *record)};
}

Run run(const OdeModel& model, const Integrator& integrator, const SimulateRequest& options,
        const RunContext& context) {
  const bool own = options.x0.empty();
  const Vector start = own ? initial_values(model, options.model) : parse_start(model, options.x0);
  const std::optional<double> begin = own ? model.initial_time() : std::nullopt;
  std::optional<Dataset> record;
  if (!model.inputs().empty()) record = input_records(model, options);
  const Dataset* inputs = record ? &*record : nullptr;
  const Vector times = parse_times(options, model.is_map(), begin,
                                   record ? &record->trajectories.front().time : nullptr);
  if (!begin || times[0] == *begin)
    return run_from(start, times, model, integrator, inputs, context);
  return without_first_row(run_from(start, from_initial_time(*begin, times), model, integrator,
                                    inputs, context));
}

/// States and, behind them, the outputs that are called otherwise; inputs.
Dataset as_dataset(const OdeModel& model, Run run) {
  Solution& orbit = run.orbit;
  Dataset data;
  data.time_unit = model.time_unit();
  data.states = model.states();
  data.inputs = model.inputs();
  Trajectory trajectory;
  trajectory.source = "simulation";
  trajectory.inputs = run.inputs;
  const Matrix outputs = output_values(model, orbit.time, orbit.states, run.inputs);
  trajectory.time = std::move(orbit.time);
  trajectory.states = std::move(orbit.states);
  trajectory.states.conservativeResize(Eigen::NoChange, data.state_count() + outputs.cols());
  for (std::size_t i = 0; i < model.outputs().size(); ++i) {
    const Output& output = model.outputs()[i];
    const auto state = state_of(model, output);
    if (state && model.states()[static_cast<std::size_t>(*state)].name == output.name) continue;
    trajectory.states.col(data.state_count()) = outputs.col(static_cast<Index>(i));
    data.states.push_back({output.name, output.unit});
  }
  trajectory.states.conservativeResize(Eigen::NoChange, data.state_count());
  data.trajectories.push_back(std::move(trajectory));
  return data;
}

/// Standard deviations of the noise by column, as NAME=SD gives them.
Vector parse_noise(const std::vector<std::string>& assignments, const Dataset& data) {
  Vector sigma = Vector::Zero(data.state_count());
  for (const Assignment& part :
       read_assignments({"--noise", "NAME=SD", "--noise x=0.01"}, assignments)) {
    const auto column =
        std::find_if(data.states.begin(), data.states.end(),
                     [&](const Quantity& state) { return state.name == part.name; });
    const auto number = parse_number(part.value);
    if (column == data.states.end())
      throw ConfigError("--noise " + part.text, "the simulation has no such column",
                        "name a state or an output, as in x=0.01");
    if (!number || !std::isfinite(*number) || *number < 0.0)
      throw ConfigError("--noise " + part.text, "the standard deviation is no number from 0 on",
                        "write " + column->name + "=0.01");
    sigma[column - data.states.begin()] = *number;
  }
  return sigma;
}

/// Adds white noise with a standard deviation for each column.
void add_noise(const Vector& sigma, std::uint64_t seed, Trajectory& record) {
  Random random(seed);
  for (Index k = 0; k < sigma.size(); ++k)
    for (Index i = 0; sigma[k] > 0.0 && i < record.samples(); ++i)
      record.states(i, k) += sigma[k] * random.normal();
}

/// What keeps a simulation from being written: its first value that is no finite number.
std::optional<std::string> not_finite(const Dataset& data) {
  const Trajectory& run = data.trajectories.front();
  for (Index i = 0; i < run.samples(); ++i) {
    if (!std::isfinite(run.time[i]))
      return "row " + std::to_string(i + 1) + ": the time is beyond the range of numbers";
    for (Index k = 0; k < data.state_count(); ++k)
      if (!std::isfinite(run.states(i, k)))
        return data.states[static_cast<std::size_t>(k)].name +
               " is no finite number at t = " + format_number(run.time[i], 6);
  }
  return std::nullopt;
}

int simulate_command(const Session& session, const SimulateArguments& options) {
  const SimulateAnswer done =
      answer(session.registry, options, make_context(session, options.run));
  finish_progress(session, options.run);
  for (const std::string& note : done.notes)
    session.streams.err << "lacuna: note: " << note << "\n";
  if (!done.problem.empty()) {
    session.streams.err << "lacuna: error: " << options.model.path << ": " << done.problem
                        << "; nothing was written, end earlier or start elsewhere\n";
    return 1;
  }
  if (options.output == "-")
    session.streams.out << format_csv(done.data);
  else
    write_csv(options.output, done.data);
  return 0;
}

void declare_options(Command& command, SimulateArguments& options) {
  command.add("MODEL", &options.model.path, "Model file, or the name of a test system")
      .require();
  command.add(
      "--x0 v1,v2,...", &options.x0,
      "Start: one number per state, in the order of the model; else its `initial`, of a "
      "test system its own");
  command
      .add("--t-start", &options.t_start,
           "First time, in the model's time unit; else that of the initial values, that of "
           "the input record, or 0")
      .check(finite());
  command
      .add("--t-end", &options.t_end,
           "Last time, in the model's time unit [default: the end of the input record]")
      .check(finite());
  command
      .add("--dt", &options.step,
           "Step of the output, in the model's time unit [default: the times of the input "
           "record]; of a map, time from one value to the next [default: 1]")
      .check(finite());
  command.add("-o,--output FILE|-", &options.output, "CSV file [default: standard output]");
  command.add("--integrator NAME", &options.integrator, "Method; see `lacuna list integrator`")
      .show_default();
  command
      .add("--input-data FILE", &options.inputs.paths,
           "Record with a column for each input of the model; they are written beside the "
           "states")
      .expect_one();
  command.add("--noise NAME=SD", &options.noise,
              "Standard deviation of white noise that is added to a state or an output");
  declare_hold_option(command, options.data);
  declare_map_option(command, options.data);
  command.add("--time NAME", &options.input_time, "Time column of the input record");
  declare_run_options(command, options.run);
  declare_time_limit(command, options.run);
}

}  // namespace

SimulateAnswer answer(const Registry& registry, const SimulateRequest& request,
                      const RunContext& context) {
  const OdeModel model = with_holds(load_model(request.model), request.data);
  const auto integrator = registry.make<Integrator>(request.integrator);
  Run done = run(model, *integrator, request, context);
  SimulateAnswer result{{}, std::move(done.notes)};
  if (done.orbit.status != IntegrationStatus::Completed) {
    result.problem = done.orbit.message;
    if (done.orbit.status == IntegrationStatus::StepTooSmall && !integrator->has_fixed_steps())
      result.problem += " (fixed steps, by --integrator rk4, do not stop)";
    return result;
  }
  result.data = as_dataset(model, std::move(done));
  add_noise(parse_noise(request.noise, result.data), context.seed,
            result.data.trajectories.front());
  if (const auto problem = not_finite(result.data)) result.problem = *problem;
  return result;
}

Command declare_simulate() {
  auto options = std::make_shared<SimulateArguments>();
  Command command{"simulate", "Solve a model from a given start"};
  declare_options(command, *options);
  command.run = [options](const Session& session) {
    return simulate_command(session, *options);
  };
  return command;
}

}  // namespace lacuna::cli
