// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/diagnose/hypotheses/hypothesis.hpp"

namespace lacuna {

inline constexpr StageInfo kSharedProcess{
    "shared-process",
    "One effect in two equations that share a process, each with its own share", ""};

/// Where states are hidden an effect of a process that two equations share (a growth that feeds
/// on something, a flow from one store into another: a term that both have) is often none in
/// either alone: the hidden state gives way to what the one lacks and contradicts the other. So
/// forms are tried in both together, by their joint gain, and the best are fitted jointly, each
/// equation with a coefficient and shapes of its own; they have to act as the process does
/// (acts_as_shared()).
class SharedProcess final : public Configured<Hypothesis, NoOptions<kSharedProcess>> {
 public:
  using Configured::Configured;

 private:
  Phase do_phase() const override { return Phase::Revision; }
  int do_order() const override { return 2; }
  Proposals do_propose(const Problem& problem, const CompositeModel& best) const override;
};

/// Whether effects in two equations may be one process: they act on both as a term of the states
/// does that both have. What the one gains by it the other loses, or both gain.
bool acts_as_shared(const OdeModel& model, const FittedEffect& one, const FittedEffect& other);

}  // namespace lacuna
