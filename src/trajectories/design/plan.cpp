// SPDX-License-Identifier: MIT
#include "lacuna/trajectories/design/plan.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "core/base/text.hpp"
#include "design_search.hpp"
#include "lacuna/core/base/error.hpp"
#include "promises.hpp"
#include "safety.hpp"

namespace lacuna {
namespace {

constexpr const char* kHere = "plan_experiment";

void require(bool holds, const std::string& place, const char* problem, const char* remedy) {
  if (!holds) throw ArgumentError(place, problem, remedy);
}

void check_input(const PlanInput& input) {
  const std::string place = "input " + input.name;
  require(std::isfinite(input.low) && std::isfinite(input.high) && input.low < input.high,
          place, "its range is no range of finite numbers", "give the lower end first");
  require(!input.rate || *input.rate > 0.0, place, "its rate limit is not above 0",
          "leave it out where there is none");
  require(!input.hold || *input.hold > 0.0, place, "its hold is not above 0",
          "leave it out for the sampling step");
  require(input.pieces >= 1 && input.pieces <= 200, place, "it has no 1 to 200 pieces",
          "give the number of levels, knots or sines");
}

void check_time(const PlanProblem& problem) {
  constexpr double kMostSamples = 1e6;
  require(problem.duration > 0.0 && std::isfinite(problem.duration), "duration",
          "it is not above 0", "give the time that a run may take");
  require(problem.step > 0.0 && problem.step <= problem.duration, "step",
          "it is not above 0 and at most the duration", "give the time between two samples");
  require(problem.duration / problem.step <= kMostSamples, "step",
          "the run has more than a million samples", "give a larger step or a shorter run");
  require(!problem.measurements || *problem.measurements > 0, "measurements",
          "there is none", "give the number of samples, or leave it out to take all");
}

void check_problem(const PlanProblem& problem) {
  require(!problem.models.empty(), kHere, "there is no model", "give one at least");
  require(!problem.channels.empty(), kHere, "nothing is measured",
          "give a channel with its noise");
  check_time(problem);
  for (const PlanInput& input : problem.inputs) check_input(input);
  for (const PlanChannel& channel : problem.channels)
    require(channel.noise > 0.0 && std::isfinite(channel.noise), "channel " + channel.name,
            "its noise is not above 0", "give the standard deviation of its noise");
  std::set<std::string> names;
  for (const PlanModel& model : problem.models) {
    require(model.weight > 0.0 && std::isfinite(model.weight), model.name,
            "its weight is not above 0", "leave out a model that is impossible");
    require(names.insert(model.name).second, model.name, "two models have this name",
            "give each a name of its own");
    check_flow(model.system.symbolic(), "plan");
    check_no_events(model.system.symbolic(), "plan");
  }
  for (const PlanStart& start : problem.starts)
    require(start.low <= start.high && std::isfinite(start.high - start.low) &&
                start.deviation >= 0.0,
            "start of " + start.state, "its range or deviation is none",
            "give LOW..HIGH, a value, or VALUE +- DEVIATION");
  for (const SafeRange& range : problem.safe)
    require(range.low < range.high, "safe range of " + range.name, "it is upside down",
            "give the lower end first");
}

void check_options(const PlanOptions& options) {
  require(options.runs >= 1 && options.draws >= 1 && options.safety_draws >= 1 &&
              options.candidates >= 1 && options.searches >= 1 && options.evaluations >= 1,
          kHere, "a number of runs, draws, candidates, searches or evaluations is below 1",
          "give 1 at least");
  require(options.spread > 0.0 && options.safe_probability >= 0.0 &&
              options.safe_probability <= 1.0 && std::isfinite(options.decisive),
          kHere, "the spread or a probability is none",
          "give a spread above 0 and a probability from 0 to 1");
}

/// Names of states that no model has.
void check_starts(const PlanProblem& problem, const Rivals& rivals) {
  for (const PlanStart& start : problem.starts) {
    std::vector<std::string> known;
    for (const ModelRun& run : rivals.runs)
      known.insert(known.end(), run.states.begin(), run.states.end());
    require(std::find(known.begin(), known.end(), start.state) != known.end(),
            "start of " + start.state, "no model has such a state",
            suggestion(start.state, known).c_str());
  }
}

/// Steps fine enough for inputs of each space.
void choose_all_steps(const PlanProblem& problem, const std::vector<DesignSpace>& spaces,
                      Rivals& rivals) {
  std::vector<Experiment> experiments;
  for (const DesignSpace& space : spaces) {
    Vector design(design_size(problem, space));
    for (Index i = 0; i < design.size(); ++i) design[i] = i % 2 == 0 ? 0.9 : 0.2;
    experiments.push_back(experiment_of(problem, space, design));
  }
  for (ModelRun& run : rivals.runs) choose_steps(run, experiments);
}

Rivals rivals_of(const PlanProblem& problem, const PlanOptions& options,
                 const RunContext& context) {
  Rivals rivals;
  double sum = 0.0;
  for (const PlanModel& model : problem.models) sum += model.weight;
  for (std::size_t i = 0; i < problem.models.size(); ++i) {
    const PlanModel& model = problem.models[i];
    rivals.runs.push_back(model_run(model, problem));
    const Index p = rivals.runs.back().values.size();
    require(model.information.size() == 0 ||
                (model.information.rows() == p && model.information.cols() == p &&
                 model.information.allFinite()),
            model.name, "its information matrix has not a row and a column for each free number",
            "give information_of() of a fit of this model");
    rivals.knowledge.push_back(knowledge_of(model, options.spread));
    rivals.weights.push_back(model.weight / sum);
    rivals.draws.push_back(draws_of(rivals.runs.back(), rivals.knowledge.back(), options.draws,
                                    context.seed + 104729 * (i + 1)));
  }
  check_starts(problem, rivals);
  return rivals;
}

/// What is the same for all runs of a plan.
struct Planning {
  const PlanProblem& problem;
  const PlanOptions& options;
  ScoreTerms terms;
  std::vector<DesignSpace> spaces;
  std::vector<Index> sizes;
  Index evaluations = 0;  ///< so far
  Index simulations = 0;
  bool in_time = true;  ///< whether all searches so far came to their ends
};

/// Paths and linearisations that one design takes; the latter count as the model with one
/// variational equation for each number.
Index simulations_of(const Rivals& rivals, bool with_pairs, std::size_t scenarios) {
  Index count = 0;
  for (std::size_t i = 0; i < rivals.runs.size(); ++i)
    count += 1 + (with_pairs ? static_cast<Index>(rivals.draws[i].size()) : 0);
  return count + static_cast<Index>(scenarios);
}

/// Draws of which no path may leave the safe ranges: so far those of the expectation.
using Scenarios = std::vector<std::vector<PathNumbers>>;

/// The search for one run, given what earlier ones bring.
std::vector<ScoredDesign> search(Planning& planning, const Rivals& rivals,
                                 const DesignEvidence& earlier, const Scenarios& scenarios,
                                 const std::vector<ScoredDesign>& known,
                                 const RunContext& context) {
  const bool with_pairs = planning.terms.aim != PlanAim::Parameters;
  const PlanProblem& problem = planning.problem;
  std::atomic<Index> evaluations{0};
  const auto make_score = [&]() -> Score {
    return [&, own = rivals](std::size_t space, const Vector& design) mutable {
      ++evaluations;
      const Experiment experiment = experiment_of(problem, planning.spaces[space], design);
      // What leaves the safe ranges is worse than all that does not, the less the farther.
      constexpr double kOutside = -1e9;
      if (!problem.safe.empty())
        if (const double beyond = worst_excess(own, experiment, problem.safe, scenarios);
            beyond > 0.0)
          return kOutside * (1.0 + std::min(beyond, 1e9));
      DesignEvidence evidence = evidence_of(own, experiment, with_pairs);
      if (!evidence.is_finite) return -std::numeric_limits<double>::infinity();
      if (!earlier.models.empty()) evidence += earlier;
      return score_of(planning.terms, own, evidence);
    };
  };
  SearchedDesigns found = best_designs(
      planning.sizes, make_score, known,
      {planning.options.candidates, planning.options.searches, planning.options.evaluations},
      context);
  planning.in_time = planning.in_time && found.in_time;
  planning.evaluations += evaluations;
  std::size_t paths = 0;
  if (!problem.safe.empty())
    for (const auto& own : scenarios) paths += 1 + own.size();
  planning.simulations += evaluations * simulations_of(rivals, with_pairs, paths);
  return std::move(found.best);
}

/// A design with the fraction of draws in which it leaves a safe range.
struct SafeDesign {
  ScoredDesign design;
  double leaves = 0.0;
};

/// For the check of a design and its expected results: a second beyond the deadline, within
/// which a run ends.
RunContext with_grace(RunContext context) {
  constexpr std::chrono::seconds kGrace{1};
  if (context.deadline) *context.deadline += kGrace;
  return context;
}

/// The best design that keeps the safe ranges: searched again with draws that left them, which
/// must not, until few enough do, or the deadline has passed.
SafeDesign safe_search(Planning& planning, const Rivals& rivals, const DesignEvidence& earlier,
                       const RunContext& context) {
  constexpr int kRounds = 6;
  const double allowed = 1.0 - planning.options.safe_probability;
  Scenarios scenarios(rivals.runs.size());
  std::vector<ScoredDesign> known;
  SafeDesign best{{}, 1.0};
  for (int round = 0; round < kRounds; ++round) {
    known = search(planning, rivals, earlier, scenarios, known, context);
    if (planning.problem.safe.empty()) return {known.front(), 0.0};
    context.unhurried().report("checking the safe ranges", 0.8);
    const Experiment experiment =
        experiment_of(planning.problem, planning.spaces[known.front().space],
                      known.front().design);
    const SafetyCheck check =
        check_safety(rivals, experiment, planning.problem.safe, planning.options.safety_draws,
                     allowed, with_grace(context));
    planning.simulations +=
        static_cast<Index>(rivals.runs.size()) * planning.options.safety_draws;
    if (round == 0 || check.leaves < best.leaves) best = {known.front(), check.leaves};
    if (check.leaves <= allowed || !planning.in_time) return best;
    for (std::size_t i = 0; i < scenarios.size(); ++i)
      scenarios[i].insert(scenarios[i].end(), check.offending[i].begin(),
                          check.offending[i].end());
  }
  return best;
}

/// The experiments that were made, for as long as the planned ones.
DesignEvidence evidence_of_made(const PlanProblem& problem, int runs, Rivals& rivals,
                          bool with_pairs) {
  DesignEvidence made;
  double duration = 0.0;
  for (const Experiment& experiment : problem.made) {
    made += evidence_of(rivals, experiment, with_pairs);
    duration += experiment.time[experiment.time.size() - 1];
  }
  if (problem.made.empty() || !made.is_finite) return {};
  return repeated(std::move(made), runs * problem.duration / duration);
}

/// The search for the next run, which the stages of the plan have then; nothing where the
/// deadline has left it out. @throws OutOfTime where that leaves no run.
std::optional<SafeDesign> next_design(Planning& planning, const Rivals& rivals,
                                      const DesignEvidence& earlier, const RunContext& context,
                                      Plan& plan) {
  const std::string name = "designs of run " + std::to_string(plan.stages.size() + 1);
  std::optional<SafeDesign> best;
  run_stage(plan.stages, name.c_str(), [&] {
    if (!planning.in_time) throw OutOfTime();
    best = safe_search(planning, rivals, earlier, context);
  });
  if (!best && plan.runs.empty()) throw OutOfTime();
  if (!planning.in_time) plan.stages.back() = {name, false, kTimeIsUp};
  return best;
}

/// What the runs of a plan are expected to bring.
void add_promises(const Planning& planning, Rivals& rivals,
                  const std::vector<Experiment>& experiments, Expected& expected,
                  const RunContext& context, Plan& plan) {
  const PlanProblem& problem = planning.problem;
  context.report("expected results", 0.9);
  const bool with_pairs = rivals.runs.size() > 1;
  expected.made =
      evidence_of_made(problem, static_cast<int>(plan.runs.size()), rivals, with_pairs);
  if (with_pairs)
    plan.pairs = pair_promises(problem, rivals, expected, experiments,
                               planning.options.decisive, context);
  plan.parameters = parameter_promises(problem, rivals, expected, experiments, context);
  plan.time_saved = time_saved(planning.terms, rivals, expected);
}

void check_made(const PlanProblem& problem) {
  for (const Experiment& made : problem.made) {
    const Index n = made.time.size();
    bool rises = n >= 2;
    for (Index i = 1; i < n; ++i) rises = rises && made.time[i] > made.time[i - 1];
    require(rises && made.time.allFinite() && made.inputs.rows() == n &&
                made.inputs.cols() == static_cast<Index>(problem.inputs.size()) &&
                made.measured.rows() == n &&
                made.measured.cols() == static_cast<Index>(problem.channels.size()) &&
                made.inputs.allFinite(),
            "experiments that were made", "one does not have the shape of the problem",
            "make them by experiments_of()");
  }
}

/// A design in steps of a converter of 20 bits, about: with fewer digits the same.
Vector rounded(const Vector& design) {
  constexpr double kSteps = 1e6;
  return (design * kSteps).array().round() / kSteps;
}

}  // namespace

Plan plan_experiment(const PlanProblem& problem, const PlanOptions& options,
                     const RunContext& context) {
  check_problem(problem);
  check_options(options);
  check_made(problem);
  Rivals rivals = rivals_of(problem, options, context);
  Planning planning{problem, options, score_terms(problem, options, rivals),
                    design_spaces(problem), {}};
  for (const DesignSpace& space : planning.spaces)
    planning.sizes.push_back(design_size(problem, space));
  choose_all_steps(problem, planning.spaces, rivals);
  const bool with_pairs = rivals.runs.size() > 1;
  Plan plan;
  Expected expected;
  std::vector<Experiment> experiments;
  for (int r = 0; r < options.runs; ++r) {
    RunContext own = context;
    own.seed = context.seed + static_cast<std::uint64_t>(r);
    std::optional<SafeDesign> best = next_design(planning, rivals, expected.planned, own, plan);
    if (!best) continue;
    const DesignSpace& space = planning.spaces[best->design.space];
    best->design.design = rounded(best->design.design);
    experiments.push_back(experiment_of(problem, space, best->design.design));
    expected.planned += evidence_of(rivals, experiments.back(), with_pairs);
    plan.runs.push_back({experiments.back(), space.families,
                         responses_in(problem, rivals, experiments.back(), own.seed),
                         best->leaves});
  }
  if (!expected.planned.is_finite)
    throw ArgumentError(kHere, "no model has a path that stays finite in any design",
                        "narrow the ranges of the inputs or the time of a run");
  add_promises(planning, rivals, experiments, expected, with_grace(context), plan);
  plan.evaluations = planning.evaluations;
  plan.simulations = planning.simulations;
  judge(plan, planning.terms, options);
  return plan;
}

}  // namespace lacuna
