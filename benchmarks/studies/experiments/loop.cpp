// SPDX-License-Identifier: MIT
#include "loop.hpp"

#include <Eigen/LU>
#include <chrono>
#include <cmath>
#include <optional>

#include "core/base/random.hpp"
#include "core/base/text.hpp"
#include "lacuna/core/statistics/interval.hpp"
#include "lacuna/data/derivatives/differentiators.hpp"
#include "lacuna/model/files/model_file.hpp"
#include "lacuna/records/binding/model_view.hpp"
#include "lacuna/trajectories/fit/fit.hpp"
#include "trajectories/design/input_signals.hpp"
#include "trajectories/design/refit.hpp"

namespace lacuna::benchmarks {
namespace {

constexpr double kNoise = 0.01;     // of the deviation where the input takes its whole range
constexpr double kOff = 0.2;        // of true parameters, their logarithm
constexpr double kUnknown = 1e-6;   // noise that choose_steps() goes by before it is known

/// A model's text with a number in the place of "@".
std::string starting_at(std::string text, double rest) {
  for (std::size_t at; (at = text.find('@')) != std::string::npos;)
    text.replace(at, 1, format_number(rest));
  return text;
}

PlanProblem problem_of(const RivalCase& rivals, double rest, double noise) {
  PlanProblem problem;
  for (std::size_t i = 0; i < rivals.models.size(); ++i)
    problem.models.push_back({"m" + std::to_string(i + 1),
                              parse_ode_system(starting_at(rivals.models[i], rest),
                                               rivals.name)});
  problem.inputs = {{"u", rivals.low, rivals.high, {}, 4.0 * rivals.step, {}, 8}};
  problem.channels = {{"y", noise}};
  problem.duration = rivals.duration;
  problem.step = rivals.step;
  return problem;
}

/// An experiment of a family, its numbers as given.
Experiment experiment_with(PlanProblem problem, InputFamily family, const Vector& design) {
  problem.inputs[0].families = {family};
  return experiment_of(problem, {{family}}, design);
}

/// The right model with its true parameters.
struct Plant {
  std::optional<ModelRun> run;
  Vector parameters;
};

/// @param off logarithms of the true parameters over those of the model.
Plant plant_of(const PlanProblem& problem, std::size_t right, const Vector& off) {
  Plant plant{model_run(problem.models[right], problem), {}};
  plant.parameters = plant.run->values.array() * off.array().exp();
  return plant;
}

Vector measure(Plant& plant, const Experiment& experiment) {
  choose_steps(*plant.run, {experiment});
  load(*plant.run, experiment);
  return predict(*plant.run, experiment, {plant.parameters, {}}).channels.col(0);
}

/// A record of everyday: a few small steps about the working point.
Experiment old_experiment(PlanProblem problem) {
  const Vector levels{{0.5, 0.55, 0.45, 0.5}};
  problem.inputs[0].pieces = static_cast<int>(levels.size());
  return experiment_with(problem, InputFamily::Steps, levels);
}

/// y where the middle of u's range has held the plant for long.
double value_at_rest(PlanProblem problem, std::size_t right, const Vector& off) {
  constexpr double kLong = 40.0;  // durations
  problem.duration *= kLong;
  problem.inputs[0].pieces = 1;
  Plant plant = plant_of(problem, right, off);
  const Experiment held = experiment_with(problem, InputFamily::Steps, Vector{{0.5}});
  const Vector y = measure(plant, held);
  return y[y.size() - 1];
}

double least_power(const Plan& plan) {
  double least = 1.0;
  for (const PairPromise& pair : plan.pairs) least = std::min(least, pair.power);
  return least;
}

/// A plan with the problem that it is for.
struct BudgetedPlan {
  PlanProblem problem;
  Plan plan;
};

/// The plan of the shortest run that decides with the probability that is asked for, else of
/// the longest: durations in equal ratios, of which longer ones do more.
BudgetedPlan cheapest_plan(const PlanProblem& problem, const RunContext& context) {
  constexpr double kRatio = 0.8, kPower = 0.95, kFewest = 20.0;  // samples
  const auto with_ratios = [&](int count) {
    BudgetedPlan made{problem, {}};
    made.problem.duration =
        problem.step *
        std::round(std::pow(kRatio, count) * problem.duration / problem.step);
    made.plan = plan_experiment(made.problem, {}, context);
    return made;
  };
  int enough = 0, shortest = static_cast<int>(std::log(kFewest * problem.step /
                                                       problem.duration) /
                                              std::log(kRatio));
  BudgetedPlan best = with_ratios(0);
  if (!(least_power(best.plan) > kPower)) return best;
  while (enough < shortest) {
    const int middle = (enough + shortest + 1) / 2;
    BudgetedPlan tried = with_ratios(middle);
    if (!(least_power(tried.plan) > kPower)) {
      shortest = middle - 1;
      continue;
    }
    enough = middle;
    best = std::move(tried);
  }
  return best;
}

/// Steps over the whole range: what the sensor is chosen for.
Experiment whole_range(const PlanProblem& problem) {
  Vector levels(problem.inputs[0].pieces);
  for (Index i = 0; i < levels.size(); ++i) levels[i] = i % 2 == 0 ? 0.0 : 1.0;
  return experiment_with(problem, InputFamily::Steps, levels);
}

Dataset dataset_of(const Experiment& experiment, const Vector& y) {
  Dataset data;
  data.states = {{"y", ""}};
  data.inputs = {{"u", "", Hold::Zero}};
  data.trajectories = {{"record", experiment.time, y, experiment.inputs, Matrix()}};
  return data;
}

Vector with_noise(Vector values, double noise, Random& random) {
  for (double& value : values) value += noise * random.normal();
  return values;
}

/// The least advantage of the right model.
double margin_of(const std::vector<double>& log_evidences, std::size_t right) {
  double margin = INFINITY;
  for (std::size_t j = 0; j < log_evidences.size(); ++j)
    if (j != right) margin = std::min(margin, log_evidences[right] - log_evidences[j]);
  return margin;
}

/// The models fitted to the old record; logs of their probability, -BIC / 2.
std::vector<double> fit_old(const Dataset& columns, PlanProblem& problem) {
  std::vector<NamedFit> fits;
  for (PlanModel& model : problem.models) {
    const Dataset view = model_view(model.system.model(), columns, finite_differences());
    fits.push_back({model.name, fit(model.system, view, {})});
    model.system = fits.back().fit.model;
    model.information = information_of(fits.back().fit, view);
  }
  std::vector<double> logs(fits.size());
  for (const FitRival& rival : compare_fits(fits).rivals)
    for (std::size_t i = 0; i < fits.size(); ++i)
      if (fits[i].name == rival.name) logs[i] = -0.5 * rival.bic;
  return logs;
}

std::vector<Experiment> standard_experiments(const PlanProblem& problem, Random& random) {
  Vector steps(problem.inputs[0].pieces), prbs(4),
      sines(2 + 2 * Index{problem.inputs[0].pieces});
  for (double& value : steps) value = random.uniform();
  prbs << 0.0, 1.0, 0.5, random.uniform();
  for (double& value : sines) value = random.uniform();
  sines[0] = 0.5;
  sines[1] = 1.0;
  for (Index k = 2; k < sines.size(); k += 2) sines[k] = 1.0;
  return {experiment_with(problem, InputFamily::Steps, steps),
          experiment_with(problem, InputFamily::Prbs, prbs),
          experiment_with(problem, InputFamily::Multisine, sines)};
}

/// The old experiment again, for as long as a planned one.
Experiment first_part(Experiment experiment, double duration) {
  constexpr double kRounding = 1e-9;
  const auto n = static_cast<Index>(
      (experiment.time.array() <= duration * (1.0 + kRounding)).count());
  experiment.time.conservativeResize(n);
  experiment.inputs.conservativeResize(n, Eigen::NoChange);
  experiment.measured.conservativeResize(n, Eigen::NoChange);
  return experiment;
}

/// Widths and coverage of the intervals of the right model's numbers.
void compare_intervals(const Plan& plan, const PlanModel& model, const Refit& refitted,
                       const Matrix& known, const Vector& truth, LoopOutcome& outcome) {
  const Matrix covariance = (known + refitted.information).inverse();
  Index p = 0;
  for (const ParameterPromise& promise : plan.parameters) {
    if (promise.model != model.name) continue;
    if (promise.after) {
      outcome.widths.push_back(std::sqrt(covariance(p, p)) / *promise.after);
      ++outcome.intervals;
      outcome.covered += std::abs(refitted.parameters[p] - truth[p]) <=
                                 kNormalQuantile975 * *promise.after
                             ? 1
                             : 0;
    }
    ++p;
  }
}

/// A plant with its old record, and models fitted to that.
struct Bench {
  PlanProblem problem;
  std::size_t right = 0;
  Plant plant;
  Experiment old;
  double noise = 0.0;
  std::vector<double> log_evidences;  ///< of the models, from the old record
};

Bench bench_of(const RivalCase& rivals, std::uint64_t draw, Random& random) {
  Bench bench;
  bench.right = draw % rivals.models.size();
  bench.problem = problem_of(rivals, 1.0, kUnknown);
  Vector off(model_run(bench.problem.models[bench.right], bench.problem).values.size());
  for (double& value : off) value = kOff * random.uniform(-1.0, 1.0);
  const double rest = value_at_rest(bench.problem, bench.right, off);
  bench.problem = problem_of(rivals, rest, kUnknown);
  bench.plant = plant_of(bench.problem, bench.right, off);
  bench.old = old_experiment(bench.problem);
  const Vector clean = measure(bench.plant, bench.old);
  const Vector whole = measure(bench.plant, whole_range(bench.problem));
  bench.noise = kNoise * std::sqrt((whole.array() - whole.mean()).square().mean());
  bench.log_evidences = fit_old(
      dataset_of(bench.old, with_noise(clean, bench.noise, random)), bench.problem);
  bench.problem.channels[0].noise = bench.noise;
  return bench;
}

/// Log evidences of the models for a new record alone.
std::vector<double> evidences_of(const PlanProblem& problem, const Experiment& experiment,
                                 const Vector& values) {
  std::vector<double> logs;
  for (const PlanModel& model : problem.models) {
    ModelRun run = model_run(model, problem);
    choose_steps(run, {experiment});
    const Knowledge known = knowledge_of(model, PlanOptions{}.spread);
    logs.push_back(log_evidence(run, known, {experiment}, {values}));
  }
  return logs;
}

double promised_for(const Plan& plan, const std::string& right) {
  double least = INFINITY;
  for (const PairPromise& pair : plan.pairs)
    if (pair.truth == right) least = std::min(least, pair.log_bayes_factor);
  return least;
}

/// The planned run, measured: what it does, against what was promised.
void compare_promises(const Plan& plan, const PlanProblem& problem, const Bench& bench,
                      const Vector& values, const std::vector<double>& logs,
                      LoopOutcome& outcome) {
  const PlanModel& model = problem.models[bench.right];
  const Experiment& planned = plan.runs.at(0).experiment;
  outcome.promised = promised_for(plan, model.name);
  outcome.obtained = margin_of(logs, bench.right);
  ModelRun run = model_run(model, problem);
  choose_steps(run, {planned});
  const Knowledge known = knowledge_of(model, PlanOptions{}.spread);
  compare_intervals(plan, model, refit(run, known, {planned}, {values}), known.information,
                    bench.plant.parameters, outcome);
}

}  // namespace

LoopOutcome go_round(const RivalCase& rivals, std::uint64_t draw) {
  Random random(draw * 7919 + 17);
  Bench bench = bench_of(rivals, draw, random);
  LoopOutcome outcome;
  outcome.old_margin = margin_of(bench.log_evidences, bench.right);
  RunContext context;
  context.seed = draw + 1;
  const auto begin = std::chrono::steady_clock::now();
  const auto [problem, plan] = cheapest_plan(bench.problem, context);
  outcome.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  std::vector<Experiment> experiments = standard_experiments(problem, random);
  experiments.insert(experiments.begin(), plan.runs.at(0).experiment);
  experiments.push_back(first_part(bench.old, problem.duration));
  for (std::size_t e = 0; e < experiments.size(); ++e) {
    const Vector values =
        with_noise(measure(bench.plant, experiments[e]), bench.noise, random) / bench.noise;
    std::vector<double> logs = evidences_of(problem, experiments[e], values);
    if (e == 0) compare_promises(plan, problem, bench, values, logs, outcome);
    for (std::size_t i = 0; i < logs.size(); ++i) logs[i] += bench.log_evidences[i];
    outcome.margins.push_back(margin_of(logs, bench.right));
  }
  return outcome;
}

}  // namespace lacuna::benchmarks
