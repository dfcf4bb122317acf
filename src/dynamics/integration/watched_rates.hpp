// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/dynamics/integration/integrator.hpp"

namespace lacuna {

/// Rates that end a run which is to end: there may be any number of steps between two samples.
/// Neither the rates nor the context are owned.
class WatchedRates {
 public:
  WatchedRates(RightHandSide rates, const RunContext& context)
      : rates_(rates), context_(context) {}

  /// dx/dt at t and x. @throws Cancelled, OutOfTime as RunContext::check_stop().
  void operator()(double t, const double* x, double* dxdt) {
    constexpr int kBetweenLooks = 256;  // a fact of cost: a look takes as long as some rates
    if (++count_ % kBetweenLooks == 0) context_.check_stop();
    rates_(t, x, dxdt);
  }

 private:
  RightHandSide rates_;
  const RunContext& context_;
  unsigned count_ = 0;
};

}  // namespace lacuna
