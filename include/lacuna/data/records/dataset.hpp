// SPDX-License-Identifier: MIT
// Records of a system: samples at times, their columns, and how inputs go on between samples.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lacuna/core/base/types.hpp"
#include "lacuna/core/numerics/sampled_signal.hpp"

namespace lacuna {

/// One uninterrupted record: n samples of m states and p inputs at strictly increasing times.
struct Trajectory {
  std::string source;  ///< where it comes from, for messages: "run.csv", "run.csv, record 2"
  Vector time;         ///< n, in the time unit of the dataset
  Matrix states;       ///< n x m
  Matrix inputs;       ///< n x p; n x 0 without inputs
  Matrix derivatives;  ///< n x m, dx/dt at the samples; 0 x 0 when they are not known
  Matrix marks = {};   ///< n x m, what each sample shows of its state (Mark); 0 x 0: its value

  /// Number of samples n.
  Index samples() const noexcept { return time.size(); }

  /// Whether dx/dt came with the data.
  bool has_derivatives() const noexcept { return derivatives.size() > 0; }

  /// Time from the first sample to the last; there must be one.
  double duration() const noexcept { return time[time.size() - 1] - time[0]; }
};

/// Mean of the sampling steps.
/// @throws ArgumentError when there are fewer than two samples or it is not a finite number.
double mean_step(const Trajectory& trajectory);

/// The common sampling step of a record.
/// @return nothing when steps differ by more than `tolerance` times the mean step, when there
/// are
///   fewer than two samples, or when times are not finite.
std::optional<double> uniform_step(const Trajectory& trajectory, double tolerance = 1e-3);

/// Samples [first, first + count) of a record.
/// @throws ArgumentError when they are not there, or the record has not as many rows as times.
Trajectory rows_of(const Trajectory& trajectory, Index first, Index count);

/// File that a record comes from: "run.csv" of "run.csv, record 2".
std::string file_of(const Trajectory& trajectory);

/// Whether a piece goes on where another one of the same record ("run.csv, piece 1") ends, as
/// after missing samples: it begins later, by `longest_gap` at most. A record with a number of
/// its own ("run.csv, record 2") goes on from no other, and nothing from or to no samples.
bool goes_on(const Trajectory& before, const Trajectory& after, double longest_gap);

/// How an input goes on from one sample to the next.
enum class Hold {
  Zero,       ///< the sample holds: converters, controllers, switches that act at samples
  Linear,     ///< straight lines
  Smooth,     ///< the polynomial of degree 5 through the six nearest samples
  Switching,  ///< it jumps from one sample's value to the next one's at an unknown instant
};

/// "zero", "linear", "smooth", "switching".
std::string to_string(Hold hold);

/// The hold of a name; nothing for another text.
std::optional<Hold> hold_named(std::string_view name);

/// The curve between samples: smooth where nothing is known. Of what jumps at an unknown
/// instant the line is the mean.
Interpolation interpolation_of(const std::optional<Hold>& hold);

/// Whether samples show by themselves that a signal is held: more than this fraction of them
/// are exactly as the one before, and the others are not.
/// @param values n.
bool shows_hold(const Eigen::Ref<const Vector>& values, double fraction = 0.5);

/// A named physical quantity.
struct Quantity {
  std::string name;  ///< an identifier: letters, digits, underscores
  std::string unit;  ///< "V", "rad/s"; empty when it is not known

  /// Of an input: how it goes on after a sample; nothing while that is not known.
  std::optional<Hold> hold = {};

  bool operator==(const Quantity&) const = default;
};

/// Their names, in order.
std::vector<std::string> names_of(const std::vector<Quantity>& quantities);

/// Records of one system: which quantities were measured, and one or many trajectories of them.
struct Dataset {
  std::string time_unit = "s";
  std::vector<Quantity> states;  ///< m
  std::vector<Quantity> inputs;  ///< p
  std::vector<Trajectory> trajectories;

  /// Identities known without any fit: where entry i holds j, dx_i/dt is the state x_j.
  /// Either empty or m entries.
  std::vector<std::optional<Index>> rate_of;

  /// States that were not measured but made from others (a derivative of a measured state).
  /// Either empty or m entries.
  std::vector<bool> reconstructed = {};

  /// What the reader did that a user should know of: "split at line 812: value missing".
  std::vector<std::string> notes = {};

  Index state_count() const noexcept { return static_cast<Index>(states.size()); }  ///< m
  Index input_count() const noexcept { return static_cast<Index>(inputs.size()); }  ///< p

  /// Samples of all trajectories together.
  Index samples() const noexcept;

  /// Whether every trajectory brings dx/dt.
  bool has_derivatives() const noexcept;

  /// Whether a state was measured and not made from others, as nothing else is said of it.
  bool is_measured(Index state) const noexcept {
    const auto index = static_cast<std::size_t>(state);
    return index >= reconstructed.size() || !reconstructed[index];
  }

  /// The state that is dx_i/dt by an identity, if there is one.
  std::optional<Index> rate_state(Index state) const;
};

/// The trajectory with the most samples, the first of several.
/// @throws ArgumentError when there is none.
const Trajectory& longest_record(const Dataset& data);

/// Median of the sampling steps of all trajectories.
/// @throws ArgumentError when there is none or one is not finite.
double median_step(const Dataset& data);

/// Whether a dataset without inputs has trajectories whose inputs are 0 x 0, as they are when
/// nobody has set them, instead of n x 0.
bool lacks_input_columns(const Dataset& data);

/// The dataset with n x 0 inputs where lacks_input_columns() found 0 x 0.
Dataset with_input_columns(Dataset data);

/// Checks that a dataset can be worked with: at least one trajectory, at least two samples
/// each, shapes that fit the names, names that are distinct, finite values, increasing time.
/// @throws DataError naming trajectory, column, row and remedy.
void check_dataset(const Dataset& data, int threads = 1);

/// The part of it that looks at no values but those of time.
/// @throws DataError as check_dataset().
void check_form(const Dataset& data);

/// The rest, for a dataset that has passed check_form(): whether values are finite.
/// @throws DataError as check_dataset().
void check_finite(const Dataset& data, int threads = 1);

}  // namespace lacuna
