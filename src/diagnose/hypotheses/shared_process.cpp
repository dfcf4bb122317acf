// SPDX-License-Identifier: MIT
#include "diagnose/hypotheses/shared_process.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "core/base/parallel.hpp"
#include "core/numerics/qr.hpp"
#include "core/statistics/significance.hpp"
#include "diagnose/candidates/candidate_column.hpp"
#include "diagnose/hypotheses/input_noise.hpp"
#include "diagnose/search/disturbed_alone.hpp"
#include "diagnose/search/effect_names.hpp"

namespace lacuna {
namespace {

/// A form in two equations.
struct Pair {
  Candidate one, other;
  Vector shapes;
  double gain = 0.0;  ///< joint drop of the sum of squares
};

/// Products of the coefficients of each term of the states that two equations have in common.
std::vector<double> shared_directions(const OdeModel& model, Index k, Index l) {
  std::vector<double> products;
  for (const WeightedTerm& one : model.equations()[static_cast<std::size_t>(k)]) {
    const auto names = one.term.expression().variables();
    const bool of_states =
        std::any_of(model.states().begin(), model.states().end(),
                    [&](const Quantity& x) { return names.contains(x.name); });
    for (const WeightedTerm& other : model.equations()[static_cast<std::size_t>(l)])
      if (of_states && other.term.name() == one.term.name())
        products.push_back(one.coefficient * other.coefficient);
  }
  return products;
}

/// Equations that are fitted, hold not by definition, and have a term of the states in common.
std::vector<std::pair<Index, Index>> sharing(const OdeModel& model, const NoiseModel& noise) {
  std::vector<std::pair<Index, Index>> result;
  for (Index k = 0; k < model.dimension(); ++k)
    for (Index l = k + 1; l < model.dimension(); ++l) {
      if (noise.disturbance[k] == 0.0 || noise.disturbance[l] == 0.0 ||
          identity_of(model, k) || identity_of(model, l))
        continue;
      if (!shared_directions(model, k, l).empty()) result.emplace_back(k, l);
    }
  return result;
}

/// What both equations are offered, and neither has.
std::vector<Pair> pairs_in(const Problem& problem, const Scope& scope, Index k, Index l) {
  std::vector<Candidate> proposed;
  for (const Stage<Effect>& effect : problem.options.effects)
    for (Candidate& candidate : effect->candidates(scope, k))
      if (candidate.place == Place::Rate && candidate.memory.empty())
        proposed.push_back(std::move(candidate));
  std::vector<Pair> pairs;
  for (Candidate& candidate : merged(proposed)) {
    Candidate other = candidate;
    other.equation = l;
    std::swap(other.least, other.most);
    other.least = -other.least;
    other.most = -other.most;
    pairs.push_back({std::move(candidate), std::move(other), {}, 0.0});
  }
  return pairs;
}

/// Orthonormal columns of all that is fitted, and the innovations without them.
struct Projection {
  const Assimilation& fit;
  InnovationSystem system;
  Matrix nominal;
  Vector innovations;

  explicit Projection(const Assimilation& start) : fit(start), system(start) {
    nominal = orthonormal_basis(system.fitted_columns());
    innovations = system.innovations();
    innovations -= nominal * (nominal.transpose() * innovations);
  }

