// SPDX-License-Identifier: MIT
#include "derivative_agreement.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/check.hpp"
#include "core/statistics/robust_statistics.hpp"
#include "data/records/check_record.hpp"

namespace lacuna {
namespace {

/// Decisions (docs/decisions/numbers.md): what is explained to this factor agrees; what is
/// explained is at most this fraction of the changes, where they show something; differences of
/// this fraction are none.
constexpr double kExplained = 3.0, kMostExplained = 0.1, kNoDifference = 1e-3;

/// Facts of statistics and cost: windows of which a median is taken, parts of them that are
/// compared, and windows of one length that are looked at (of more, every n-th).
constexpr Index kFewestWindows = 10, kMostParts = 10, kMostWindows = 100000;

/// Windows of one length.
struct Windows {
  std::vector<double> difference;  ///< |change of c - integral of d|
  std::vector<double> explained;
  double squares = 0.0;  ///< of the changes of c

  Index count() const { return static_cast<Index>(difference.size()); }
};

/// What makes a column and its derivative disagree.
struct Errors {
  double value_noise = 0.0, derivative_noise = 0.0;
  double late_by = 0.0;  ///< steps by which the derivative may be early or late
};

/// Integral from the first sample, over each interval or over every two.
Vector integral(const Vector& time, const Vector& rate, Index stride) {
  Vector sum = Vector::Zero(time.size());
  for (Index i = stride; i < time.size(); ++i)
    sum[i] =
        sum[i - stride] + 0.5 * (time[i] - time[i - stride]) * (rate[i] + rate[i - stride]);
  return sum;
}

void add_windows(const Vector& time, const Vector& value, const Vector& rate,
                 const Errors& errors, Index length, Index stride, Windows& windows) {
  const Vector fine = integral(time, rate, 1), coarse = integral(time, rate, 2);
  for (Index i = 0; i + length < time.size(); i += stride) {
    const Index end = i + length;
    const double step = (time[end] - time[i]) / static_cast<double>(length);
    const double change = value[end] - value[i], area = fine[end] - fine[i];
    const double sampling = std::abs(area - (coarse[end] - coarse[i])) +
                            errors.late_by * step * std::abs(rate[end] - rate[i]);
    const double random =
        std::hypot(std::sqrt(2.0) * errors.value_noise,
                   errors.derivative_noise * step * std::sqrt(static_cast<double>(length)));
    windows.difference.push_back(std::abs(change - area));
    windows.explained.push_back(std::hypot(random, sampling));
    windows.squares += change * change;
  }
}

/// The median of one of `parts` equal parts.
double median_of_part(const std::vector<double>& values, Index part, Index parts) {
  const auto size = static_cast<Index>(values.size());
  return median({values.begin() + part * size / parts,
                 values.begin() + (part + 1) * size / parts});
}

enum class Answer { Nothing, Agrees, Differs };

Answer compare(const Windows& windows) {
  const double change = std::sqrt(windows.squares / static_cast<double>(windows.count()));
  if (!(median(windows.explained) <= kMostExplained * change)) return Answer::Nothing;
  const Index parts = std::min(kMostParts, windows.count() / kFewestWindows);
  for (Index part = 0; part < parts; ++part)
    if (!(median_of_part(windows.difference, part, parts) <=
          kExplained * median_of_part(windows.explained, part, parts) + kNoDifference * change))
      return Answer::Differs;
  return Answer::Agrees;
}

/// Whether some windows agree and none differ.
bool agree(const Dataset& data, Index derivative, Index of, const Errors& errors) {
  Index longest = 0;
  for (const Trajectory& record : data.trajectories)
    longest = std::max(longest, record.samples());
  const Index stride = 1 + data.samples() / kMostWindows;
  bool some_agree = false;
  for (Index length = 2; length < longest; length *= 2) {
    Windows windows;
    for (const Trajectory& record : data.trajectories)
      add_windows(record.time, record.states.col(of), record.states.col(derivative), errors,
                  length, stride, windows);
    if (windows.count() < kFewestWindows) break;
    const Answer answer = compare(windows);
    if (answer == Answer::Differs) return false;
    some_agree = some_agree || answer == Answer::Agrees;
  }
  return some_agree;
}

/// Whether all samples of a state and their times are finite.
bool is_finite(const Dataset& data, Index state) {
  return std::all_of(data.trajectories.begin(), data.trajectories.end(),
                     [&](const Trajectory& record) {
                       return record.states.col(state).allFinite() && record.time.allFinite();
                     });
}

}  // namespace

bool is_derivative(const Dataset& data, const std::vector<StateNoise>& noise, Index derivative,
                   Index of) {
  check_columns(data, "is_derivative");
  check_argument(static_cast<Index>(noise.size()) == data.state_count(), "is_derivative",
                 "the noise of some states is missing", "give that of each (analyse_noise())");
  for (const Index state : {derivative, of})
    check_number(state, data.state_count(), "is_derivative", "state");
  if (!is_finite(data, derivative) || !is_finite(data, of)) return false;
  Errors errors{noise[static_cast<std::size_t>(of)].sigma,
                noise[static_cast<std::size_t>(derivative)].sigma};
  if (agree(data, derivative, of, errors)) return true;
  errors.late_by = 0.5;
  return agree(data, derivative, of, errors);
}

}  // namespace lacuna
