// SPDX-License-Identifier: MIT
#include "short_list.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "core/statistics/significance.hpp"
#include "diagnose/candidates/search_memory.hpp"
#include "forms/candidate/nesting.hpp"
#include "search_starts.hpp"

namespace lacuna {
namespace {

/// Whether one effect proposes both.
bool are_of_one_family(const Candidate& a, const Candidate& b) {
  return std::any_of(a.families.begin(), a.families.end(), [&](const std::string& family) {
    return std::find(b.families.begin(), b.families.end(), family) != b.families.end();
  });
}

/// Whether an effect that is there covers a candidate: the same form with other numbers,
/// another memory of the same variable, or what it has as a special case.
bool covers(const Candidate& adopted, const Candidate& candidate, const Scope& scope) {
  if (!in_one_place(adopted, candidate) || candidate.repeats) return false;
  const bool both_remember = !adopted.memory.empty() && !candidate.memory.empty() &&
                             are_of_one_family(adopted, candidate);
  return both_remember || are_one_form(adopted, candidate) ||
         nests(adopted, candidate, candidate.starts.front(), scope);
}

/// Whether something acts in an identity. That dx/dt = v is what v means: the records contradict
/// it where sensors of the two differ, and nothing but an offset between them is of this form.
bool acts_in_identity(const Candidate& candidate, const Scope& scope) {
  return candidate.place == Place::Rate && scope.is_identity(candidate.equation) &&
         !(candidate.memory.empty() && candidate.form.variables().empty());
}

/// Whether a candidate is for the search: not a free input, not in an equation that holds
/// exactly or by definition, not covered by what is there.
bool is_searched(const Candidate& candidate, const Explanation& current, const Scope& scope) {
  const bool exact = current.fit.noise.disturbance[candidate.equation] == 0.0;
  if (candidate.is_driven() || (candidate.place == Place::Rate && exact) ||
      acts_in_identity(candidate, scope))
    return false;
  return std::none_of(
      current.effects.begin(), current.effects.end(),
      [&](const FittedEffect& adopted) { return covers(adopted.candidate, candidate, scope); });
}

/// Whether a candidate is a function of an input that never changes: whatever it says of that
/// input is a constant's.
bool is_of_still_input(const Candidate& candidate, const Scope& scope) {
  return std::any_of(scope.variables.begin(), scope.variables.end(),
                     [&](const VariableRange& range) {
                       return range.is_input && !(range.high > range.low) &&
                              candidate.depends_on(range.name);
                     });
}

/// Starts at the shapes that effects of the same form have in other equations as well: what acts
/// between two stores acts on both alike.
Candidate with_shared_starts(Candidate candidate, const Explanation& current) {
  for (const FittedEffect& effect : current.effects) {
    Candidate here = effect.candidate;
    here.equation = candidate.equation;
    const bool is_elsewhere = effect.candidate.equation != candidate.equation;
    if (effect.shapes.size() == 0 || !is_elsewhere || !are_one_form(here, candidate)) continue;
    Vector start = effect.shapes;
    for (Index s = 0; s < start.size(); ++s) {
      const ShapeParameter& range = candidate.shapes[static_cast<std::size_t>(s)];
      start[s] = std::clamp(start[s], range.low, range.high);
    }
    candidate.starts.push_back(std::move(start));
  }
  return candidate;
}

std::vector<Candidate> all_candidates(const EffectSearch& search, const Explanation& current) {
  const Scope& scope = search.base.scope;
  std::vector<Candidate> proposed;
  for (const Stage<Effect>& effect : search.effects)
    for (Index k = 0; k < scope.model.dimension(); ++k)
      for (Candidate& candidate : effect->candidates(scope, k))
        proposed.push_back(std::move(candidate));
  std::vector<Candidate> result;
  const std::vector<std::string> taken = current.fit.model.variables().names();
  const auto is_shut_out = [&](const Candidate& candidate) {
    if (search.only_plain && candidate.intricacy() > 0) return true;
    return std::any_of(
        search.without.begin(), search.without.end(), [&](const Candidate& other) {
          return in_one_place(other, candidate) && candidate.intricacy() >= other.intricacy() &&
                 are_of_one_family(other, candidate);
        });
  };
  for (Candidate& candidate : merged(proposed))
    if (search.has_room(current, 1 + static_cast<Index>(candidate.shapes.size())) &&
        is_searched(candidate, current, scope) && !is_of_still_input(candidate, scope) &&
        !is_shut_out(candidate))
      result.push_back(
          with_shared_starts(without_clash(std::move(candidate), taken), current));
  return result;
}

/// How many forms of each family and equation have been taken, by their number of shapes.
class Shares {
 public:
  /// Takes the candidate when one of its families has room for its argument. Two of each are
  /// taken, of different arguments: a lag of a product whose factor seems to lag as well.
  bool take(const Candidate& candidate) {
    bool has_room = false;
    for (const std::string& family : candidate.families) {
      std::vector<Candidate>& taken =
          taken_[{family, candidate.equation, candidate.shapes.size()}];
      const bool again = std::any_of(taken.begin(), taken.end(), [&](const Candidate& other) {
        return other.argument == candidate.argument && other.within == candidate.within;
      });
      if (taken.size() >= kOfEach || again) continue;
      taken.push_back(candidate);
      has_room = true;
    }
    return has_room;
  }

