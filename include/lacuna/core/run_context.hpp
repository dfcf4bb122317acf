// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <stop_token>
#include <string_view>

#include "lacuna/core/error.hpp"

namespace lacuna {

/// How far a run has come.
struct Progress {
  std::string_view activity;  ///< what is being done, e.g. "fitting dx/dt"
  double fraction = 0.0;      ///< share of the activity that is done, 0..1
};

/// What a run is given besides data and options; passed down by const reference, owned by the
/// caller, never stored by a stage.
struct RunContext {
  std::stop_token stop{};                             ///< asks the run to end
  std::function<void(const Progress&)> progress{};    ///< told how far it is; may be empty
  int threads = 1;                                    ///< results do not depend on it
  std::uint64_t seed = 1;                             ///< of everything random in the run

  /// Tells the progress function, if there is one, and honours a stop request.
  /// @throws Cancelled when an end was asked for.
  void report(std::string_view activity, double fraction) const {
    check_stop();
    if (progress) progress(Progress{activity, fraction});
  }

  /// @throws Cancelled when an end was asked for.
  void check_stop() const {
    if (stop.stop_requested()) throw Cancelled();
  }
};

}  // namespace lacuna
