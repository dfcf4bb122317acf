// SPDX-License-Identifier: MIT
#include "promises.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "core/base/parallel.hpp"
#include "core/base/text.hpp"
#include "precision.hpp"
#include "refit.hpp"

namespace lacuna {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

std::optional<double> known_error(double error) {
  return std::isfinite(error) ? std::optional(error) : std::nullopt;
}

std::string unit_of(const SystemModel& system, const std::string& name) {
  for (const Parameter& parameter : system.parameters())
    if (parameter.name == name) return parameter.unit;
  return "";
}

std::string unit_of_channel(const SystemModel& system, const std::string& name) {
  for (const Output& output : system.symbolic().outputs())
    if (output.name == name) return output.unit;
  for (const Quantity& state : system.symbolic().states())
    if (state.name == name) return state.unit;
  return "";
}

/// The values of a row of draws that 2.5 % are below and above.
std::pair<double, double> middle_95(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const double last = static_cast<double>(values.size() - 1);
  const auto low = static_cast<std::size_t>(std::floor(0.025 * last));
  const auto high = static_cast<std::size_t>(std::ceil(0.975 * last));
  return {values[low], values[high]};
}

std::string pair_reason(const PairPromise& pair) {
  return "where " + pair.truth + " is right, " + pair.rival +
         " stays possible: refitted, it is " + format_number(pair.sigma, 2) +
         " sigma away (log Bayes factor " + format_number(pair.log_bayes_factor, 2) +
         " expected)";
}

void judge_pairs(Plan& plan) {
  constexpr double kMoreOftenThanNot = 0.5;
  bool any = false;
  for (const PairPromise& pair : plan.pairs) {
    if (pair.power >= kMoreOftenThanNot)
      any = true;
    else
      plan.reasons.push_back(pair_reason(pair));
  }
  if (any) return;
  plan.is_feasible = false;
  plan.reasons.push_back(
      "nothing can be distinguished with these inputs: widen their ranges, measure longer or "
      "more, or with less noise");
}

/// Standard errors after experiments where the numbers are those of a draw.
Vector errors_of_draw(ModelRun& run, const Matrix& known,
                      const std::vector<Experiment>& experiments, const PathNumbers& draw) {
  Matrix added = Matrix::Zero(known.rows(), known.cols());
  for (const Experiment& experiment : experiments) {
    load(run, experiment);
    const LinearPrediction linear =
        linearise(run, experiment, in_experiment(run, experiment, draw));
    if (!linear.is_finite) return Vector::Constant(known.rows(), kNone);
    added += model_evidence(linear).information;
  }
  return errors_after({known, added}, sizes_of(run.values));
}

/// Standard errors after experiments, root mean squares over the draws that determine a number.
/// @param at_estimates those where the numbers are the estimates.
Vector expected_errors(const Rivals& rivals, std::size_t model,
                       const std::vector<Experiment>& experiments, const Vector& at_estimates,
                       const RunContext& context) {
  const std::vector<PathNumbers>& draws = rivals.draws[model];
  std::vector<Vector> errors(draws.size());
  parallel_for(draws.size(), context.threads, [&](std::size_t k) {
    context.check_stop();
    ModelRun run = rivals.runs[model];
    errors[k] =
        errors_of_draw(run, rivals.knowledge[model].information, experiments, draws[k]);
  });
  Vector variances = at_estimates.cwiseAbs2(), counts = Vector::Ones(variances.size());
  for (const Vector& one : errors)
    for (Index p = 0; p < variances.size(); ++p)
      if (std::isfinite(one[p])) {
        variances[p] += one[p] * one[p];
        ++counts[p];
      }
  return variances.cwiseQuotient(counts).cwiseSqrt();
}

void judge_parameters(Plan& plan, const PlanOptions& options) {
  // A standard error that stays above this fraction of what it was is not narrowed.
  constexpr double kNarrowed = 0.95;
  bool any = false;
  for (const ParameterPromise& number : plan.parameters) {
    const auto& wanted = options.parameters;
    if (!wanted.empty() && std::find(wanted.begin(), wanted.end(), number.name) == wanted.end())
      continue;
    if (!number.after)
      plan.reasons.push_back(number.name + " of " + number.model +
                             " stays undetermined: nothing that is measured depends on it, or "
                             "only on its combination with others");
    else if (!number.before || *number.after < kNarrowed * *number.before)
      any = true;
  }
  if (any) return;
  plan.is_feasible = false;
  plan.reasons.push_back("no interval becomes narrower with these inputs and channels");
}

}  // namespace

