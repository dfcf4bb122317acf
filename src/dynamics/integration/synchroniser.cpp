// SPDX-License-Identifier: MIT
#include "lacuna/dynamics/integration/synchroniser.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base/random.hpp"
#include "core/numerics/lagrange.hpp"
#include "data/records/number_range.hpp"
#include "lacuna/core/numerics/sampled_signal.hpp"
#include "lacuna/data/records/noise.hpp"
#include "lacuna/dynamics/integration/runge_kutta.hpp"
#include "lacuna/records/binding/model_view.hpp"

namespace lacuna {
namespace {

void check_shapes(const OdeModel& model, const SyncOptions& options) {
  const Index m = model.dimension();
  if (options.coupling && (options.coupling->rows() != m || options.coupling->cols() != m))
    throw ArgumentError("synchronisation, coupling",
                        "K is not " + std::to_string(m) + " x " + std::to_string(m),
                        "give one row and one column per state of the model");
  if (options.start && options.start->size() != m)
    throw ArgumentError("synchronisation, start",
                        "it has " + std::to_string(options.start->size()) + " values for " +
                            std::to_string(m) + " states",
                        "give one value per state of the model");
}

void check_lengths(const Dataset& record, Index needed) {
  if (record.trajectories.empty())
    throw DataError("synchronisation", "the record has no trajectory", "give at least one");
  for (const Trajectory& trajectory : record.trajectories) {
    if (trajectory.samples() >= needed) continue;
    throw DataError(trajectory.source,
                    "it has " + std::to_string(trajectory.samples()) +
                        " samples; to synchronise by this integrator needs " +
                        std::to_string(needed),
                    "use a longer record or an integrator of lower order");
  }
}

/// States, inputs and time of a record as one signal: the variables in slot order.
Matrix variables_of(const Trajectory& trajectory) {
  Matrix all(trajectory.samples(), trajectory.states.cols() + trajectory.inputs.cols() + 1);
  all << trajectory.states, trajectory.inputs, trajectory.time;
  return all;
}

/// The slave: f(t, x) - K (x - x_m(t)).
class Slave {
 public:
  Slave(const OdeModel& model, const Matrix& coupling, const Trajectory& trajectory,
        LagrangeWindow window)
      : compiled_(model.compile()),
        variables_(variables_of(trajectory)),
        drive_(trajectory.time, variables_, window),
        past_(trajectory.time, variables_, window),
        first_time_(trajectory.time[0]),
        present_(static_cast<std::size_t>(variables_.cols())),
        earlier_(present_.size()),
        delayed_(compiled_.delays().size()) {
    const Index m = model.dimension();
    for (std::size_t j = 0; j < model.inputs().size(); ++j) {
      const Interpolation between = interpolation_of(model.inputs()[j].hold);
      const auto input = static_cast<Index>(j);
      if (between != Interpolation::Cubic)
        rough_.push_back({m + input, {trajectory.time, trajectory.inputs.col(input), between}});
    }
    for (Index j = 0; j < coupling.cols(); ++j)
      for (Index i = 0; i < coupling.rows(); ++i)
        if (coupling(i, j) != 0.0) links_.push_back({i, j, coupling(i, j)});
  }

  void start_interval(Index n) {
    drive_.select(n);
    interval_ = n;
    fresh_ = false;
  }

  void operator()(double t, const double* x, double* dxdt) {
    look_up(t);
    compiled_.evaluate(t, x, present_.data() + compiled_.dimension(), delayed_.data(), dxdt);
    for (const Link& link : links_)
      dxdt[link.row] -= link.strength * (x[link.column] - present_[slot(link.column)]);
  }

 private:
  struct Link {
    Index row, column;
    double strength;
  };

  /// An input that is not smooth.
  struct RoughInput {
    Index column;
    SampledSignal signal;
  };

  static std::size_t slot(Index i) { return static_cast<std::size_t>(i); }

  // Stages at the same time see the same record.
  void look_up(double t) {
    if (fresh_ && t == time_) return;
    drive_.evaluate(t, present_.data());
    for (const RoughInput& input : rough_)
      present_[slot(input.column)] = input.signal.in_interval(interval_, t);
    for (std::size_t i = 0; i < delayed_.size(); ++i)
      delayed_[i] = past(compiled_.delays()[i], t);
    time_ = t;
    fresh_ = true;
  }

