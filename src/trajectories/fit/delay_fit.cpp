// SPDX-License-Identifier: MIT
#include "delay_fit.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <utility>

#include "fit_solver.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/core/statistics/interval.hpp"

namespace lacuna {
namespace {

SystemModel with_value(const SystemModel& system, std::size_t parameter, double value) {
  std::vector<Parameter> parameters = system.parameters();
  parameters[parameter].value = value;
  return {system.symbolic(), std::move(parameters)};
}

/// Where a delay is sought.
struct DelayRange {
  double low = 0.0, high = 0.0;
};

DelayRange range_of(const Parameter& delay) {
  constexpr double kReach = 4.0;  // times what was given, where nobody gave a range
  return {std::max(delay.min.value_or(0.0), 0.0), delay.max.value_or(kReach * delay.value)};
}

/// One fit and what it is worth.
struct Tried {
  double value = 0.0;
  double deviance = INFINITY;  ///< -2 log likelihood
  std::vector<FittedParameter> numbers = {};
  Vector log_likelihood = {};  ///< of each value, records one behind the other
};

/// The log-likelihood of each value of the records, in the order of time in each.
Vector likelihood_in_time(const Fit& fit) {
  std::vector<double> all;
  for (const FitRun& run : fit.runs)
    for (Index n = 0; n < run.log_likelihood.rows(); ++n)
      for (const double one : run.log_likelihood.row(n))
        if (std::isfinite(one)) all.push_back(one);
  return Eigen::Map<const Vector>(all.data(), static_cast<Index>(all.size()));
}

/// What is known of a delay before any record is seen, as -2 log of its density.
double prior_deviance(const Parameter& given, double value) {
  if (given.deviation) return std::pow((value - given.value) / *given.deviation, 2);
  if (given.factor) return std::pow(std::log(value / given.value) / std::log(*given.factor), 2);
  return 0.0;
}

/// Whether the value of a parameter is also the mean of what is known before.
bool is_known_before(const Parameter& parameter) {
  return parameter.deviation || parameter.factor;
}

/// The profile of the likelihood over one delay. Each fit begins at the numbers of the best so
/// far.
class DelayProfile {
 public:
  /// @param given the delay as the model has it.
  DelayProfile(SystemModel system, std::size_t parameter, const Parameter& given,
               const FitOptions& options, const RunContext& context,
               const FitOfKnownDelays& fit_known)
      : system_(std::move(system)),
        parameter_(parameter),
        given_(given),
        options_(options),
        context_(context),
        fit_known_(fit_known) {
    options_.rough = true;
    options_.restarts = 0;
    options_.starts = 0;
    options_.effort = Thoroughness::Quick;
    options_.profile = options_.bands = false;
  }

  const SystemModel& best_system() const { return system_; }
  const Tried& best() const { return best_; }

  Tried at(double value) {
    context_.check_stop();
    Tried tried{value};
    try {
      const SystemModel held = with_delays_held(with_value(system_, parameter_, value));
      const Fit fit = fit_known_(held, options_);
      tried.deviance = -2.0 * fit.log_likelihood + prior_deviance(given_, value);
      tried.numbers = fit.numbers;
      tried.log_likelihood = likelihood_in_time(fit);
      if (tried.deviance < best_.deviance) {
        best_ = tried;
        system_ = with_estimates(fit.model, value);
      }
    } catch (const DataError&) {
      // no free run is finite with this delay
    }
    return tried;
  }

 private:
  /// The numbers of a fit in the system whose delays are free.
  SystemModel with_estimates(const SystemModel& fitted, double value) const {
    std::vector<Parameter> parameters = system_.parameters();
    for (std::size_t i = 0; i < parameters.size(); ++i)
      if (fitted.parameters()[i].free && !is_known_before(parameters[i]))
        parameters[i].value = fitted.parameters()[i].value;
    parameters[parameter_].value = value;
    return {fitted.symbolic(), std::move(parameters)};
  }

