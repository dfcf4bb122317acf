// SPDX-License-Identifier: MIT
#include "slip_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace lacuna {
namespace {

constexpr double kUnchanged = 1e-9;  // relative difference of a misfit that was not touched
constexpr double kProbe = 0.1;       // step of the logarithm of a factor, for its estimate

/// Everything a slip is tried on.
struct Trial {
  const OdeModel& model;
  const Dataset& data;
  const RateWindows& windows;
  Vector before;
};

/// Misfits with a slip and without it, in the same windows.
struct Comparison {
  Vector before, after;

  bool touches(Index k) const {
    return std::abs(after[k] - before[k]) > kUnchanged * before[k];
  }
};

Vector misfit_in(const Trial& trial, const Dataset& data, const RateWindows& windows) {
  return misfit(window_rates(data, windows), model_rates(trial.model, data, windows));
}

Comparison compare(const Trial& trial, const Slip& slip) {
  const Dataset data = corrected(trial.model, trial.data, slip);
  if (slip.kind != HintKind::SwappedColumns)
    return {trial.before, misfit_in(trial, data, trial.windows)};
  // A column in another place has its outliers and gaps there.
  const RateWindows windows = rate_windows(observed(data));
  return {misfit_in(trial, trial.data, windows), misfit_in(trial, data, windows)};
}

/// Mean over the touched equations of log(e_after / e_before); 0 when there are none.
double log_remainder(const Comparison& fit) {
  double sum = 0.0;
  int touched = 0;
  for (Index k = 0; k < fit.after.size(); ++k) {
    if (!fit.touches(k)) continue;
    sum += 0.5 * std::log(fit.after[k] / fit.before[k]);
    ++touched;
  }
  return touched > 0 ? sum / touched : 0.0;
}

/// Whether some equation that the slip touches is off by more than a little.
bool is_plain(const Comparison& fit, double slip_misfit) {
  for (Index k = 0; k < fit.after.size(); ++k)
    if (fit.touches(k) && fit.before[k] > slip_misfit * slip_misfit) return true;
  return false;
}

bool fits_no_worse(const Comparison& fit, double slip_harm) {
  return (fit.after.array().sqrt() <= fit.before.array().sqrt() + slip_harm).all();
}

/// Whether a slip is the other unit of an angle, degrees for radians: small swings do not
/// determine that factor, whose misfit is as little with any smaller one.
bool is_angle(const OdeModel& model, const Slip& slip) {
  constexpr double kDegree = std::numbers::pi / 180.0;  // a fact
  constexpr double kSame = 1e-6;  // a fact of rounding: one factor on the list
  const Index channel = slip.channels.front();
  if (channel >= model.dimension()) return false;
  const std::string& unit = model.states()[static_cast<std::size_t>(channel)].unit;
  return (unit == "rad" && std::abs(slip.correction / kDegree - 1.0) < kSame) ||
         (unit == "deg" && std::abs(slip.correction * kDegree - 1.0) < kSame);
}

/// Whether the factor that the records determine, from the parabola through the logarithms of
/// three misfits, is the one on the list, and whether they say one at all. Of the logarithms
/// the equation that says most decides, and not one that lacks something.
bool is_said(const Trial& trial, const Slip& slip, const Comparison& fit, double round_factor) {
  if (slip.kind != HintKind::TimeUnit && slip.kind != HintKind::ChannelUnit) return true;
  if (slip.kind == HintKind::ChannelUnit && is_angle(trial.model, slip)) return true;
  const auto at = [&](double step) {
    Slip near = slip;
    near.correction *= std::exp(step);
    const Vector misfit = compare(trial, near).after;
    double sum = 0.0;
    for (Index k = 0; k < misfit.size(); ++k)
      if (fit.touches(k)) sum += std::log(misfit[k]);
    return sum;
  };
  const double low = at(-kProbe), middle = at(0.0), high = at(kProbe);
  const double curvature = (low - 2.0 * middle + high) / (kProbe * kProbe);
  const double slope = (high - low) / (2.0 * kProbe);
  return std::abs(slope) < round_factor * std::abs(std::log(slip.correction)) * curvature;
}

double column_misfit(const Vector& measured, const Vector& modelled) {
  double apart = 0.0, size = 0.0;
  Index finite = 0;
  for (Index i = 0; i < measured.size(); ++i) {
    const double y = measured[i], f = modelled[i];
    if (!std::isfinite(f)) continue;
    ++finite;
    apart += (y - f) * (y - f);
    size += y * y + f * f;
  }
  if (finite == 0 || 10 * finite < 9 * measured.size() || !std::isfinite(size)) return 2.0;
  // What is less than rounding is no better.
  constexpr double kRounding = std::numeric_limits<double>::epsilon();
  return size > 0.0 ? std::max(apart / size, kRounding) : kRounding;
}

struct TriedSlip {
  std::size_t number;  ///< on the list
  double level;        ///< mean over all equations of log(e)
  Vector after;
};

std::vector<TriedSlip> candidates(const Trial& trial, const std::vector<Slip>& slips,
                                  const HintOptions& options) {
  std::vector<TriedSlip> result;
  if (trial.before.maxCoeff() <= options.slip_misfit * options.slip_misfit) return result;
  for (std::size_t i = 0; i < slips.size(); ++i) {
    Comparison fit = compare(trial, slips[i]);
    if (log_remainder(fit) > std::log(options.slip_remainder)) continue;
    if (!is_plain(fit, options.slip_misfit) || !fits_no_worse(fit, options.slip_harm)) continue;
    if (!is_said(trial, slips[i], fit, options.round_factor)) continue;
    const double level = 0.5 * fit.after.array().log().mean();
    result.push_back({i, level, std::move(fit.after)});
  }
  return result;
}

}  // namespace