  double past(const DelayedVariable& variable, double t) {
    const double s = std::max(t - variable.delay, first_time_);
    past_.select(past_.interval_of(s));
    past_.evaluate(s, earlier_.data());
    for (RoughInput& input : rough_) earlier_[slot(input.column)] = input.signal(s);
    return earlier_[slot(variable.slot)];
  }

  CompiledModel compiled_;
  Matrix variables_;
  LagrangeInterpolant drive_, past_;
  double first_time_;
  std::vector<double> present_, earlier_, delayed_;
  std::vector<Link> links_;
  std::vector<RoughInput> rough_;
  Index interval_ = 0;
  double time_ = 0.0;
  bool fresh_ = false;
};

/// 1 for each state of the slave that the record shows.
Vector seen_states(const Dataset& view) {
  Vector seen = Vector::Ones(view.state_count());
  for (Index k = 0; k < seen.size(); ++k)
    if (is_hidden(view, k)) seen[k] = 0.0;
  return seen;
}

/// K as it was given, or made for this record.
/// @throws ArgumentError where it couples a state that nobody measured.
Matrix coupling_of(const OdeModel& model, const Dataset& view, const Vector& seen,
                   const std::optional<Matrix>& given) {
  if (!given) return default_coupling(view) * seen.asDiagonal();
  for (Index k = 0; k < seen.size(); ++k)
    if (seen[k] == 0.0 && !given->col(k).isZero(0.0))
      throw ArgumentError("synchronisation, coupling",
                          "nobody measured the state '" +
                              model.states()[static_cast<std::size_t>(k)].name + "'",
                          "couple states that have a column");
  return *given;
}

void check_delays(const OdeModel& model, const Vector& seen) {
  const CompiledModel compiled = model.compile();
  for (const DelayedVariable& variable : compiled.delays())
    if (variable.slot < seen.size() && seen[variable.slot] == 0.0)
      throw ModelError("synchronisation",
                       "the past of the hidden state '" +
                           model.states()[static_cast<std::size_t>(variable.slot)].name +
                           "' is not known",
                       "measure it, or leave its delay out");
}

/// One trajectory's run of the slave.
struct Run {
  Vector errors;
  Matrix states;
  IntegrationStatus status = IntegrationStatus::Completed;
  double end_time = 0.0;
  Vector end_state;
};

/// @param seen 1 for the states whose errors count.
Run follow(Slave& slave, const Trajectory& record, const Integrator& integrator,
           const Vector& start, const Vector& seen, const RunContext& context) {
  Run run{.errors = Vector(record.samples()),
          .states = Matrix(record.samples(), start.size()),
          .end_time = record.time[0],
          .end_state = start};
  const std::unique_ptr<Stepper> stepper = integrator.make_stepper(start.size());
  const auto keep = [&](Index n) {
    run.states.row(n) = run.end_state.transpose();
    run.errors[n] = ((run.states.row(n) - record.states.row(n)) * seen.asDiagonal()).norm();
  };
  keep(0);
  for (Index n = 0; n + 1 < record.samples(); ++n) {
    if (n % 4096 == 0)
      context.report("synchronising",
                     static_cast<double>(n) / static_cast<double>(record.samples()));
    slave.start_interval(n);
    run.status =
        stepper->advance(slave, run.end_time, record.time[n + 1], run.end_state.data());
    if (run.status != IntegrationStatus::Completed) {
      run.errors.conservativeResize(n + 1);
      run.states.conservativeResize(n + 1, Eigen::NoChange);
      break;
    }
    keep(n + 1);
  }
  return run;
}

double largest_norm(const Dataset& record) {
  double largest = 0.0;
  for (const Trajectory& trajectory : record.trajectories)
    largest =
        std::max(largest, std::sqrt(trajectory.states.rowwise().squaredNorm().maxCoeff()));
  return largest;
}

double median_of(std::vector<double> values) {
  const std::size_t half = values.size() / 2;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(half);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

void add_statistics(const Dataset& record, SyncResult& result) {
  std::vector<double> all;
  for (const Vector& errors : result.errors)
    all.insert(all.end(), errors.begin(), errors.end());
  double sum = 0.0;
  for (const double error : all) sum += error;
  result.mean = sum / static_cast<double>(all.size());
  result.median = median_of(std::move(all));
  const double largest = largest_norm(record);
  result.relative = largest > 0.0 ? result.mean / largest : 0.0;
}

/// Root mean square of the errors from one share of every trajectory to another.
double rms_between(const std::vector<Vector>& errors, double from, double to) {
  double squares = 0.0;
  Index count = 0;
  for (const Vector& e : errors) {
    const double n = static_cast<double>(e.size());
    const auto begin = static_cast<Index>(from * n), end = static_cast<Index>(to * n);
    squares += e.segment(begin, end - begin).squaredNorm();
    count += end - begin;
  }
  return std::sqrt(squares / static_cast<double>(std::max<Index>(count, 1)));
}

/// Root mean square distance of the samples from their mean.
double spread(const Dataset& record) {
  Eigen::RowVectorXd mean = Eigen::RowVectorXd::Zero(record.state_count());
  for (const Trajectory& trajectory : record.trajectories)
    mean += trajectory.states.colwise().sum();
  mean /= static_cast<double>(record.samples());
  double squares = 0.0;
  for (const Trajectory& trajectory : record.trajectories)
    squares += (trajectory.states.rowwise() - mean).squaredNorm();
  return std::sqrt(squares / static_cast<double>(record.samples()));
}

/// Root mean square of what slaves are off paths, of each state over the last three quarters.
Vector late_errors(const std::vector<Matrix>& slaves, const std::vector<Matrix>& paths) {
  Vector squares = Vector::Zero(slaves.front().cols());
  double count = 0.0;
  for (std::size_t r = 0; r < slaves.size(); ++r) {
    const Index n = slaves[r].rows(), late = n - n / 4;
    const Matrix left = (slaves[r] - paths[r].topRows(n)).bottomRows(late);
    squares += left.colwise().squaredNorm().transpose();
    count += static_cast<double>(late);
  }
  return (squares / count).cwiseSqrt();
}

std::optional<double> error_over_noise(const Dataset& record, const SyncResult& result) {
  std::vector<Matrix> paths;
  for (const Trajectory& trajectory : record.trajectories) paths.push_back(trajectory.states);
  const Vector errors = late_errors(result.states, paths);
  std::optional<double> worst;
  for (Index k = 0; k < errors.size(); ++k)
    if (record.is_measured(k) && result.noise[k] > 0.0)
      worst = std::max(worst.value_or(0.0), errors[k] / result.noise[k]);
  return worst;
}

bool has_settled(const Dataset& record, const SyncResult& result) {
  if (result.status != IntegrationStatus::Completed) return false;
  const double own = spread(record);
  const double late = rms_between(result.errors, 0.75, 1.0);
  const double before = rms_between(result.errors, 0.25, 0.75);
  const double rounding = 1e-12 * largest_norm(record);
  return late <= rounding || (late <= 3.0 * before && late < 0.5 * own);
}

/// What slaves of one model have in common.
struct SlaveTask {
  const OdeModel& model;
  const Matrix& coupling;
  const Integrator& integrator;
  LagrangeWindow window;  ///< by which the record drives
  const std::optional<Vector>& start;
  const Vector& seen;  ///< m: 1 for the states that the record shows, else 0
  const RunContext& context;
};

Vector start_of(const SlaveTask& task, const Trajectory& trajectory) {
  if (task.start) return *task.start;
  const Vector given = given_begin(task.model), first = trajectory.states.row(0).transpose();
  return (task.seen.array() > 0.0).select(first, given);
}

Run run_slave(const SlaveTask& task, const Trajectory& trajectory, const Vector& start) {
  Slave slave(task.model, task.coupling, trajectory, task.window);
  return follow(slave, trajectory, task.integrator, start, task.seen, task.context);
}

/// See SyncResult::response.
Vector response_to_noise(const SlaveTask& task, const Dataset& record,
                         const SyncResult& result) {
  const Vector none = Vector::Zero(record.state_count());
  if (result.status != IntegrationStatus::Completed || !(result.noise.maxCoeff() > 0.0))
    return none;
  Random random(1);
  std::vector<Matrix> states;
  for (Trajectory noisier : record.trajectories) {
    for (Index n = 0; n < noisier.samples(); ++n)
      for (Index k = 0; k < none.size(); ++k)
        noisier.states(n, k) += result.noise[k] * random.normal();
    Run run = run_slave(task, noisier, start_of(task, noisier));
    if (run.status != IntegrationStatus::Completed) return none;
    states.push_back(std::move(run.states));
  }
  return late_errors(states, result.states);
}

/// See SyncResult::conditional_exponent.
double conditional_exponent(const SlaveTask& task, const Trajectory& record,
                            const SyncResult& result) {
  constexpr double kResolved = 1e-6;  // a fact of doubles: well above their rounding
  const Matrix& own = result.states.front();
  Vector reach = (own.colwise().maxCoeff() - own.colwise().minCoeff()).transpose();
  reach = (reach.array() > 0.0).select(reach, 1.0);
  const Vector weight = (1.0 - task.seen.array()) / reach.array();
  const Vector start =
      start_of(task, record) + (1.0 - task.seen.array()).matrix().cwiseProduct(reach);
  const Run other = run_slave(task, record, start);
  if (other.status != IntegrationStatus::Completed ||
      result.status != IntegrationStatus::Completed)
    return std::numeric_limits<double>::infinity();
  const Vector distance = ((other.states - own) * weight.asDiagonal()).rowwise().norm();
  Index n = 1;
  while (n + 1 < distance.size() && distance[n] > kResolved * distance[0]) ++n;
  return std::log(std::max(distance[n], 1e-300) / distance[0]) /
         (record.time[n] - record.time[0]);
}

std::string divergence_message(const Trajectory& trajectory, const Run& run,
                               const OdeModel& model, const std::string& time_unit) {
  std::vector<std::string> names;
  for (const Quantity& state : model.states()) names.push_back(state.name);
  return trajectory.source + ": the slave " +
         end_message(run.status, run.end_time, run.end_state, names, time_unit);
}

/// The slaves of all trajectories and what they show.
SyncResult driven(const SlaveTask& task, const Dataset& view) {
  SyncResult result;
  result.coupling = task.coupling;
  result.noise = estimate_noise(view);
  for (const Trajectory& trajectory : view.trajectories) {
    Run run = run_slave(task, trajectory, start_of(task, trajectory));
    if (run.status != IntegrationStatus::Completed && result.message.empty()) {
      result.status = run.status;
      result.message = divergence_message(trajectory, run, task.model, view.time_unit);
    }
    result.errors.push_back(std::move(run.errors));
    result.states.push_back(std::move(run.states));
  }
  add_statistics(view, result);
  result.settled = has_settled(view, result);
  result.response = response_to_noise(task, view, result);
  result.error_over_noise = error_over_noise(view, result);
  if (task.seen.minCoeff() == 0.0)
    result.conditional_exponent = conditional_exponent(task, view.trajectories.front(), result);
  return result;
}

/// Steps for slaves that are faster than the samples: the record between its samples is known
/// to no more than these tolerances, and what takes more steps has run away.
Dopri5Options stiff_steps(const Dataset& view) {
  constexpr double kRelative = 1e-6, kAbsolute = 1e-9;
  constexpr int kMostSteps = 1000;
  const double absolute = std::max(kAbsolute * largest_norm(view), 1e-300);
  return {{.relative_tolerance = kRelative,
           .absolute_tolerance = absolute,
           .max_steps = kMostSteps}};
}

}  // namespace

Dataset long_enough(Dataset record, const Integrator& integrator) {
  const Index needed = LagrangeWindow::driving(integrator.order()).points;
  std::vector<Trajectory>& all = record.trajectories;
  const auto too_short = std::stable_partition(
      all.begin(), all.end(),
      [&](const Trajectory& trajectory) { return trajectory.samples() >= needed; });
  const auto count = all.end() - too_short;
  if (count == 0 || too_short == all.begin()) return record;
  all.erase(too_short, all.end());
  record.notes.push_back(std::to_string(count) + " pieces of less than " +
                         std::to_string(needed) + " samples were left out");
  return record;
}

SyncResult synchronise(const OdeModel& model, const Dataset& record,
                       const Integrator& integrator, const SyncOptions& options,
                       const RunContext& context) {
  check_flow(model, "synchronise");
  check_dataset(record);
  check_shapes(model, options);
  const LagrangeWindow window = LagrangeWindow::driving(integrator.order());
  const Dataset view = model_view(model, record);
  check_number_range(view);
  check_lengths(view, window.points);
  const Vector seen = seen_states(view);
  check_delays(model, seen);
  const Matrix coupling = coupling_of(model, view, seen, options.coupling);
  SyncResult result =
      driven({model, coupling, integrator, window, options.start, seen, context}, view);
  if (result.status == IntegrationStatus::Completed) return result;
  const Dopri5 adaptive(stiff_steps(view));
  SyncResult finer =
      driven({model, coupling, adaptive, window, options.start, seen, context}, view);
  if (finer.status != IntegrationStatus::Completed) return result;
  finer.stiff = true;
  return finer;
}

}  // namespace lacuna
