// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/diagnose/hypotheses/hypothesis.hpp"

namespace lacuna {

inline constexpr StageInfo kUnmeasuredInputHypothesis{
    "unmeasured-input", "Something acts from outside that was not recorded",
    "Ornstein-Uhlenbeck process as a state; Gelb, Applied Optimal Estimation (1974), Ch. 4.5"};

/// Where effects leave something over, an Ornstein-Uhlenbeck process in the equation with the
/// most structure may explain the records better than they do. It gets its name when it leaves
/// nothing over and what moves it has nothing to do with what was recorded: no function of the
/// variables determines what it does next, and neither earlier values of the variables nor such
/// a process times a variable explain the records better. Otherwise the effects, which explain
/// less than it, lose their names.
class UnmeasuredInput final
    : public Configured<Hypothesis, NoOptions<kUnmeasuredInputHypothesis>> {
 public:
  using Configured::Configured;

 private:
  Phase do_phase() const override { return Phase::Revision; }
  int do_order() const override { return 2; }
  Proposals do_propose(const Problem& problem, const CompositeModel& best) const override;
};

}  // namespace lacuna
