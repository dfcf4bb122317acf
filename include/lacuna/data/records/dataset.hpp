// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lacuna/core/base/types.hpp"
#include "lacuna/data/records/hold.hpp"
#include "lacuna/data/records/trajectory.hpp"

namespace lacuna {

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