std::vector<PairPromise> pair_promises(const PlanProblem& problem, const Rivals& rivals,
                                       const Expected& expected,
                                       const std::vector<Experiment>& experiments,
                                       double decisive, const RunContext& context) {
  const std::size_t count = rivals.runs.size();
  std::vector<PairPromise> pairs;
  std::vector<std::pair<std::size_t, std::size_t>> places;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = 0; j < count; ++j)
      if (i != j) places.emplace_back(i, j);
  pairs.resize(places.size());
  parallel_for(places.size(), context.threads, [&](std::size_t p) {
    context.check_stop();
    const auto [i, j] = places[p];
    Rivals own = rivals;
    const Vector squares = refitted_squares(own, experiments, i, j);
    const Distinction found =
        distinction_of(rivals, expected.planned, i, j, decisive, squares);
    pairs[p] = {problem.models[i].name, problem.models[j].name, found.log_bayes_factor,
                std::sqrt(std::max(found.distance, 0.0)), found.power, kNone};
    if (!expected.made.models.empty())
      pairs[p].repeated =
          distinction_of(rivals, expected.made, i, j, decisive).log_bayes_factor;
  });
  return pairs;
}

std::vector<ParameterPromise> parameter_promises(const PlanProblem& problem,
                                                 const Rivals& rivals, const Expected& expected,
                                                 const std::vector<Experiment>& experiments,
                                                 const RunContext& context) {
  std::vector<ParameterPromise> promises;
  for (std::size_t i = 0; i < rivals.runs.size(); ++i) {
    const ModelRun& run = rivals.runs[i];
    const Vector size = sizes_of(run.values);
    const Matrix& known = rivals.knowledge[i].information;
    const Vector before = standard_errors(known, size);
    const Vector after = expected_errors(
        rivals, i, experiments,
        errors_after({known, expected.planned.models[i].information}, size), context);
    Vector repeated = Vector::Constant(size.size(), kNone);
    if (!expected.made.models.empty())
      repeated = errors_after({known, expected.made.models[i].information}, size);
    const std::vector<std::string> names = run.engine.model.names();
    for (Index p = 0; p < size.size(); ++p) {
      const std::string& name = names[static_cast<std::size_t>(p)];
      promises.push_back({problem.models[i].name, name, unit_of(problem.models[i].system, name),
                          run.values[p], known_error(before[p]), known_error(after[p]),
                          known_error(repeated[p])});
    }
  }
  return promises;
}

void judge(Plan& plan, const ScoreTerms& terms, const PlanOptions& options) {
  if (terms.aim == PlanAim::Parameters)
    judge_parameters(plan, options);
  else
    judge_pairs(plan);
  const double allowed = 1.0 - options.safe_probability;
  for (const PlannedRun& run : plan.runs)
    if (run.leaves > allowed) {
      plan.is_feasible = false;
      plan.reasons.push_back("no input was found that keeps the safe ranges: with the best one "
                             "they are left in " +
                             format_number(100.0 * run.leaves, 3) + " % of the draws, " +
                             format_number(100.0 * allowed, 3) + " % are allowed");
    }
}

std::optional<double> time_saved(const ScoreTerms& terms, const Rivals& rivals,
                                 const Expected& expected) {
  if (expected.made.models.empty()) return std::nullopt;
  constexpr double kMost = 1e4;
  constexpr int kHalvings = 40;
  const double wanted = score_of(terms, rivals, expected.planned);
  double low = std::log(1e-3), high = std::log(kMost);
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    const bool enough =
        score_of(terms, rivals, repeated(expected.made, std::exp(middle))) >= wanted;
    (enough ? high : low) = middle;
  }
  return std::exp(high);
}

std::vector<PredictedResponse> responses_in(const PlanProblem& problem, const Rivals& rivals,
                                            const Experiment& experiment, std::uint64_t seed) {
  constexpr int kDraws = 40;  // the outermost of them is the end of the band
  std::vector<PredictedResponse> responses;
  for (std::size_t i = 0; i < rivals.runs.size(); ++i) {
    ModelRun run = rivals.runs[i];
    load(run, experiment);
    std::vector<Matrix> drawn;
    for (const PathNumbers& draw : draws_of(run, rivals.knowledge[i], kDraws, seed)) {
      Prediction one = predict(run, experiment, in_experiment(run, experiment, draw));
      if (one.is_finite) drawn.push_back(std::move(one.channels));
    }
    const Matrix mean = predict(run, experiment, {run.values, {}}).channels;
    drawn.push_back(mean);
    for (Index c = 0; c < mean.cols(); ++c) {
      const std::string& name = problem.channels[static_cast<std::size_t>(c)].name;
      PredictedResponse response{problem.models[i].name, name,
                                 unit_of_channel(problem.models[i].system, name), mean.col(c),
                                 Vector(mean.rows()), Vector(mean.rows())};
      for (Index n = 0; n < mean.rows(); ++n) {
        std::vector<double> values;
        for (const Matrix& one : drawn) values.push_back(one(n, c));
        std::tie(response.low[n], response.high[n]) = middle_95(std::move(values));
      }
      responses.push_back(std::move(response));
    }
  }
  return responses;
}

}  // namespace lacuna
