// SPDX-License-Identifier: MIT
#include "diagnose/hypotheses/sensor_fault.hpp"

#include <algorithm>

#include "diagnose/hypotheses/named_effects.hpp"

namespace lacuna {
namespace {

bool has_fault(const CompositeModel& composite) {
  return !composite.explanation.fit.channel_terms.empty();
}

/// Whether an effect is one of the measurement.
bool is_fault(const Effect& effect, const Scope& scope) {
  for (Index k = 0; k < scope.model.dimension(); ++k)
    for (const Candidate& candidate : effect.candidates(scope, k))
      if (candidate.place == Place::Channel) return true;
  return false;
}

}  // namespace

Proposals SensorFault::do_propose(const Problem& problem, const CompositeModel& best) const {
  if (!has_fault(best) || !leaves_structure(best, problem.options.decision)) return {};
  std::vector<Stage<Effect>> dynamics = problem.options.effects;
  std::erase_if(dynamics, [&](const Stage<Effect>& effect) {
    return is_fault(*effect, best.base->scope);
  });
  SearchedComposite found = searched(problem, best.base, dynamics);
  CompositeModel& other = found.composite;
  other.hypothesis = info().name;
  if (!closes_most(other, problem))
    return {{},
            {{std::string(info().name),
              "effects of the dynamics alone",
              {},
              false,
              "effects that explain most",
              0.0,
              1.0}}};
  other.rounds.insert(other.rounds.begin(), best.rounds.begin(), best.rounds.end());
  Proposal proposal{std::move(other)};
  proposal.judged = ByRule{
      "a fault of the measurement leaves structure; effects of the dynamics alone explain "
      "most"};
  return {{std::move(proposal)}, std::move(found.rivals)};
}

}  // namespace lacuna
