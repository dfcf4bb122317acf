// SPDX-License-Identifier: MIT
#include "model_run.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/text.hpp"
#include "lacuna/core/base/error.hpp"
#include "trajectories/fit/fit_solver.hpp"

namespace lacuna {
namespace {

/// The formula of an output, or of a state.
Expression formula_of(const PlanModel& model, const std::string& name, const char* what) {
  const OdeModel& symbolic = model.system.symbolic();
  std::vector<std::string> known;
  for (const Output& output : symbolic.outputs()) {
    if (output.name == name) return output.formula;
    known.push_back(output.name);
  }
  for (const Quantity& state : symbolic.states()) {
    if (state.name == name) return Expression::variable(name);
    known.push_back(state.name);
  }
  throw ArgumentError(std::string(what) + " " + name,
                      model.name + " has no such output or state", suggestion(name, known));
}

/// The formulas in what the parametrised model calls free: fixed parameters become numbers.
Expression with_fixed_numbers(const SystemModel& system, const Expression& formula) {
  std::map<std::string, Expression> numbers;
  for (const Parameter& parameter : system.parameters())
    if (!parameter.free) numbers.emplace(parameter.name, Expression::number(parameter.value));
  return substitute(formula, numbers);
}

std::vector<Index> inputs_of(const PlanModel& model, const ParametrisedModel& parametrised,
                             const PlanProblem& problem) {
  std::vector<Index> columns;
  for (Index i = 0; i < parametrised.record_inputs(); ++i) {
    const std::string& name = parametrised.symbolic().inputs()[std::size_t(i)].name;
    const auto found = std::find_if(problem.inputs.begin(), problem.inputs.end(),
                                    [&](const PlanInput& input) { return input.name == name; });
    if (found == problem.inputs.end())
      throw ArgumentError("input " + name, model.name + " has it, and nothing is known of it",
                          "say what may be done with it: its range at least");
    columns.push_back(found - problem.inputs.begin());
  }
  return columns;
}

/// A record of no values for one experiment; its channels are those of the problem.
FitRecords records_of(const PlanModel& model, const ParametrisedModel& parametrised,
                      const PlanProblem& problem) {
  FitRecords records;
  const OdeModel& symbolic = parametrised.symbolic();
  constexpr Index kFewest = 2;
  records.series.time = Vector::LinSpaced(kFewest, 0.0, problem.step);
  records.series.begins = {0, kFewest};
  records.series.rows.resize(static_cast<std::size_t>(symbolic.dimension()));
  records.series.inputs = Matrix::Zero(kFewest, parametrised.record_inputs());
  records.series.holds.assign(static_cast<std::size_t>(parametrised.record_inputs()),
                              Interpolation::Held);
  records.sources = {"plan"};
  for (const PlanChannel& channel : problem.channels)
    records.channels.push_back(
        {channel.name, "",
         with_fixed_numbers(model.system, formula_of(model, channel.name, "channel")),
         channel.noise, 0.0});
  const auto count = static_cast<Index>(problem.channels.size());
  records.values = Matrix::Zero(kFewest, count);
  records.valid = Matrix::Ones(kFewest, count);
  records.starts = Matrix::Zero(1, symbolic.dimension());
  records.scale = Vector::Zero(symbolic.dimension());
  return records;
}

std::vector<Expression> safe_formulas(const PlanModel& model, const PlanProblem& problem) {
  std::vector<Expression> formulas;
  for (const SafeRange& range : problem.safe)
    formulas.push_back(
        with_fixed_numbers(model.system, formula_of(model, range.name, "safe range")));
  return formulas;
}

void refuse_delayed_states(const PlanModel& model, const Rates& rates) {
  for (const DelayedVariable& delay : rates.delays())
    if (delay.slot < rates.dimension())
      throw ModelError(model.name, "an equation has a delayed state",
                       "plan with a model that delays inputs only");
}

FitPoint point_of(const ModelRun& run, const Experiment& experiment,
                  const PathNumbers& numbers) {
  const Vector starts = numbers.starts.size() > 0 ? numbers.starts : starts_in(run, experiment);
  return {numbers.parameters.transpose(), starts.transpose()};
}

/// Of n x channels those that are measured, in units of their noise, time by time.
Vector taken(const Matrix& channels, const Experiment& experiment, const Vector& sigma) {
  Vector values(static_cast<Index>((experiment.measured.array() > 0.0).count()));
  Index next = 0;
  for (Index n = 0; n < channels.rows(); ++n)
    for (Index c = 0; c < channels.cols(); ++c)
      if (experiment.measured(n, c) > 0.0) values[next++] = channels(n, c) / sigma[c];
  return values;
}

Matrix safe_values(ModelRun& run, const FitPath& path) {
  Matrix values(path.states.rows(), run.safe.count());
  if (values.cols() == 0) return values;
  std::vector<double> slots(static_cast<std::size_t>(run.engine.rates.slots()));
  Vector one(run.safe.count());
  const Index substeps = run.engine.signals.scheme.substeps;
  for (Index n = 0; n < values.rows(); ++n) {
    const Vector x = path.states.row(n).transpose();
    std::copy(x.begin(), x.end(), slots.begin());
    run.engine.rates.fill_signals(run.engine.signals.stages[0].data() + n * substeps,
                                  run.engine.signals.lengths.size(), slots.data());
    run.safe.values(slots.data(), one.data());
    values.row(n) = one.transpose();
  }
  return values;
}

Matrix channels_along(ModelRun& run, const Experiment& experiment, Index substeps) {
  if (run.engine.signals.scheme.substeps != substeps) set_substeps(run.engine, substeps);
  const FitPath path = follow(run.engine, point_of(run, experiment, {run.values, {}}), {});
  return path.residuals * run.engine.sigma.cwiseInverse().asDiagonal();
}

}  // namespace

ModelRun model_run(const PlanModel& model, const PlanProblem& problem) {
  const ParametrisedModel parametrised = model.system.parametrised();
  const FitUnknowns unknowns = fit_unknowns(parametrised, {});
  const OdeModel& symbolic = parametrised.symbolic();
  refuse_delayed_states(model, Rates(parametrised));
  std::vector<Index> inputs = inputs_of(model, parametrised, problem);
  ModelRun run{fit_engine(parametrised, records_of(model, parametrised, problem)),
               std::move(inputs),
               names_of(symbolic.states()),
               Vector::Zero(symbolic.dimension()),
               Vector::Zero(symbolic.dimension()),
               Channels(parametrised, safe_formulas(model, problem)),
               parametrised.values(),
               unknowns.lower,
               unknowns.upper};
  for (Index k = 0; k < run.starts.size(); ++k) {
    const auto& initial = symbolic.initial()[static_cast<std::size_t>(k)];
    if (!initial) continue;
    run.starts[k] = initial->value;
    run.deviations[k] = initial->fixed ? 0.0 : initial->deviation.value_or(0.0);
  }
  for (const PlanStart& start : problem.starts)
    for (Index k = 0; k < run.starts.size(); ++k)
      if (run.states[static_cast<std::size_t>(k)] == start.state)
        run.deviations[k] = start.deviation;
  return run;
}

Vector starts_in(const ModelRun& run, const Experiment& experiment) {
  Vector starts = run.starts;
  for (const PlanStart& start : experiment.starts)
    for (Index k = 0; k < starts.size(); ++k)
      if (run.states[static_cast<std::size_t>(k)] == start.state) starts[k] = start.low;
  return starts;
}

void load(ModelRun& run, const Experiment& experiment) {
  FitRecords& records = run.engine.records;
  const Index n = experiment.time.size();
  records.series.time = experiment.time;
  records.series.begins = {0, n};
  records.series.inputs = experiment.inputs(Eigen::all, run.inputs);
  records.values = Matrix::Zero(n, run.engine.count());
  records.valid = Matrix::Ones(n, run.engine.count());
  run.engine.signals =
      stage_signals(records.series, run.engine.rates, run.engine.signals.scheme);
  if (!run.engine.implicit) return;
  run.engine.implicit->signals.clear();
  for (const DrivingSamples& samples : driving_samples(records.series, run.engine.rates))
    run.engine.implicit->signals.emplace_back(samples);
}

void choose_steps(ModelRun& run, const std::vector<Experiment>& experiments) {
  constexpr double kUnnoticed = 0.1;  // of the noise of a sample
  for (const Experiment& experiment : experiments) {
    load(run, experiment);
    if (run.engine.implicit) return;
    Index substeps = run.engine.signals.scheme.substeps;
    Matrix coarse = channels_along(run, experiment, substeps);
    while (substeps < kMostSubsteps) {
      Matrix fine = channels_along(run, experiment, 2 * substeps);
      const double change = (fine - coarse).cwiseAbs().maxCoeff();
      if (std::isfinite(change) && change < kUnnoticed) break;
      substeps *= 2;
      coarse = std::move(fine);
    }
    set_substeps(run.engine, substeps);
    choose_method(run.engine, point_of(run, experiment, {run.values, {}}));
  }
}

Prediction predict(ModelRun& run, const Experiment& experiment, const PathNumbers& numbers) {
  const FitPath path = follow(run.engine, point_of(run, experiment, numbers), {});
  Prediction prediction;
  prediction.is_finite = std::isfinite(path.cost);
  prediction.channels = -path.residuals;
  prediction.values = taken(prediction.channels, experiment, run.engine.sigma);
  prediction.safe = safe_values(run, path);
  return prediction;
}

LinearPrediction linearise(ModelRun& run, const Experiment& experiment,
                        const PathNumbers& numbers) {
  const FitPoint point = point_of(run, experiment, numbers);
  const FitPath path = follow(run.engine, point, {});
  LinearPrediction linear;
  linear.values = taken(-path.residuals, experiment, run.engine.sigma);
  linear.is_finite = std::isfinite(path.cost);
  const Index m = run.engine.states(), p = run.engine.parameters();
  std::vector<Index> uncertain;
  for (Index k = 0; k < m; ++k)
    if (run.deviations[k] > 0.0) uncertain.push_back(k);
  linear.by_start = Matrix::Zero(linear.values.size(), static_cast<Index>(uncertain.size()));
  linear.by_parameter = Matrix::Zero(linear.values.size(), p);
  if (!linear.is_finite) return linear;
  Index next = 0;
  const auto visit = [&](Index n, const Matrix& rows, const Vector&) {
    for (Index c = 0; c < rows.rows(); ++c) {
      if (!(experiment.measured(n, c) > 0.0)) continue;
      for (std::size_t u = 0; u < uncertain.size(); ++u)
        linear.by_start(next, static_cast<Index>(u)) =
            rows(c, uncertain[u]) * run.deviations[uncertain[u]];
      linear.by_parameter.row(next++) = rows.rightCols(p).row(c);
    }
  };
  sensitivities(run.engine, point, path, {}, 0, visit);
  linear.is_finite = linear.by_parameter.allFinite() && linear.by_start.allFinite();
  return linear;
}

}  // namespace lacuna
