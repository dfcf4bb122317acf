// SPDX-License-Identifier: MIT
#include "fit_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/base/random.hpp"
#include "fit_quality.hpp"

namespace lacuna {
namespace {

/// Fractions of their spread by which states are disturbed in one time scale, one after
/// another.
constexpr std::array<double, 6> kFractions = {3.0, 1.0, 0.3, 0.1, 0.03, 0.01};

constexpr double kExact = 1e-9;  // of the noise: residuals of a channel that is met to rounding

/// Steps of a minimum: all residuals together change by less than this part of a deviation.
constexpr double kFine = 0.2;

double spread_of(const Vector& values) {
  return std::sqrt((values.array() - values.mean()).square().mean());
}

/// Fits with filters of falling disturbance, then the free run.
FitMinimum continued(FitEngine& engine, const FitUnknowns& unknowns, FitPoint point,
                     const FitSearchOptions& options, const RunContext& context) {
  constexpr int kRounds = 2, kIterations = 8;
  const double samples = std::sqrt(engine.records.valid.sum());
  FitPath path = follow(engine, point, {});
  for (std::size_t level = options.first_level; level < kFractions.size(); ++level)
    for (int round = 0; round < kRounds; ++round) {
      const double fraction = kFractions[level];
      context.check_stop();
      const Disturbances disturbances = disturbances_of(engine, path, fraction);
      FitPath filtered;
      const Gains gains = filter_gains(engine, point, disturbances, filtered);
      if (!gains.allFinite() || !std::isfinite(filtered.cost)) continue;
      if (level == options.first_level) choose_substeps(engine, point, gains, 0.1 * samples);
      FitMinimum found = minimise(engine, unknowns, point, gains, kIterations, context);
      if (!std::isfinite(found.path.cost)) continue;
      point = std::move(found.point);
      path = std::move(found.path);
    }
  return minimise(engine, unknowns, point, {}, options.most_iterations, context);
}

/// The minimum with steps so fine that they shift no number by much of its error.
FitMinimum polished(FitEngine& engine, const FitUnknowns& unknowns, FitMinimum found,
                    const FitSearchOptions& options, const RunContext& context) {
  if (!choose_substeps(engine, found.point, {}, kFine)) return found;
  return minimise(engine, unknowns, found.point, {}, options.most_iterations, context);
}

/// Whether sizes of a law are estimated and depend on where the model is.
bool size_moves(const std::optional<ChannelNoise>& noise) {
  if (!noise) return false;
  const NoiseLaw& law = noise->law();
  const bool is_open = (has_constant(law.form) && !law.constant) ||
                       (has_fraction(law.form) && !law.fraction);
  return is_open && (law.below || law.above);
}

/// Residuals of several channels count by their size; a few rounds settle it.
FitMinimum reweighted(FitEngine& engine, const FitUnknowns& unknowns, FitMinimum found,
                      const FitSearchOptions& options, const RunContext& context) {
  // Sizes that move settle in turn with the parameters, and profiles compare likelihoods of
  // them: 2 n 0.003^2 of a deviance is left for n values.
  const bool moving = sizes_move(engine);
  const int rounds = moving ? 20 : 5;
  const double settled = moving ? 0.003 : 0.01;
  const Vector least = kExact * engine.sigma;
  for (int round = 0; round < rounds && std::isfinite(found.path.cost); ++round) {
    const Vector rms = residual_rms(engine, unknowns, found.path);
    const Vector sigma = rms.cwiseMax(least);
    const double change =
        std::max((sigma.array() / engine.sigma.array()).log().abs().maxCoeff(),
                 estimate_laws(engine, unknowns, found.path));
    engine.sigma = sigma;
    found.path = follow(engine, found.point, {});  // its cost with the new sizes
    if (round > 0 && change < settled) break;
    found = minimise(engine, unknowns, found.point, {}, options.most_iterations, context);
  }
  return found;
}

/// Another start: parameters off by a random factor, hidden states anywhere.
FitPoint other_start(FitEngine& engine, const FitUnknowns& unknowns, FitPoint point,
                     double spread, Random& random) {
  for (Index p = 0; p < point.parameters.cols(); ++p) {
    const double factor = std::exp(std::log(spread) * random.uniform(-1.0, 1.0));
    point.parameters.col(p) = (factor * point.parameters.col(p))
                                  .cwiseMax(unknowns.lower[p])
                                  .cwiseMin(unknowns.upper[p]);
  }
  const FitPath path = follow(engine, point, {});
  const Vector scale = disturbances_of(engine, path, 1.0).scale;
  for (Index k = 0; k < engine.states(); ++k)
    if (engine.records.guessed[static_cast<std::size_t>(k)])
      for (Index r = 0; r < point.starts.rows(); ++r)
        point.starts(r, k) = scale[k] * random.normal();
  return point;
}

/// The start with hidden states one spread from it all at once: levels and concentrations are
/// all positive. Nothing where no state is guessed.
std::optional<FitPoint> raised(FitEngine& engine, FitPoint point, double sign) {
  const Vector scale = disturbances_of(engine, follow(engine, point, {}), 1.0).scale;
  bool any = false;
  for (Index k = 0; k < engine.states(); ++k) {
    if (!engine.records.guessed[static_cast<std::size_t>(k)]) continue;
    point.starts.col(k).array() += sign * scale[k];
    any = true;
  }
  return any ? std::optional(std::move(point)) : std::nullopt;
}

/// Whether a range is positive and so wide that starts about another one do not come to its ends.
bool is_wide(double lower, double upper, double spread) {
  return lower > 0.0 && std::isfinite(upper) && upper / lower > std::pow(spread, 4.0);
}

/// A start anywhere in the ranges: of some that are even in the logarithms of parameters with wide
/// ranges, the one with the best free run. Nothing where no range is wide or no run is finite.
std::optional<FitPoint> start_in_ranges(FitEngine& engine, const FitUnknowns& unknowns,
                                        const FitPoint& start, double spread, Random& random) {
  constexpr int kDraws = 10;  // a decision: they cost less than one minimisation
  std::optional<FitPoint> best;
  double least = std::numeric_limits<double>::infinity();
  for (int draw = 0; draw < kDraws; ++draw) {
    FitPoint point = other_start(engine, unknowns, start, spread, random);
    bool any = false;
    for (const Index p : unknowns.global) {
      const double lower = unknowns.lower[p], upper = unknowns.upper[p];
      if (!is_wide(lower, upper, spread)) continue;
      any = true;
      const double fraction = random.uniform(0.0, 1.0);
      point.parameters.col(p).setConstant(lower * std::pow(upper / lower, fraction));
    }
    if (!any) return std::nullopt;
    choose_method(engine, point);
    const double cost = total_cost(unknowns, point, follow(engine, point, {}));
    if (cost < least) {
      least = cost;
      best = std::move(point);
    }
  }
  return best;
}

/// -2 log-likelihood of the values of a channel, less a constant, with the size of its noise that
/// is the best for a path.
double channel_deviance(const FitEngine& engine, const FitPath& path, Index c) {
  std::vector<Index> rows;
  for (Index n = 0; n < path.residuals.rows(); ++n)
    if (engine.records.valid(n, c) > 0.0) rows.push_back(n);
  const Vector residuals = path.residuals(rows, c), measured = engine.records.values(rows, c);
  double deviance = 0.0;
  if (const auto& law = engine.laws[static_cast<std::size_t>(c)]) {
    ChannelNoise sized = *law;
    sized.estimate(measured, measured - residuals, 1.0);
    for (Index i = 0; i < residuals.size(); ++i)
      deviance -= 2.0 * sized.log_likelihood(measured[i], measured[i] - residuals[i]);
  } else if (const Matrix& known = engine.records.deviations;
             known.size() > 0 && known.col(c).maxCoeff() > 0.0) {
    deviance = residuals.cwiseQuotient(known(rows, c)).squaredNorm();
  } else if (!rows.empty()) {
    const double rms = residuals.norm() / std::sqrt(static_cast<double>(residuals.size()));
    deviance = 2.0 * static_cast<double>(residuals.size()) *
               std::log(std::max(rms, kExact * engine.sigma[c]));
  }
  return deviance;
}

/// What minima are compared by: -2 log-likelihood less a constant. Guesses of the noise, with which
/// they were found, may weigh channels so that the wrong one is lower. Infinite where no run is.
double deviance_of(const FitEngine& engine, const FitUnknowns& unknowns,
                   const FitMinimum& minimum) {
  if (!std::isfinite(minimum.path.cost)) return std::numeric_limits<double>::infinity();
  double deviance =
      total_cost(unknowns, minimum.point, minimum.path) - minimum.path.cost;  // of priors
  for (Index c = 0; c < engine.count(); ++c)
    deviance += channel_deviance(engine, minimum.path, c);
  return deviance;
}

/// Residuals over the noise that the samples show, the largest of all channels; infinite where
/// the noise is not known.
double excess(const FitEngine& engine, const FitUnknowns& unknowns, const FitMinimum& found) {
  if (!std::isfinite(found.path.cost)) return std::numeric_limits<double>::infinity();
  const Vector rms = residual_rms(engine, unknowns, found.path);
  double most = 0.0;
  for (std::size_t c = 0; c < engine.records.channels.size(); ++c) {
    const double noise = engine.records.channels[c].noise;
    const double size = rms[static_cast<Index>(c)];
    most = std::max(
        most, noise > 0.0 ? size / noise : size / (1e-4 * engine.records.channels[c].spread));
  }
  return most;
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

}  // namespace

bool sizes_move(const FitEngine& engine) {
  return std::any_of(engine.laws.begin(), engine.laws.end(), size_moves);
}

double estimate_laws(FitEngine& engine, const FitUnknowns& unknowns, const FitPath& path) {
  const double all = degrees_of_freedom(engine, unknowns) /
                     std::max(1.0, engine.records.valid.sum());
  double change = 0.0;
  for (Index c = 0; c < engine.count(); ++c) {
    auto& law = engine.laws[static_cast<std::size_t>(c)];
    if (!law) continue;
    std::vector<Index> rows;
    for (Index n = 0; n < path.residuals.rows(); ++n)
      if (engine.records.valid(n, c) > 0.0) rows.push_back(n);
    const Vector measured = engine.records.values(rows, c);
    const double usual = engine.records.channels[static_cast<std::size_t>(c)].spread;
    const double before = law->deviation(usual);
    law->estimate(measured, measured - path.residuals(rows, c), size_moves(law) ? 1.0 : all);
    change = std::max(change, std::abs(std::log(law->deviation(usual) / before)));
  }
  return change;
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

Vector residual_rms(const FitEngine& engine, const FitUnknowns& unknowns, const FitPath& path) {
  const double all = engine.records.valid.sum();
  const double fraction = degrees_of_freedom(engine, unknowns) / std::max(1.0, all);
  Vector rms(path.residuals.cols());
  for (Index c = 0; c < rms.size(); ++c)
    rms[c] = path.residuals.col(c).norm() /
             std::sqrt(std::max(1.0, fraction * engine.records.valid.col(c).sum()));
  return rms;
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
                 FitMinimum found, FitSearch& search) {
  // Of the deviance of one value: 1 % and 0.01 % of the sum of squares.
  constexpr double kAlike = 0.01, kSame = 1e-4;
  ++search.starts;
  search.best.path = follow(engine, search.best.point, {});  // steps may be finer by now
  const double before = deviance_of(engine, unknowns, search.best),
               now = deviance_of(engine, unknowns, found),
               values = engine.records.valid.sum();
  if (now < before - kAlike * values)
    search.agreeing = 1;
  else if (now < before + kAlike * values)
    ++search.agreeing;
  // Of equal minima (a model that may change a sign everywhere) the one nearest to the start.
  const bool nearer = distance(found.point, start) < distance(search.best.point, start);
  if (now < before - kSame * values || (now < before + kSame * values && nearer))
    search.best = std::move(found);
}

/// Fits from other starts, as long as a better fit may be there.
/// @throws OutOfTime past the deadline, with the best fit so far.
void try_other_starts(FitEngine& engine, const FitUnknowns& unknowns, const FitPoint& start,
                      const FitSearchOptions& options, const RunContext& context,
                      FitSearch& search) {
  constexpr int kEnough = 4;
  // Starts in wide ranges for one about the given numbers, where no run was finite: a decision.
  constexpr int kInRanges = 2;
  constexpr double kCheap = 2e4;  // entries of the rows, below which all starts are tried
  const bool cheap = static_cast<double>(engine.states() + engine.parameters()) *
                         static_cast<double>(engine.records.samples()) <
                     kCheap;
  const auto take = [&](FitMinimum found) {
    keep_better(engine, unknowns, start, std::move(found), search);
  };
  // Hidden states have minima that are good and wrong; there the residuals must be white.
  const bool guessed = raised(engine, start, 1.0).has_value();
  const auto good = [&] {
    return excess(engine, unknowns, search.best) <= options.good &&
           (!guessed || are_white(engine, whitened(engine, search.best.path)));
  };
  if (good() && !changed_a_sign(search.best.point, start)) return;
  take(minimise(engine, unknowns, start, {}, options.most_iterations, context));
  FitUnknowns only_starts = unknowns;
  only_starts.global.clear();
  for (const double sign : {1.0, -1.0})
    if (const auto other = raised(engine, start, sign); other && !good()) {
      const FitMinimum begun =
          minimise(engine, only_starts, *other, {}, options.most_iterations, context);
      take(minimise(engine, unknowns, begun.point, {}, options.most_iterations, context));
    }
  Random random(context.seed);
  for (int i = 0; i < options.restarts; ++i) {
    const bool sure =
        !cheap && search.agreeing >= kEnough && std::isfinite(search.best.path.cost);
    if (sure || good()) break;
    context.report("trying other starts",
                   static_cast<double>(i) / static_cast<double>(options.restarts));
    FitSearchOptions other = options;  // some with less disturbance from the first on
    other.first_level = static_cast<std::size_t>(2 * (i % 3));
    const double spread = i % 2 == 0 ? options.spread : options.spread * options.spread;
    take(continued(engine, unknowns, other_start(engine, unknowns, start, spread, random),
                   other, context));
  }
  const auto is_lost = [&] { return !std::isfinite(search.best.path.cost); };
  for (int i = 0; i < kInRanges * options.restarts && is_lost(); ++i)
    if (const auto point = start_in_ranges(engine, unknowns, start, options.spread, random))
      take(minimise(engine, unknowns, *point, {}, options.most_iterations, context));
  if (changed_a_sign(search.best.point, start))
    take(minimise(engine, unknowns, mirrored(search.best.point, start), {},
                  options.most_iterations, context));
}

/// From the given start, then from others.
FitSearch from_several_starts(FitEngine& engine, const FitUnknowns& unknowns,
                              const FitPoint& start, const FitSearchOptions& options,
                              const RunContext& context) {
  FitSearch search{continued(engine, unknowns, start, options, context.unhurried())};
  if (options.only_given) return search;
  try {
    try_other_starts(engine, unknowns, start, options, context, search);
  } catch (const OutOfTime&) {
    search.in_time = false;
  }
  return search;
}

}  // namespace

FitSearch search_fit(FitEngine& engine, const FitUnknowns& unknowns, const FitPoint& start,
                     const FitSearchOptions& options, const RunContext& context) {
  choose_method(engine, start);
  FitSearch search = from_several_starts(engine, unknowns, start, options, context);
  const RunContext needed = context.unhurried();
  if (leave_implicit_steps(engine, search.best.point)) {
    choose_substeps(engine, search.best.point, {}, kFine);
    search.best =
        minimise(engine, unknowns, search.best.point, {}, options.most_iterations, needed);
  }
  search.best = reweighted(engine, unknowns, std::move(search.best), options, needed);
  search.best = polished(engine, unknowns, std::move(search.best), options, needed);
  search.best = reweighted(engine, unknowns, std::move(search.best), options, needed);
  return search;
}

}  // namespace lacuna