  /// The column of a candidate without what the nominal terms make of it.
  std::optional<Vector> column(const Candidate& candidate, const Vector& shapes) const {
    auto own = candidate_column(
        candidate, {shapes.data(), static_cast<std::size_t>(shapes.size())}, fit, system);
    if (own) *own -= nominal * (nominal.transpose() * *own);
    return own;
  }
};

/// Joint gain of a form in both equations.
double joint_gain(const Projection& projection, const Pair& pair, const Vector& shapes) {
  constexpr double kIndependent = 1e-8;  // a fact of rounding: squared sine of two columns
  const auto one = projection.column(pair.one, shapes);
  const auto other = projection.column(pair.other, shapes);
  if (!one || !other) return 0.0;
  const double a = one->squaredNorm(), b = other->squaredNorm(), c = one->dot(*other);
  const double determinant = a * b - c * c;
  if (!(determinant > kIndependent * a * b)) return 0.0;
  const double u = one->dot(projection.innovations), v = other->dot(projection.innovations);
  return (b * u * u - 2.0 * c * u * v + a * v * v) / determinant;
}

/// Pairs at the best of their starts, best first, of each family no more than a few.
std::vector<Pair> screened(std::vector<Pair> pairs, const Projection& projection,
                           const RunContext& context) {
  parallel_for(pairs.size(), context.threads, [&](std::size_t i) {
    context.check_stop();
    Pair& pair = pairs[i];
    for (const Vector& start : pair.one.starts) {
      const double gain = joint_gain(projection, pair, start);
      if (pair.shapes.size() == start.size() && gain <= pair.gain) continue;
      pair.shapes = start;
      pair.gain = gain;
    }
  });
  std::stable_sort(pairs.begin(), pairs.end(),
                   [](const Pair& a, const Pair& b) { return a.gain > b.gain; });
  // A fact of the search: forms of one family are shaped to be much alike.
  constexpr int kOfEachFamily = 2;
  std::map<std::string, int> seen;
  std::erase_if(pairs, [&](const Pair& pair) {
    bool has_room = false;
    for (const std::string& family : pair.one.families)
      has_room = seen[family]++ < kOfEachFamily || has_room;
    return !has_room || !(pair.gain > 0.0);
  });
  return pairs;
}

/// A pair as it was fitted, with the names of both.
struct FittedPair {
  Explanation explanation;
  std::vector<NamedEffect> named;
  double criterion = INFINITY;
};

std::vector<FittedEffect> effects_of(const Pair& pair) {
  return {{pair.one, pair.shapes, 0.0, 0.0}, {pair.other, pair.shapes, 0.0, 0.0}};
}

/// Both effects with their names; none where one has numbers that no effect can have, or is not
/// distinguished from 0, or the two are not one effect.
std::vector<NamedEffect> names_of(const Problem& problem, const Baseline& base,
                                  const Explanation& explanation, Index tried) {
  const NameTable table{problem.options.effects, base.scope, problem.options.decision.naming};
  const double gain = base.fitted.deviance - explanation.fit.deviance;
  const double sigma = sigma_of_gain(gain, static_cast<double>(explanation.parameters()),
                                     static_cast<double>(tried));
  std::vector<NamedEffect> named;
  for (const FittedEffect& effect : explanation.effects) {
    const std::vector<Name> names = table.names_of(effect, explanation.fit.model);
    const double significance = problem.options.decision.significance;
    if (names.empty() || std::abs(effect.coefficient) < significance * effect.deviation)
      return {};
    NamedEffect one{.equation = effect.candidate.equation};
    take_name(effect, names.front(), one);
    one.sigma = sigma;
    one.tried = tried;
    one.probability = 1.0;
    const double before = base.fitted.noise.disturbance[one.equation];
    const double after = explanation.fit.noise.disturbance[one.equation];
    one.gap_closed =
        before > 0.0 ? std::clamp(1.0 - after * after / (before * before), 0.0, 1.0) : 0.0;
    named.push_back(std::move(one));
  }
  const std::vector<FittedEffect>& effects = explanation.effects;
  if (named.size() != 2 || named[0].name != named[1].name ||
      sigma < problem.options.decision.significance ||
      !acts_as_shared(problem.nominal, effects[0], effects[1]))
    return {};
  return named;
}

/// A start of the search, and the pairs that gain most from there.
struct Beginning {
  Assimilation fit;
  std::vector<Pair> pairs;
};

/// A pair fitted in few passes from the best of its starts.
Explanation fitted_roughly(const JointFitTask& task, const Assimilation& start,
                           const Pair& pair) {
  Explanation best = explain_roughly(task, start, effects_of(pair));
  for (const Vector& shapes : pair.one.starts) {
    if (shapes == pair.shapes) continue;
    Pair other = pair;
    other.shapes = shapes;
    Explanation next = explain_roughly(task, start, effects_of(other));
    if (next.fit.deviance < best.fit.deviance) best = std::move(next);
  }
  return best;
}

/// From where a rough fit has come, with less disturbance than it took.
FittedPair fitted(const Problem& problem, const Baseline& base, const JointFitTask& task,
                  const Explanation& rough, Index tried) {
  constexpr double kFractionOfDisturbance = 0.2;  // a fact of the search: a start, no bound
  Assimilation start = rough.fit;
  start.noise.disturbance *= kFractionOfDisturbance;
  FittedPair result{explain(task, start, rough.effects), {}, INFINITY};
  if (!std::isfinite(result.explanation.fit.deviance)) return result;
  result.named = names_of(problem, base, result.explanation, tried);
  if (!result.named.empty()) result.criterion = criterion_of(problem, base, result.explanation);
  return result;
}

/// Beginnings of the search for pairs in two equations.
std::vector<Beginning> beginnings(const Problem& problem, const Baseline& base, Index k,
                                  Index l, Index& tried) {
  // A fact of the search, of each beginning.
  constexpr std::size_t kFittedRoughly = 5;
  Assimilation given = base.given;
  given.free = base.fit_options.free;
  std::vector<Beginning> result;
  result.push_back({std::move(given), {}});
  for (const Index equation : {k, l})
    result.push_back({disturbed_alone(problem, base, equation), {}});
  for (Beginning& one : result) {
    if (!std::isfinite(one.fit.deviance)) continue;
    std::vector<Pair> pairs = pairs_in(problem, base.scope, k, l);
    tried += static_cast<Index>(pairs.size());
    one.pairs = screened(std::move(pairs), Projection(one.fit), problem.context);
    if (one.pairs.size() > kFittedRoughly) one.pairs.resize(kFittedRoughly);
    one.fit = loosened(std::move(one.fit), base);
  }
  return result;
}

/// work(0), ..., work(count - 1), in this order.
template <class Result, class Work>
std::vector<Result> in_parallel(std::size_t count, const Result& none, int threads, Work work) {
  std::vector<Result> all(count, none);
  parallel_for(count, threads, [&](std::size_t i) { all[i] = work(i); });
  return all;
}

/// The best pair in two equations, from all beginnings.
FittedPair best_in(const Problem& problem, const Baseline& base,
                   const std::vector<Beginning>& begins, Index tried) {
  // A fact of the search.
  constexpr std::size_t kFittedExactly = 4;
  const RunContext quiet = problem.context.beside_others();
  const JointFitTask task{base.records->data, problem.nominal, base.fit_options, quiet};
  const Explanation none{{}, base.fitted};
  std::vector<std::pair<const Beginning*, const Pair*>> list;
  for (const Beginning& one : begins)
    for (const Pair& pair : one.pairs) list.emplace_back(&one, &pair);
  std::vector<Explanation> rough = in_parallel(
      list.size(), none, problem.context.threads,
      [&](std::size_t i) { return fitted_roughly(task, list[i].first->fit, *list[i].second); });
  std::erase_if(rough, [](const Explanation& one) { return !std::isfinite(one.fit.deviance); });
  std::stable_sort(rough.begin(), rough.end(), [](const Explanation& a, const Explanation& b) {
    return a.fit.deviance < b.fit.deviance;
  });
  if (rough.size() > kFittedExactly) rough.erase(rough.begin() + kFittedExactly, rough.end());
  FittedPair best{none, {}, INFINITY};
  for (FittedPair& pair :
       in_parallel(rough.size(), best, problem.context.threads,
                   [&](std::size_t i) { return fitted(problem, base, task, rough[i], tried); }))
    if (pair.criterion < best.criterion) best = std::move(pair);
  return best;
}

/// The best pair of all equations that share a process.
std::optional<FittedPair> best_pair(const Problem& problem, const Baseline& base) {
  std::optional<FittedPair> best;
  Index tried = 0;
  for (const auto& [k, l] : sharing(problem.nominal, base.given.noise)) {
    const std::vector<Beginning> begins = beginnings(problem, base, k, l, tried);
    FittedPair pair = best_in(problem, base, begins, tried);
    if (std::isfinite(pair.criterion) && (!best || pair.criterion < best->criterion))
      best = std::move(pair);
  }
  return best;
}

}  // namespace

bool acts_as_shared(const OdeModel& model, const FittedEffect& one, const FittedEffect& other) {
  const std::vector<double> products =
      shared_directions(model, one.candidate.equation, other.candidate.equation);
  const double own = one.coefficient * other.coefficient;
  return std::any_of(products.begin(), products.end(),
                     [&](double product) { return product * own >= 0.0; });
}

Proposals SharedProcess::do_propose(const Problem& problem, const CompositeModel& best) const {
  const Baseline& base = *best.base;
  if (base.fit_options.hidden.empty() ||
      (best.named.empty() && !has_residual_structure(best.left, problem.options.decision)))
    return {};
  problem.context.report("fitting effects in two equations", 0.0);
  std::optional<FittedPair> pair = best_pair(problem, base);
  if (!pair) return {};
  CompositeModel composite{.hypothesis = std::string(info().name),
                           .base = best.base,
                           .explanation = std::move(pair->explanation),
                           .named = std::move(pair->named)};
  composite.left = structure_left(problem, composite.explanation.fit);
  composite.findings = best.findings;
  composite.notes = best.notes;
  update_numbers(composite.explanation, composite.named);
  return {{{.composite = std::move(composite)}}, {}};
}

}  // namespace lacuna
