// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/diagnose/hypotheses/hypothesis.hpp"

namespace lacuna {

inline constexpr StageInfo kBrokenIdentity{"broken-identity",
                                           "An identity dq/dt = v does not hold in what was "
                                           "measured: a sensor has an offset or a gain",
                                           ""};

/// Identities that the records contradict are equations like others: they may be disturbed, and
/// their coefficient is fitted. There is reason to doubt where the noise of a channel, white
/// and with a memory, comes out larger than its samples show against their neighbours.
class BrokenIdentity final : public Configured<Hypothesis, NoOptions<kBrokenIdentity>> {
 public:
  using Configured::Configured;

 private:
  Phase do_phase() const override { return Phase::Assumptions; }
  int do_order() const override { return 1; }
  Proposals do_propose(const Problem& problem, const CompositeModel& best) const override;
};

inline constexpr StageInfo kHeldCoefficients{
    "held-coefficients", "Coefficients that the model holds fixed are not what it says", ""};

/// Coefficients that the model holds (`"fixed": true`, or a bare term beside free parameters) are
/// taken as they are, and a force that was measured with a gain then looks like a nonlinear one.
/// Where something is missing, those of equations that are no identities are fitted; the ones that
/// come out significantly other than the model says stay free, and effects are sought again.
class HeldCoefficients final : public Configured<Hypothesis, NoOptions<kHeldCoefficients>> {
 public:
  using Configured::Configured;

 private:
  Phase do_phase() const override { return Phase::Assumptions; }
  Proposals do_propose(const Problem& problem, const CompositeModel& best) const override;
};

}  // namespace lacuna
