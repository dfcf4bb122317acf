// SPDX-License-Identifier: MIT
#include "slave.hpp"

#include <algorithm>
#include <memory>
#include <vector>

#include "lacuna/core/numerics/sampled_signal.hpp"
#include "lacuna/records/binding/model_view.hpp"
#include "watched_rates.hpp"

namespace lacuna {
namespace {

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
      if (!is_smooth(between))
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

/// To the end of an interval, in as many steps as a task asks for.
IntegrationStatus advance(RightHandSide slave, Stepper& stepper, double end, int parts,
                          SlaveRun& run) {
  const double begin = run.end_time;
  for (int part = 1; part <= parts; ++part) {
    const double next = part < parts ? begin + (end - begin) * part / parts : end;
    const IntegrationStatus status =
        stepper.advance(slave, run.end_time, next, run.end_state.data());
    if (status != IntegrationStatus::Completed) return status;
  }
  return IntegrationStatus::Completed;
}

SlaveRun follow(Slave& slave, const Trajectory& record, const SlaveTask& task,
                const Vector& start) {
  SlaveRun run{.errors = Vector(record.samples()),
               .states = Matrix(record.samples(), start.size()),
               .end_time = record.time[0],
               .end_state = start};
  const std::unique_ptr<Stepper> stepper = task.integrator.make_stepper(start.size());
  WatchedRates watched(slave, task.context);
  const auto keep = [&](Index n) {
    run.states.row(n) = run.end_state.transpose();
    run.errors[n] =
        ((run.states.row(n) - record.states.row(n)) * task.seen.asDiagonal()).norm();
  };
  keep(0);
  for (Index n = 0; n + 1 < record.samples(); ++n) {
    task.context.check_stop();
    if (n % 4096 == 0)
      task.context.report("synchronising",
                          static_cast<double>(n) / static_cast<double>(record.samples()));
    slave.start_interval(n);
    run.status = advance(watched, *stepper, record.time[n + 1], task.parts, run);
    if (run.status != IntegrationStatus::Completed) {
      run.errors.conservativeResize(n + 1);
      run.states.conservativeResize(n + 1, Eigen::NoChange);
      break;
    }
    keep(n + 1);
  }
  return run;
}

}  // namespace

Vector start_of(const SlaveTask& task, const Trajectory& trajectory) {
  if (task.start) return *task.start;
  const Vector given = given_begin(task.model), first = trajectory.states.row(0).transpose();
  return (task.seen.array() > 0.0).select(first, given);
}

SlaveRun run_slave(const SlaveTask& task, const Trajectory& trajectory, const Vector& start) {
  Slave slave(task.model, task.coupling, trajectory, task.window);
  return follow(slave, trajectory, task, start);
}

}  // namespace lacuna