 private:
  // A fact of the search: forms of one family are shaped to be much alike.
  static constexpr std::size_t kOfEach = 2;
  std::map<std::tuple<std::string, Index, std::size_t>, std::vector<Candidate>> taken_;
};

}  // namespace

bool are_siblings(const Candidate& a, const Candidate& b) {
  return in_one_place(a, b) && a.within == b.within && are_of_one_family(a, b) &&
         a.shapes.size() == b.shapes.size() && a.memory.size() == b.memory.size();
}

std::vector<ScreenedCandidate> worth_fitting(const std::vector<ScreenedCandidate>& screened,
                                             const DecisionOptions& decision, int at_least) {
  std::vector<ScreenedCandidate> result;
  const auto tried = static_cast<double>(screened.size());
  const double best = screened.empty() ? 0.0 : screened.front().gain;
  Shares fractions;
  for (const ScreenedCandidate& candidate : screened) {
    if (static_cast<int>(result.size()) == decision.rough_fits) break;
    const double freedom = 1.0 + static_cast<double>(candidate.shapes.size());
    const bool is_possible = candidate.gain >= decision.worth_fitting * best &&
                             sigma_of_gain(candidate.gain, freedom, tried) >= decision.possible;
    if (!is_possible && static_cast<int>(result.size()) >= at_least) continue;
    if (fractions.take(candidate.candidate)) result.push_back(candidate);
  }
  return result;
}

namespace {

/// Candidates that were not taken, though they may be as good as a sibling of theirs that was.
std::vector<ScreenedCandidate> siblings_of(const std::vector<ScreenedCandidate>& taken,
                                           const std::vector<ScreenedCandidate>& screened,
                                           const DecisionOptions& decision) {
  std::vector<ScreenedCandidate> siblings;
  for (const ScreenedCandidate& candidate : screened) {
    if (candidate.gain < decision.worth_fitting * screened.front().gain) continue;
    const auto is_in = [&](auto relates) {
      return std::any_of(taken.begin(), taken.end(), [&](const ScreenedCandidate& one) {
        return relates(one.candidate, candidate.candidate);
      });
    };
    if (is_in(are_siblings) && !is_in(are_one_form)) siblings.push_back(candidate);
  }
  return siblings;
}

void append(const std::vector<ScreenedCandidate>& screened, const DecisionOptions& decision,
            std::shared_ptr<const Assimilation> start, ShortList& list) {
  const int at_least = start ? decision.start_fits : 0;
  const std::vector<ScreenedCandidate> taken = worth_fitting(screened, decision, at_least);
  if (!start) list.siblings = siblings_of(taken, screened, decision);
  for (const ScreenedCandidate& candidate : taken)
    list.candidates.push_back({candidate, start});
  list.screened += static_cast<Index>(screened.size());
  for (const ScreenedCandidate& candidate : screened) list.tried += candidate.tried;
}

/// The best of the screening along the path so far, and along others (search_starts()).
ShortList screened_list(const EffectSearch& search, const Explanation& current) {
  const DecisionOptions& decision = search.problem.options.decision;
  const RunContext& context = search.problem.context;
  ScreeningMemory* memory = &search.problem.memory->screenings;
  const Screening screening(current.fit);
  const double shape_penalty = search.problem.options.criterion->penalty(
      {0.0, 1.0, static_cast<double>(screening.system().used()), 0.0});
  const ScreeningOptions options{shape_penalty, decision.worth_shaping};
  const std::vector<Candidate> candidates = all_candidates(search, current);
  ShortList list;
  append(screen(candidates, screening, options, context, memory), decision, nullptr, list);
  for (SearchStart& start : search_starts(search, current)) {
    std::vector<Candidate> own = candidates;
    std::erase_if(own, [&](const Candidate& candidate) {
      return candidate.place != Place::Rate ||
             (start.equation && candidate.equation != *start.equation);
    });
    const auto screened = screen(own, Screening(start.fit), options, context, memory);
    append(screened, decision, std::make_shared<const Assimilation>(std::move(start.fit)),
           list);
  }
  return list;
}

/// All functions of the arguments that effects have in their places, from all of their starts.
/// Which argument acts where shows along a hidden path that is only roughly right; how it acts
/// does not, so nothing is screened.
ShortList forms_along(const EffectSearch& search, const Explanation& current) {
  ShortList list;
  const Explanation& found = *search.along;
  const auto is_another_form = [&](const Candidate& candidate) {
    return candidate.memory.empty() && !contains(candidate.form, Operation::Delay) &&
           std::any_of(found.effects.begin(), found.effects.end(),
                       [&](const FittedEffect& effect) {
                         return in_one_place(effect.candidate, candidate);
                       });
  };
  const auto path = std::make_shared<const Assimilation>(found.fit);
  for (const Candidate& candidate : all_candidates(search, current)) {
    // The argument was chosen among those of all candidates.
    ++list.screened;
    list.tried += static_cast<Index>(candidate.starts.size());
    if (!is_another_form(candidate)) continue;
    for (const Vector& start : candidate.starts)
      list.candidates.push_back({{candidate, start, 0.0, 0.0, 1}, path});
  }
  return list;
}

}  // namespace

ShortList short_list(const EffectSearch& search, const Explanation& current) {
  const bool along = search.along && current.effects.empty();
  return along ? forms_along(search, current) : screened_list(search, current);
}

}  // namespace lacuna
