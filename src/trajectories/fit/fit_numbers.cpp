// SPDX-License-Identifier: MIT
#include "fit_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/base/text.hpp"
#include "fit_quality.hpp"
#include "lacuna/core/statistics/interval.hpp"

namespace lacuna {
namespace {

/// Entries of rows times numbers, up to which profiles are made without being asked for: about
/// as long as a search takes.
constexpr double kModerateWork = 2e5;

/// How often a lower minimum that a profile leads to is followed.
constexpr int kMostRounds = 3;

FitErrors errors_at(FitEngine& engine, const FitUnknowns& unknowns, FitMinimum& minimum,
                    const RunContext& context) {
  const bool white = are_white(engine, whitened(engine, minimum.path));
  FitErrors errors = errors_of(engine, unknowns, minimum, white);
  if (errors.open.cols() == 0) return errors;
  minimum = nearest_minimum(engine, unknowns, minimum, errors.open, context);
  return errors_of(engine, unknowns, minimum, white);
}

/// Profiles of all numbers that may have one; a lower minimum ends it.
std::optional<FitMinimum> add_profiles(FitEngine& engine, const FitUnknowns& unknowns,
                                       KnownNumbers& known, bool whole_curves,
                                       const RunContext& context) {
  const auto g = static_cast<Index>(unknowns.global.size());
  const Vector given = engine.model.values();
  known.profiles.assign(static_cast<std::size_t>(g), std::nullopt);
  for (Index i = 0; i < g; ++i) {
    const auto place = static_cast<std::size_t>(i);
    if (!known.errors.known[place] && !known.errors.at_bound[place]) continue;
    context.check_stop();
    std::optional<FitMinimum> better;
    const ProfileTask task{
        known.reach[i],
        known.errors.free_errors[i] * std::sqrt(known.errors.inflation[i]),
        std::abs(given[unknowns.global[place]]), known.errors.inflation[i], whole_curves};
    known.profiles[place] =
        profile_of(engine, unknowns, known.minimum, i, task, better, context);
    if (better) return better;
  }
  return std::nullopt;
}

/// The interval from a standard error: of the logarithm where the range is positive.
std::array<double, 2> by_error(double value, double width, double lower) {
  if (lower > 0.0) return {value * std::exp(-width / value), value * std::exp(width / value)};
  return {value - width, value + width};
}

/// Gives a number its interval, or the limit that it has on one side.
void set_limits(double reach, double error, const std::array<double, 2>& range,
                const std::optional<NumberProfile>& profile, FittedParameter& number) {
  std::optional<double> low, high;
  if (profile) {
    low = profile->low;
    high = profile->high;
  } else {
    const auto ends = by_error(number.value, reach * error, range[0]);
    if (ends[0] > range[0]) low = ends[0];
    if (ends[1] < range[1]) high = ends[1];
  }
  if (!low || !high) {
    number.at_least = low;
    number.at_most = high;
    return;
  }
  constexpr double kAlike = 1.25;  // a likelihood as wide as its curvature says, about
  const double half = (*high - *low) / 2.0 / reach;
  const bool alike = half < kAlike * error && error < kAlike * half;
  number.standard_error = alike ? error : half;
  number.ci95 = {{*low, *high}};
}

/// Values and errors of a number that each record has for itself.
void set_per_record(const FitEngine& engine, const FitUnknowns& unknowns,
                    const KnownNumbers& known, Index parameter, FittedParameter& number) {
  const Vector own = known.minimum.point.parameters.col(parameter);
  number.per_record.assign(own.begin(), own.end());
  const auto place = std::find(unknowns.local.begin(), unknowns.local.end(), parameter) -
                     unknowns.local.begin();
  const Vector errors = known.errors.starts.col(engine.states() + place);
  number.per_record_errors.assign(errors.begin(), errors.end());
}

}  // namespace

KnownNumbers known_numbers(FitEngine& engine, const FitUnknowns& unknowns,
                           const FitMinimum& minimum, ProfileUse use,
                           const RunContext& context) {
  KnownNumbers known{.minimum = minimum, .errors = {}};
  const RunContext needed = with_last_second(context);
  const bool follow_profiles =
      use == ProfileUse::Curves || use == ProfileUse::Always ||
      (use == ProfileUse::Cheap && profile_work(engine, unknowns) <= kModerateWork);
  for (int round = 0;; ++round) {
    known.errors = errors_at(engine, unknowns, known.minimum, needed);
    known.reach = known.errors.freedom.unaryExpr(&student_quantile_975);
    known.profiles.assign(unknowns.global.size(), std::nullopt);
    if (!follow_profiles) return known;
    std::optional<FitMinimum> better;
    try {
      better = add_profiles(engine, unknowns, known, use == ProfileUse::Curves, context);
    } catch (const OutOfTime&) {
      known.profiles.assign(unknowns.global.size(), std::nullopt);
      known.in_time = false;
      return known;
    }
    if (!better || round == kMostRounds) return known;
    constexpr int kIterations = 60;
    known.minimum =
        minimise_in_time(engine, unknowns, better->point, {}, kIterations, needed);
  }
}

std::vector<FittedParameter> numbers_of(const FitEngine& engine, const FitUnknowns& unknowns,
                                     const KnownNumbers& known) {
  const Vector start = engine.model.values();
  const std::vector<std::string> names = engine.model.names();
  std::vector<FittedParameter> numbers;
  for (Index p = 0; p < start.size(); ++p) {
    FittedParameter number{.name = names[static_cast<std::size_t>(p)],
                        .start = start[p],
                        .value = known.minimum.point.parameters.col(p).mean()};
    const auto place = std::find(unknowns.global.begin(), unknowns.global.end(), p);
    if (place == unknowns.global.end()) {
      set_per_record(engine, unknowns, known, p, number);
    } else {
      const auto i = static_cast<std::size_t>(place - unknowns.global.begin());
      const auto& profile = known.profiles[i];
      const auto index = static_cast<Index>(i);
      const double error = std::sqrt(known.errors.covariance(index, index));
      if (known.errors.at_bound[i]) {
        number.bound = number.value <= unknowns.lower[p] ? "min" : "max";
        if (profile) {
          number.at_least = profile->low;
          number.at_most = profile->high;
        }
      } else if (known.errors.known[i] && error > 0.0 && std::isfinite(error)) {
        set_limits(known.reach[index], error, {unknowns.lower[p], unknowns.upper[p]}, profile,
                   number);
      }
    }
    numbers.push_back(std::move(number));
  }
  return numbers;
}

std::vector<FitProfile> curves_of(const FitEngine& engine, const FitUnknowns& unknowns,
                                  const KnownNumbers& known) {
  const std::vector<std::string> names = engine.model.names();
  std::vector<FitProfile> curves;
  for (std::size_t i = 0; i < known.profiles.size(); ++i) {
    if (!known.profiles[i]) continue;
    const NumberProfile& profile = *known.profiles[i];
    const auto parameter = static_cast<std::size_t>(unknowns.global[i]);
    FitProfile curve{names[parameter], {}, {}, profile.limit};
    for (std::size_t k = 0; k < profile.values.size(); ++k)
      if (std::isfinite(profile.deviance[k])) {
        curve.values.push_back(profile.values[k]);
        curve.deviance.push_back(profile.deviance[k]);
      }
    curves.push_back(std::move(curve));
  }
  return curves;
}

void add_limits(const std::vector<FittedParameter>& numbers,
                std::vector<FitCombination>& combinations) {
  for (const FittedParameter& number : numbers) {
    const bool is_own = !number.per_record.empty() && !number.spread;
    if (number.bound || number.ci95 || is_own) continue;
    const bool named = std::any_of(combinations.begin(), combinations.end(),
                                   [&](const FitCombination& one) {
                                     return std::find(one.members.begin(), one.members.end(),
                                                      number.name) != one.members.end();
                                   });
    if (named) continue;
    std::string known = ": the records do not determine it";
    if (number.at_least)
      known = " at least " + format_number(*number.at_least, 3) + ", with no upper limit";
    if (number.at_most)
      known = " at most " + format_number(*number.at_most, 3) + ", with no lower limit";
    combinations.push_back({{number.name}, number.name + known});
  }
}

}  // namespace lacuna
