// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <variant>
#include <vector>

#include "lacuna/core/base/options.hpp"
#include "lacuna/diagnose/hypotheses/composite_model.hpp"

namespace lacuna {

/// The criterion decides, by so much at least over the best composite model so far, in its
/// units.
struct ByCriterion {
  double lead = 0.0;
};

/// A rule decides: the composite model takes the place of the best one whatever the criterion
/// says.
struct ByRule {
  std::string why;
};

/// A composite model that a hypothesis puts forward.
struct Proposal {
  CompositeModel composite;
  /// Effects are sought on its baseline before it is judged, not only after it has won.
  bool search_first = false;
  std::variant<ByCriterion, ByRule> judged = ByCriterion();
};

/// What a hypothesis has to say of records.
struct Proposals {
  std::vector<Proposal> composites;
  std::vector<Rival> trail;  ///< what it looked at on the way
};

/// Plug point: one kind of explanation of why a model and records disagree. It proposes
/// composite models of the records; all are fitted alike and judged by one criterion.
class Hypothesis : public StageInterface {
 public:
  static constexpr std::string_view kKind = "hypothesis";

  /// What a hypothesis changes, in the order in which hypotheses are judged.
  enum class Phase {
    Effects,      ///< what is missing under given assumptions
    Revision,     ///< what else may be in the place of what was found
    Assumptions,  ///< what is assumed of the records; effects are sought again on top
    Residual,     ///< the residual when nothing more gets a name
  };

  Phase phase() const { return do_phase(); }  ///< when it is judged

  /// Among those of one phase the smaller number comes first; equal ones by name.
  int order() const { return do_order(); }

  /// Composite models that rival the best so far. None where there is no reason to look for
  /// one.
  /// @throws Cancelled, and what fitting throws.
  Proposals propose(const Problem& problem, const CompositeModel& best) const {
    problem.context.check_stop();
    return do_propose(problem, best);
  }

 private:
  virtual Phase do_phase() const = 0;
  virtual int do_order() const { return 0; }
  virtual Proposals do_propose(const Problem& problem, const CompositeModel& best) const = 0;
};

/// The given hypotheses in the order in which they are judged.
std::vector<Stage<Hypothesis>> in_order(std::vector<Stage<Hypothesis>> hypotheses);

}  // namespace lacuna
