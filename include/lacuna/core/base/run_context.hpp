// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <stop_token>
#include <string_view>

#include "lacuna/core/base/error.hpp"

namespace lacuna {

/// How far a run has come.
struct Progress {
  std::string_view activity;  ///< what is being done, e.g. "fitting dx/dt"
  double fraction = 0.0;      ///< fraction of the activity that is done, 0..1
};

/// Processes that run the same program side by side, on one machine or on many, and divide the
/// passes over rows among them. All members share the same things in the same order.
class Team {
 public:
  virtual ~Team() = default;
  virtual int size() const = 0;  ///< members
  virtual int rank() const = 0;  ///< 0 leads: it goes on alone where nothing is divided

  /// Gives everybody the k numbers of one member; there are as many everywhere.
  /// @throws DataError when a member has failed.
  virtual void broadcast(std::span<double> numbers, int owner) const = 0;
};

/// What a run is given besides data and options; passed down by const reference, owned by the
/// caller, never stored by a stage.
struct RunContext {
  std::stop_token stop{};                           ///< asks the run to end
  std::function<void(const Progress&)> progress{};  ///< is given how far it is; may be empty
  int threads = 1;                                  ///< results do not depend on it
  std::uint64_t seed = 1;                           ///< of everything random in the run
  const Team* team = nullptr;                       ///< results do not depend on it

  /// When the run has to end with the answer that it has by then; none: it takes its time.
  std::optional<std::chrono::steady_clock::time_point> deadline{};

  /// Whether this process makes the result: alone, or the first of its team.
  bool leads() const { return team == nullptr || team->rank() == 0; }

  /// The same for one process.
  RunContext alone() const {
    RunContext context = *this;
    context.team = nullptr;
    return context;
  }

  /// The same without a deadline, for what every answer needs.
  RunContext unhurried() const {
    RunContext context = *this;
    context.deadline.reset();
    return context;
  }

  /// The same for one of several calls side by side: one thread, and no progress.
  RunContext beside_others() const {
    RunContext context = alone();
    context.progress = nullptr;
    context.threads = 1;
    return context;
  }

  /// Whether the deadline has passed.
  bool is_late() const {
    return deadline && std::chrono::steady_clock::now() >= *deadline;
  }

  /// Informs the progress function, if there is one, and honours a stop request.
  /// @throws Cancelled when an end was asked for; OutOfTime past the deadline.
  void report(std::string_view activity, double fraction) const {
    check_stop();
    if (progress) progress(Progress{activity, fraction});
  }

  /// @throws Cancelled when an end was asked for; OutOfTime past the deadline.
  void check_stop() const {
    if (stop.stop_requested()) throw Cancelled();
    if (is_late()) throw OutOfTime();
  }
};

}  // namespace lacuna
