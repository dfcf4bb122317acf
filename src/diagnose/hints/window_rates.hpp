// SPDX-License-Identifier: MIT
// Rates of change in short windows of records, as they were measured and as a model has them:
// the weak form. No derivative is taken of a measured value and no state is estimated, so that
// it also works where the model is far off.
#pragma once

#include <functional>
#include <vector>

#include "lacuna/model/equations/ode_model.hpp"
#include "lacuna/records/binding/bound_records.hpp"

namespace lacuna {

/// A window of samples of one record.
struct RateWindow {
  std::size_t record = 0;
  Index first = 0;  ///< its first sample
};

/// Windows of equal numbers of samples.
struct RateWindows {
  Index half_width = 4;  ///< W: a window has 2W+1 samples
  std::vector<RateWindow> windows;

  Index count() const noexcept { return static_cast<Index>(windows.size()); }
  Index samples() const noexcept { return 2 * half_width + 1; }
};

/// What fewer windows show may be chance.
inline constexpr Index kFewestWindows = 20;

/// The shortest windows, of 9 samples or more, in which the rates of all measured states stand
/// out from their noise (by a factor of 20 in rms); where there are none those in which they do
/// most. Windows with a marked sample (outlier, missing, clipped) or a gap in time are
/// left out; those with marked samples only where others remain.
RateWindows rate_windows(const BoundRecords& records);

/// -integral(phi' x dt) / integral(phi dt) in each window, windows x m: with phi = (1-s^2)^3, s
/// from -1 to 1 along the window, the mean of dx/dt with the weights phi (Messenger and Bortz,
/// Multiscale Model. Simul. 19:1474, 2021). Straight lines have their slope exactly.
Matrix window_rates(const Dataset& data, const RateWindows& windows);

/// Writes values of one sample of a record.
using SampleValues = std::function<void(const Trajectory& record, Index sample, double* out)>;

/// integral(phi g dt) / integral(phi dt) of q functions in each window, windows x q.
Matrix window_means(const Dataset& data, const RateWindows& windows, Index functions,
                    const SampleValues& values);

/// The means of the rates of a model that has no delays, windows x m.
Matrix model_rates(const OdeModel& model, const Dataset& data, const RateWindows& windows);

/// The means of the terms of one equation of a model that has no delays, windows x terms.
Matrix term_means(const OdeModel& model, Index equation, const Dataset& data,
                  const RateWindows& windows);

/// Variance of the noise of window_rates(), m entries; 0 for states that were not measured.
Vector rate_noise(const BoundRecords& records, const RateWindows& windows);

}  // namespace lacuna