  SystemModel system_;
  std::size_t parameter_;
  Parameter given_;
  FitOptions options_;
  const RunContext& context_;
  const FitOfKnownDelays& fit_known_;
  Tried best_;
};

/// A delay at its best, and what the others do about it.
struct KnownDelay {
  double error = INFINITY;          ///< standard error by the likelihood of independent values
  double memory = 1.0;              ///< what its variance grows by where they are not
  std::vector<double> slopes = {};  ///< d number / d delay of the other numbers
};

/// Between the neighbours of the best point of a grid.
void search_range(DelayProfile& profile, const DelayRange& range, double given) {
  constexpr int kPoints = 12, kBits = 12;  // of the grid, and of the minimum between neighbours
  const double apart = (range.high - range.low) / kPoints;
  profile.at(given);
  for (int i = 0; i <= kPoints; ++i) profile.at(std::min(range.high, range.low + i * apart));
  const double low = std::max(range.low, profile.best().value - apart);
  const double high = std::min(range.high, profile.best().value + apart);
  boost::math::tools::brent_find_minima(
      [&](double value) { return profile.at(value).deviance; }, low, high, kBits);
}

/// The scatter of the sums of scores over blocks of neighbouring values, times a variance that
/// takes the values as independent: what that grows by. A prior has no scatter.
double scatter_of(const Vector& scores, double variance) {
  const Index blocks = std::min(kGradientBlocks, scores.size());
  if (blocks < 2) return 1.0;
  Vector sums = Vector::Zero(blocks);
  for (Index i = 0; i < scores.size(); ++i) sums[i * blocks / scores.size()] += scores[i];
  return variance * sums.squaredNorm() * static_cast<double>(blocks) /
         static_cast<double>(blocks - 1);
}

/// By the parabola through two points at which the deviance is about one higher.
KnownDelay known_at(DelayProfile& profile, const DelayRange& range) {
  constexpr int kTurns = 3;
  KnownDelay known;
  double away = 1e-3 * (range.high - range.low);
  for (int turn = 0; turn < kTurns; ++turn) {
    const Tried best = profile.best();
    away = std::min({away, best.value - range.low, range.high - best.value});
    if (!(away > 0.0)) return known;  // at an end of the range
    const Tried less = profile.at(best.value - away), more = profile.at(best.value + away);
    const double bend = less.deviance + more.deviance - 2.0 * profile.best().deviance;
    if (!(bend > 0.0) || !std::isfinite(bend)) return known;
    known.error = away * std::sqrt(2.0 / bend);
    if (more.log_likelihood.size() == less.log_likelihood.size())
      known.memory = scatter_of((more.log_likelihood - less.log_likelihood) / (2.0 * away),
                                known.error * known.error);
    known.slopes.clear();
    for (std::size_t i = 0; i < best.numbers.size(); ++i)
      known.slopes.push_back((more.numbers[i].value - less.numbers[i].value) / (2.0 * away));
    if (std::abs(std::log(away / known.error)) < std::log(2.0)) break;
    away = known.error;
  }
  return known;
}

/// A number whose interval holds what a delay adds.
void widen(double added, double quantile, FittedParameter& number) {
  if (number.standard_error) number.standard_error = std::hypot(*number.standard_error, added);
  if (!number.ci95) return;
  const double more = quantile * added;
  auto& [low, high] = *number.ci95;
  low = number.value - std::hypot(number.value - low, more);
  high = number.value + std::hypot(high - number.value, more);
}

/// The standard error of a delay beside a fit of the other numbers, as those have theirs: the
/// variance of the noise with the degrees of freedom of the fit, and by the gradients of blocks
/// where residuals are not white.
double error_of(const KnownDelay& known, const Fit& fit, double freedom) {
  double values = 0.0, variance = known.error * known.error;
  bool white = true, is_estimated = true;
  for (const FitQuality& channel : fit.quality) {
    values += static_cast<double>(channel.samples + channel.censored);
    white = white && channel.white;
    is_estimated = is_estimated && channel.sizes > 0;
  }
  if (is_estimated) variance *= values / freedom;
  if (!white) variance *= known.memory;
  return std::sqrt(variance);
}

FittedParameter fitted_delay(const Parameter& given, double value, const DelayRange& range,
                             double error, double freedom) {
  FittedParameter number{
      .name = given.name, .unit = given.unit, .start = given.value, .value = value};
  const double near = 1e-3 * (range.high - range.low);
  if (given.min && value - range.low < near) number.bound = "min";
  if (given.max && range.high - value < near) number.bound = "max";
  if (!std::isfinite(error)) return number;
  number.standard_error = error;
  number.ci95 = interval95(value, error, student_quantile_975(freedom));
  (*number.ci95)[0] = std::max((*number.ci95)[0], range.low);
  return number;
}

/// The place of a parameter among the numbers of a fit: behind coefficients and free parameters
/// that come before it.
std::size_t place_of(const Fit& fit, const SystemModel& system, std::size_t parameter) {
  std::size_t free = 0, before = 0;
  for (std::size_t i = 0; i < system.parameters().size(); ++i) {
    const bool is_number = fit.model.parameters()[i].free;
    free += is_number;
    before += is_number && i < parameter;
  }
  return fit.numbers.size() - free + before;
}

}  // namespace

SystemModel with_delays_held(const SystemModel& system) {
  std::vector<Parameter> parameters = system.parameters();
  for (const std::size_t i : system.delay_parameters()) {
    parameters[i].free = false;
    parameters[i].deviation.reset();
    parameters[i].factor.reset();
  }
  return {system.symbolic(), std::move(parameters)};
}

Fit fit_with_delays(const SystemModel& system, const FitOptions& options,
                    const RunContext& context, const FitOfKnownDelays& fit_known) {
  constexpr int kRounds = 3;  // a bound: delays that go to and fro
  const std::vector<std::size_t> delays = system.delay_parameters();
  for (const std::size_t i : delays)
    if (system.parameters()[i].per_record || system.parameters()[i].varies)
      throw ModelError("parameter " + system.parameters()[i].name,
                       "a delay that differs from record to record cannot be estimated",
                       "let all records share it, or fit them one by one");
  SystemModel best = system;
  std::vector<KnownDelay> known(delays.size());
  for (int round = 0; round < (delays.size() > 1 ? kRounds : 1); ++round) {
    bool moved = false;
    for (std::size_t d = 0; d < delays.size(); ++d) {
      const DelayRange range = range_of(system.parameters()[delays[d]]);
      const double before = best.parameters()[delays[d]].value;
      DelayProfile profile(best, delays[d], system.parameters()[delays[d]], options, context,
                           fit_known);
      search_range(profile, range, before);
      known[d] = known_at(profile, range);
      best = profile.best_system();
      moved = moved || std::abs(profile.best().value - before) > 0.1 * known[d].error;
    }
    if (!moved) break;
  }
  Fit result = fit_known(with_delays_held(best), options);
  result.degrees_of_freedom =
      std::max(1.0, result.degrees_of_freedom - static_cast<double>(delays.size()));
  const double freedom = result.degrees_of_freedom;
  for (KnownDelay& one : known) one.error = error_of(one, result, freedom);
  std::vector<Parameter> parameters = result.model.parameters();
  for (const KnownDelay& one : known)
    for (std::size_t i = 0; i < one.slopes.size(); ++i)
      widen(std::abs(one.slopes[i]) * one.error, student_quantile_975(freedom),
            result.numbers[i]);
  for (std::size_t d = 0; d < delays.size(); ++d) {
    const Parameter& given = system.parameters()[delays[d]];
    FittedParameter number = fitted_delay(given, best.parameters()[delays[d]].value,
                                          range_of(given), known[d].error, freedom);
    parameters[delays[d]].free = true;
    parameters[delays[d]].deviation.reset();
    parameters[delays[d]].factor.reset();
    parameters[delays[d]].standard_error = number.standard_error;
    parameters[delays[d]].ci95 = number.ci95;
    const auto place = static_cast<std::ptrdiff_t>(place_of(result, system, delays[d]));
    result.numbers.insert(result.numbers.begin() + place, std::move(number));
    result.model = {result.model.symbolic(), parameters};
  }
  return result;
}

}  // namespace lacuna