Vector misfit(const Matrix& measured, const Matrix& modelled) {
  Vector result(measured.cols());
  for (Index k = 0; k < measured.cols(); ++k)
    result[k] = column_misfit(measured.col(k), modelled.col(k));
  return result;
}

std::optional<FoundSlip> find_slip(const OdeModel& model, const Dataset& data,
                                   const RateWindows& windows, const HintOptions& options) {
  const Trial trial{model, data, windows,
                    misfit(window_rates(data, windows), model_rates(model, data, windows))};
  const std::vector<Slip> slips = possible_slips(model, data);
  std::vector<TriedSlip> all = candidates(trial, slips, options);
  if (all.empty()) return std::nullopt;
  const auto channels = [&](const TriedSlip& one) { return slips[one.number].channels; };
  const double least =
      std::min_element(all.begin(), all.end(), [](const TriedSlip& a, const TriedSlip& b) {
        return a.level < b.level;
      })->level;
  std::erase_if(all, [&](const TriedSlip& one) {
    return one.level > least + std::log(options.slip_alike);
  });
  // Of the same channels the plainest factor.
  std::vector<TriedSlip> plain;
  for (TriedSlip& one : all)
    if (std::none_of(plain.begin(), plain.end(), [&](const TriedSlip& other) {
          return slips[other.number].kind == slips[one.number].kind &&
                 channels(other) == channels(one);
        }))
      plain.push_back(std::move(one));
  std::stable_sort(plain.begin(), plain.end(), [&](const TriedSlip& a, const TriedSlip& b) {
    return std::pair(channels(a).size(), a.level) < std::pair(channels(b).size(), b.level);
  });
  FoundSlip found{slips[plain.front().number], trial.before, plain.front().after};
  for (std::size_t i = 1; i < plain.size(); ++i)
    if (channels(plain[i]).size() <= std::max<std::size_t>(1, found.slip.channels.size()))
      found.others.push_back(slips[plain[i].number]);
  return found;
}

}  // namespace lacuna
