// SPDX-License-Identifier: MIT
#include "fit_search.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/base/random.hpp"
#include "fit_quality.hpp"
#include "starts/continuation.hpp"
#include "starts/other_starts.hpp"
#include "starts/range_search.hpp"

namespace lacuna {
namespace {

/// Steps of a minimum: all residuals together change by less than this part of a deviation.
constexpr double kFine = 0.2;

/// Explicit steps that change all residuals together by so much of a deviation are wrong: five
/// times what halving them may do, a decision.
constexpr double kWrong = 1.0;

double spread_of(const Vector& values) {
  return std::sqrt((values.array() - values.mean()).square().mean());
}

/// The minimum with steps so fine that they shift no number by much of its error.
FitMinimum polished(FitEngine& engine, const FitUnknowns& unknowns, FitMinimum found,
                    const FitSearchOptions& options, const RunContext& context) {
  if (!choose_substeps(engine, found.point, {}, kFine)) return found;
  return minimise_in_time(engine, unknowns, found.point, {}, options.most_iterations, context);
}

/// How far parameters are from others, as fractions of these.
double distance(const FitPoint& a, const FitPoint& b) {
  return ((a.parameters - b.parameters).array() / (b.parameters.array().abs() + 1e-300))
      .abs()
      .min(1e6)
      .sum();
}

/// A point with the signs of the start: parameters that changed theirs, and all initial states,
/// turned round. It is the same fit where a model looks the same upside down.
FitPoint mirrored(FitPoint point, const FitPoint& start) {
  for (Index i = 0; i < point.parameters.size(); ++i) {
    double& value = point.parameters.data()[i];
    if (value * start.parameters.data()[i] < 0.0) value = -value;
  }
  point.starts = -point.starts;
  return point;
}

bool changed_a_sign(const FitPoint& a, const FitPoint& b) {
  return (a.parameters.array() * b.parameters.array() < 0.0).any();
}

/// Whether a fit leaves what the samples show of the noise. Hidden states have minima that are
/// good and wrong; there the residuals must be white.
bool is_good(FitEngine& engine, const FitUnknowns& unknowns, const FitPoint& start,
             const FitMinimum& found, const FitSearchOptions& options) {
  return excess_of_noise(engine, unknowns, found) <= options.good &&
         (!raised(engine, start, 1.0) || are_white(engine, whitened(engine, found.path)));
}

/// Entries of the rows of a fit: what a step costs.
double entries_of(const FitEngine& engine) {
  return static_cast<double>(engine.states() + engine.parameters()) *
         static_cast<double>(engine.records.samples());
}

/// Whether records are so few that all starts are tried.
bool is_cheap(const FitEngine& engine) {
  constexpr double kCheap = 2e4;  // entries: a decision, of time alone
  return entries_of(engine) < kCheap;
}

}  // namespace

RunContext with_last_second(const RunContext& context) {
  RunContext last = context;
  if (last.deadline) *last.deadline += std::chrono::seconds(1);
  return last;
}

int range_starts(const FitEngine& engine, const FitOptions& options) {
  return options.starts.value_or(is_cheap(engine) ? options.range_starts
                                                  : options.range_starts_of_many);
}

FitMinimum reweighted(FitEngine& engine, const FitUnknowns& unknowns, FitMinimum found,
                      const FitSearchOptions& options, const RunContext& context) {
  // Sizes that move settle in turn with the parameters, and profiles compare likelihoods of
  // them: 2 n 0.003^2 of a deviance is left for n values.
  const bool moving = sizes_move(engine);
  const int rounds = moving ? 20 : 5;
  const double settled = moving ? 0.003 : 0.01;
  for (int round = 0; round < rounds && std::isfinite(found.path.cost); ++round) {
    const double change = take_sizes(engine, unknowns, found.path);
    found.path = follow(engine, found.point, {});  // its cost with the new sizes
    if (round > 0 && change < settled) break;
    found =
        minimise_in_time(engine, unknowns, found.point, {}, options.most_iterations, context);
    if (!found.in_time) break;
  }
  return found;
}

bool choose_substeps(FitEngine& engine, const FitPoint& point, const Gains& gains,
                     double small) {
  if (engine.implicit) return false;
  const Index before = engine.signals.scheme.substeps;
  Index substeps = before;
  FitPath coarse = follow(engine, point, gains);
  while (substeps < kMostSubsteps) {
    set_substeps(engine, 2 * substeps);
    FitPath fine = follow(engine, point, gains);
    const Matrix change = whitened(engine, fine) - whitened(engine, coarse);
    if (change.norm() < small) {
      set_substeps(engine, substeps);
      return substeps != before;
    }
    substeps *= 2;
    coarse = std::move(fine);
  }
  choose_method(engine, point);
  return substeps != before || engine.implicit.has_value();
}

bool check_by_implicit_steps(FitEngine& engine, FitMinimum& minimum, double small) {
  if (engine.implicit || !std::isfinite(minimum.path.cost)) return false;
  take_implicit_steps(engine);
  FitPath exact = follow(engine, minimum.point, {});
  const Matrix change = whitened(engine, exact) - whitened(engine, minimum.path);
  if (!std::isfinite(exact.cost) || change.norm() < small) {
    engine.implicit.reset();
    return false;
  }
  minimum.path = std::move(exact);
  return true;
}

Disturbances disturbances_of(const FitEngine& engine, const FitPath& path, double fraction) {
  const Index m = engine.states();
  Disturbances found{Vector::Zero(m), fraction};
  double logs = 0.0, known = 0.0;
  for (Index k = 0; k < m; ++k) {
    double& scale = found.scale[k];
    scale = engine.records.scale[k];
    if (scale == 0.0 && path.states.col(k).allFinite()) scale = spread_of(path.states.col(k));
    if (scale > 0.0 && std::isfinite(scale)) {
      logs += std::log(scale);
      ++known;
    }
  }
  const double typical = known > 0.0 ? std::exp(logs / known) : 1.0;
  for (Index k = 0; k < m; ++k) {
    if (!(found.scale[k] > 0.0) || !std::isfinite(found.scale[k])) found.scale[k] = typical;
    if (identity_of(engine.model.symbolic(), k)) found.scale[k] = 0.0;
  }
  return found;
}

namespace {

/// Compares one more minimum with the best.
void keep_better(FitEngine& engine, const FitUnknowns& unknowns, const FitPoint& start,
                 FitMinimum found, const FitSearchOptions& options, const RunContext& context,
                 FitSearch& search) {
  constexpr double kSame = 1e-4;  // of the deviance of one value: 0.01 % of the sum of squares
  ++search.starts;
  search.best.path = follow(engine, search.best.point, {});  // steps may be finer by now
  const double values = engine.records.valid.sum(),
               before = deviance_of(engine, unknowns, search.best);
  double now = deviance_of(engine, unknowns, found);
  // Steps may be too long for it, and the minimum one of their errors.
  if (now < before && !options.rough) {
    found = polished(engine, unknowns, std::move(found), options, context);
    now = deviance_of(engine, unknowns, found);
  }
  if (now < before - kAlike * values)
    search.agreeing = 1;
  else if (now < before + kAlike * values)
    ++search.agreeing;
  // Of equal minima (a model that may change a sign everywhere) the one nearest to the start.
  const bool nearer = distance(found.point, start) < distance(search.best.point, start);
  if (now < before - kSame * values || (now < before + kSame * values && nearer))
    search.best = std::move(found);
}

constexpr int kEnough = 4;  // searches that come to the best minimum: others are not needed

/// Fits from starts over the ranges, then about the best of them, by rough implicit steps, whose
/// error is controlled wherever a start is. @return whether more starts are not likely to find
/// more.
bool search_roughly(FitEngine& engine, const FitUnknowns& unknowns, const FitPoint& start,
                    const FitSearchOptions& options, const RunContext& context,
                    FitSearch& search) {
  if (!engine.implicit) take_implicit_steps(engine);
  const RoughSteps rough(engine);
  const auto take = [&](FitMinimum found) {
    keep_better(engine, unknowns, start, std::move(found), options, context, search);
  };
  const bool settled = search_ranges(engine, unknowns, start, options, context, take,
                                     [&] { ++search.starts; });
  // Minima beside the best one are often better: parameters are moved from there.
  Random random(context.seed);
  for (int i = 0; i < options.restarts && !settled && search.agreeing < kEnough; ++i) {
    if (!std::isfinite(search.best.path.cost)) break;
    take_sizes(engine, unknowns, search.best.path);
    const double spread = i % 2 == 0 ? options.spread : options.spread * options.spread;
    const FitPoint beside =
        other_start(engine, unknowns, search.best.point, spread, random);
    take(minimise(engine, unknowns, beside, {}, options.most_iterations, context));
  }
  return settled;
}

/// search_roughly(), then the steps that were.
bool try_ranges(FitEngine& engine, const FitUnknowns& unknowns, const FitPoint& start,
                const FitSearchOptions& options, const RunContext& context, FitSearch& search) {
  const bool were_explicit = !engine.implicit;
  const bool settled = search_roughly(engine, unknowns, start, options, context, search);
  if (were_explicit && leave_implicit_steps(engine, search.best.point))
    choose_substeps(engine, search.best.point, {}, kFine);
  return settled;
}

/// Fits from other starts, as long as a better fit may be there.
/// @throws OutOfTime past the deadline, with the best fit so far.
void try_other_starts(FitEngine& engine, const FitUnknowns& unknowns, const FitPoint& start,
                      const FitSearchOptions& options, const RunContext& context,
                      FitSearch& search) {
  const auto take = [&](FitMinimum found) {
    keep_better(engine, unknowns, start, std::move(found), options, context, search);
  };
  const auto good = [&] { return is_good(engine, unknowns, start, search.best, options); };
  if (good() && !changed_a_sign(search.best.point, start) && !options.always_ranges) return;
  if (!search.ran_freely)
    take(minimise(engine, unknowns, start, {}, options.most_iterations, context));
  FitUnknowns only_starts = unknowns;
  only_starts.global.clear();
  for (const double sign : {1.0, -1.0})
    if (const auto other = raised(engine, start, sign); other && !good()) {
      const FitMinimum begun =
          minimise(engine, only_starts, *other, {}, options.most_iterations, context);
      take(minimise(engine, unknowns, begun.point, {}, options.most_iterations, context));
    }
  // With many samples only where searches about the given numbers differ: a decision.
  constexpr double kAlwaysRanged = 4e3;
  const auto has_ranges = [&] {
    return options.range_starts > 0 &&
           (options.always_ranges || (has_wide_range(unknowns, options.spread) && !good()));
  };
  const bool ranged =
      has_ranges() && (options.always_ranges || entries_of(engine) < kAlwaysRanged);
  const bool settled = ranged && try_ranges(engine, unknowns, start, options, context, search);
  Random random(context.seed);
  // Some are kept for paths that starts over ranges lose, oscillations above all: a decision.
  const int restarts = ranged ? (options.restarts + 3) / 4 : options.restarts;
  for (int i = 0; i < restarts && !settled; ++i) {
    const bool sure = (!is_cheap(engine) || ranged) && search.agreeing >= kEnough &&
                      std::isfinite(search.best.path.cost);
    if (sure || good()) break;
    context.report("trying other starts",
                   static_cast<double>(i) / static_cast<double>(restarts));
    FitSearchOptions other = options;  // some with less disturbance from the first on
    other.first_level = static_cast<std::size_t>(2 * (i % 3));
    const double spread = i % 2 == 0 ? options.spread : options.spread * options.spread;
    FitMinimum found =
        continued(engine, unknowns, other_start(engine, unknowns, start, spread, random), other,
                  context)
            .best;
    const bool cut = !found.in_time;
    take(std::move(found));
    if (cut) throw OutOfTime();
  }
  if (!ranged && search.agreeing < kEnough && has_ranges())
    try_ranges(engine, unknowns, start, options, context, search);
  if (changed_a_sign(search.best.point, start))
    take(minimise(engine, unknowns, mirrored(search.best.point, start), {},
                  options.most_iterations, context));
}

/// Adds filters to what the free run came to, if it came to something.
FitSearch through_filters(FitEngine& engine, const FitUnknowns& unknowns, const FitPoint& start,
                          std::optional<FitMinimum> free, const FitSearchOptions& options,
                          const RunContext& context) {
  Continued found = continued(engine, unknowns, start, options, context);
  if (!found.best.in_time && (free || options.rough)) throw OutOfTime();
  FitSearch search{.best = std::move(found.best),
                   .in_time = found.best.in_time,
                   .ran_freely = free.has_value(),
                   .departs = found.departs};
  if (free && !search.departs)
    keep_better(engine, unknowns, start, std::move(*free), options, context, search);
  return search;
}

/// From the given start by filters. They move the states at each sample, which sets off all fast
/// motions of a stiff model: its free run goes first, and alone where it comes to the noise; a
/// deadline ends the filters then.
FitSearch from_given_start(FitEngine& engine, const FitUnknowns& unknowns,
                           const FitPoint& start, const FitSearchOptions& options,
                           const RunContext& context) {
  const RunContext needed = options.rough ? context : with_last_second(context);
  std::optional<FitMinimum> free;
  if (engine.implicit && std::isfinite(follow(engine, start, {}).cost))
    free = minimise_in_time(engine, unknowns, start, {}, options.most_iterations, needed);
  if (free && !free->in_time) {
    if (options.rough) throw OutOfTime();
    return {.best = std::move(*free), .in_time = false};
  }
  if (free && is_good(engine, unknowns, start, *free, options)) return {std::move(*free)};
  try {
    return through_filters(engine, unknowns, start, free, options, free ? context : needed);
  } catch (const OutOfTime&) {
    if (!free) throw;
    return {.best = std::move(*free), .in_time = false};
  }
}

/// From numbers fitted in windows, where the fit from the given start leaves more than noise.
void try_windows(FitEngine& engine, const FitUnknowns& unknowns, const FitPoint& start,
                 const FitSearchOptions& options, const RunContext& context,
                 FitSearch& search) {
  if (!options.in_windows || is_good(engine, unknowns, start, search.best, options)) return;
  std::optional<FitInWindows> found = options.in_windows();
  if (!found) return;
  keep_better(engine, unknowns, start,
              minimise(engine, unknowns, found->point, {}, options.most_iterations, context),
              options, context, search);
  if (is_good(engine, unknowns, start, search.best, options))
    search.departs = false;
  else if (found->meets_records &&
           static_cast<Index>(found->begins.size()) > start.starts.rows())
    search.windows = std::move(found);
}

/// From the given start, then from others.
FitSearch from_several_starts(FitEngine& engine, const FitUnknowns& unknowns,
                              const FitPoint& start, const FitSearchOptions& options,
                              const RunContext& context) {
  FitSearch search = from_given_start(engine, unknowns, start, options, context);
  if (!search.in_time) return search;
  try {
    try_windows(engine, unknowns, start, options, context, search);
    if (search.windows || options.only_given || search.departs) return search;
    try_other_starts(engine, unknowns, start, options, context, search);
  } catch (const OutOfTime&) {
    search.in_time = false;
  }
  return search;
}

/// A minimum with sizes of the noise and steps that belong to it.
FitMinimum settled(FitEngine& engine, const FitUnknowns& unknowns, FitMinimum found,
                   const FitSearchOptions& options, const RunContext& context) {
  found = reweighted(engine, unknowns, std::move(found), options, context);
  if (found.in_time) found = polished(engine, unknowns, std::move(found), options, context);
  if (found.in_time) found = reweighted(engine, unknowns, std::move(found), options, context);
  if (found.in_time && check_by_implicit_steps(engine, found, kWrong))
    found = reweighted(engine, unknowns, std::move(found), options, context);
  return found;
}

/// The fit from several starts, with sizes of the noise and steps that belong to it.
FitSearch settled_search(FitEngine& engine, const FitUnknowns& unknowns, const FitPoint& start,
                         const FitSearchOptions& options, const RunContext& context) {
  FitSearch search = from_several_starts(engine, unknowns, start, options, context);
  if (search.windows) return search;
  search.met_noise = is_good(engine, unknowns, start, search.best, options);
  if (std::isfinite(search.best.path.cost)) take_sizes(engine, unknowns, search.best.path);
  if (!search.best.in_time) return search;
  const RunContext needed = with_last_second(context);
  if (leave_implicit_steps(engine, search.best.point)) {
    choose_substeps(engine, search.best.point, {}, kFine);
    search.best = minimise_in_time(engine, unknowns, search.best.point, {},
                                   options.most_iterations, needed);
  }
  FitMinimum exact = settled(engine, unknowns, search.best, options, needed);
  if (std::isfinite(search.best.path.cost) && !std::isfinite(exact.path.cost)) {
    // Explicit steps led away from it: those whose error is controlled do not.
    take_implicit_steps(engine);
    search.best.path = follow(engine, search.best.point, {});
    exact = reweighted(engine, unknowns, search.best, options, needed);
  }
  search.best = std::move(exact);
  return search;
}

}  // namespace

FitSearch search_fit(FitEngine& engine, const FitUnknowns& unknowns, const FitPoint& given,
                     const FitSearchOptions& options, const RunContext& context) {
  choose_method(engine, given);
  const FitPoint start = off_edges(engine, given);
  if (options.rough) return from_several_starts(engine, unknowns, start, options, context);
  const Vector sigma = engine.sigma;
  const auto laws = engine.laws;
  FitSearch search = settled_search(engine, unknowns, start, options, context);
  if (search.windows || !search.in_time || !search.met_noise) return search;
  if (is_good(engine, unknowns, start, search.best, options)) return search;
  // What met the noise was the model with steps that are too long: again with those that are not.
  engine.sigma = sigma;
  engine.laws = laws;
  return settled_search(engine, unknowns, start, options, context);
}

}  // namespace lacuna
