// SPDX-License-Identifier: MIT
#include "reservations.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "core/base/text.hpp"
#include "diagnose/criterion/effect_parts.hpp"
#include "diagnose/criterion/shape_bounds.hpp"
#include "records/channels/interpolated.hpp"

namespace lacuna {
namespace {

using Sentences = std::vector<std::string>;

std::string where(const Problem& problem, Index equation) {
  return "d" + problem.nominal.states()[static_cast<std::size_t>(equation)].name + "/dt";
}

void add_bounds(const CompositeModel& composite, Sentences& said) {
  for (std::size_t e = 0; e < composite.named.size(); ++e) {
    const FittedEffect& effect = composite.explanation.effects[e];
    for (std::size_t s = 0; s < effect.candidate.shapes.size(); ++s) {
      const ShapeParameter& shape = effect.candidate.shapes[s];
      const double value = effect.shapes[static_cast<Index>(s)];
      if (is_on_bound(shape, value))
        said.push_back("a parameter sits on its bound: " + shape.name + " = " +
                       format_number(value, 4) + " of " + composite.named[e].name);
    }
  }
}

void add_cancelling(const Problem& problem, const CompositeModel& composite, Sentences& said) {
  const double least = problem.options.decision.cancelling;
  std::vector<Index> seen;
  for (const FittedEffect& effect : composite.explanation.effects) {
    const Index k = effect.candidate.equation;
    if (effect.candidate.place != Place::Rate ||
        std::find(seen.begin(), seen.end(), k) != seen.end())
      continue;
    seen.push_back(k);
    const Cancellation found =
        largest_cancellation(added_parts(composite.explanation, problem.nominal, k));
    if (found.left < least)
      said.push_back("terms in " + where(problem, k) +
                     " nearly cancel: " + join(found.terms, ", "));
  }
}

void add_coefficients(const Problem& problem, const CompositeModel& composite,
                      Sentences& said) {
  for (const MovedCoefficient& one :
       moved_coefficients(composite.explanation.fit, problem.nominal,
                          composite.base->fit_options.free.size(), problem.options.decision))
    said.push_back("the nominal coefficient of " + one.term + " in " +
                   where(problem, one.equation) +
                   (one.changes_sign() ? " changes its sign: " : " changes out of scale: ") +
                   format_number(one.given, 4) + " to " + format_number(one.fitted, 4));
}

/// Whether an effect in an equation is a function of all that a term of it is: it may stand in
/// its place.
bool takes_the_place(const CompositeModel& composite, Index equation, const Term& term) {
  const std::vector<FittedEffect>& effects = composite.explanation.effects;
  const auto needed = term.expression().variables();
  return std::any_of(effects.begin(), effects.end(), [&](const FittedEffect& effect) {
    const auto has = effect.candidate.form.variables();
    return effect.candidate.equation == equation &&
           std::includes(has.begin(), has.end(), needed.begin(), needed.end());
  });
}

/// Coefficients of a fit beside hidden states that are others than the given ones by a factor, and
/// by their errors.
void add_rescaled(const Problem& problem, const CompositeModel& composite, Sentences& said) {
  const Assimilation& fit = composite.explanation.fit;
  const DecisionOptions& decision = problem.options.decision;
  if (composite.base->fit_options.hidden.empty()) return;
  for (std::size_t j = 0; j < composite.base->fit_options.free.size(); ++j) {
    const auto [equation, place] = fit.free[j];
    const auto k = static_cast<std::size_t>(equation), at = static_cast<std::size_t>(place);
    const WeightedTerm& nominal = problem.nominal.equations()[k][at];
    const double given = nominal.coefficient;
    if (given == 0.0) continue;
    const double ratio = fit.model.equations()[k][at].coefficient / given;
    const auto row = static_cast<Index>(j);
    const double error = decision.significance / std::abs(given) *
                         std::sqrt(std::max(0.0, fit.covariance(row, row)));
    const bool is_said = ratio < -decision.minor || ratio > decision.out_of_scale;
    if (is_said || (ratio - error <= decision.rescaled && ratio + error >= 1.0 / decision.rescaled))
      continue;
    if (takes_the_place(composite, equation, nominal.term)) continue;
    said.push_back("beside hidden states the nominal coefficient of " + nominal.term.name() +
                   " in " + where(problem, equation) + " changes from " +
                   format_number(given, 4) + " to " + format_number(given * ratio, 4) +
                   ": what moves it may not be what is named");
  }
}

void add_turned_off(const Problem& problem, const CompositeModel& composite, Sentences& said) {
  for (const Index k : equations_turned_off(problem, composite))
    said.push_back("the records are met only without " + where(problem, k) +
                   " as the model has it: all its coefficients fall to less than 1/" +
                   format_number(problem.options.decision.out_of_scale, 3) +
                   " of what was given");
}

void add_idle(const Problem& problem, const CompositeModel& composite, Sentences& said) {
  for (std::size_t e = 0; e < composite.named.size(); ++e) {
    const FittedEffect& effect = composite.explanation.effects[e];
    if (effect.candidate.place != Place::Rate || effect.candidate.is_driven()) continue;
    const double least = problem.options.decision.acting;
    const double fraction = acting_fraction(effect, composite.explanation.fit, least);
    if (fraction < least)
      said.push_back(composite.named[e].name + " acts in " +
                     format_number(100.0 * fraction, 2) + " % of the samples only");
  }
}

/// Names explain a disagreement when it is less with them.
void add_hardly_closing(const Problem& problem, const CompositeModel& composite,
                        Sentences& said) {
  if (composite.named.empty()) return;
  const double fraction = fraction_closed(composite.base->fitted, composite.explanation.fit);
  if (fraction >= problem.options.decision.minor || shows_the_motion(composite, problem))
    return;
  said.push_back("of what disturbs the model only " + format_number(100.0 * fraction, 2) +
                 " % goes with what is named");
}

/// Whether an effect in an equation jumps: when it does between two samples is not resolved.
bool jumps_in(const CompositeModel& composite, Index equation) {
  const std::vector<FittedEffect>& effects = composite.explanation.effects;
  return std::any_of(effects.begin(), effects.end(), [&](const FittedEffect& effect) {
    return effect.candidate.equation == equation &&
           contains(effect.candidate.form, Operation::Sign);
  });
}

/// A law that stands for another one leaves little, and that not by chance.
void add_small_structure(const Problem& problem, const CompositeModel& composite,
                         Sentences& said) {
  const DecisionOptions& decision = problem.options.decision;
  if (composite.named.empty()) return;
  for (const EquationStructure& left : composite.left)
    if (has_residual_structure({left}, decision) && !is_substantial(left, decision) &&
        !jumps_in(composite, left.equation))
      said.push_back("what is named leaves structure in " + where(problem, left.equation) +
                     " that is small (" + format_number(100.0 * left.relative, 2) +
                     " % of its rate of change) but not by chance (" +
                     format_number(left.sigma, 3) + " sigma)");
}

/// Of what acts on hidden states only what reaches a channel is seen: one channel cannot
/// confirm several effects, each of which may stand for a part of another one.
void add_unconfirmed(const Problem& problem, const CompositeModel& composite, Sentences& said) {
  if (composite.base->fit_options.hidden.empty()) return;
  std::set<std::string> names;  // one process in two equations is one effect
  for (const NamedEffect& named : composite.named) names.insert(named.name);
  const Dataset& data = problem.records.data;
  Index channels = 0;
  for (Index k = 0; k < data.state_count(); ++k) channels += data.is_measured(k);
  const auto count = static_cast<Index>(names.size());
  if (count > channels)
    said.push_back(std::to_string(count) + " effects beside hidden states, and " +
                   (channels == 1 ? "one channel" : std::to_string(channels) + " channels") +
                   " to see them by: together they may stand for another one");
}

/// Between the samples that were recorded of an input only a curve is known.
void add_seldom_recorded(const Problem& problem, const CompositeModel& composite,
                         Sentences& said) {
  const Dataset& data = problem.records.data;
  for (Index j = 0; j < data.input_count(); ++j) {
    if (!is_interpolated(data, j)) continue;
    const std::string& input = problem.nominal.inputs()[static_cast<std::size_t>(j)].name;
    for (std::size_t e = 0; e < composite.named.size(); ++e)
      if (composite.explanation.effects[e].candidate.depends_on(input))
        said.push_back("most samples of " + input + " lie on lines between others: " +
                       composite.named[e].name + " may stand for what it did in between");
  }
}

/// Whether a gap is larger than so many noise floors. What is no size of an effect comes from the
/// arithmetic that made or sampled the records.
bool is_above(const Gap& gap, double floors, const DecisionOptions& decision) {
  return gap.after > floors * gap.noise_floor &&
         gap.after > std::hypot(gap.noise_floor, decision.effect_size);
}

/// Whether a gap is larger than noise makes it whose memory is not modelled: with the right names
/// of effects nothing else is there. (The fault of a sensor is an approximation.)
bool exceeds_noise(const Gap& gap, const DecisionOptions& decision) {
  return is_above(gap, decision.noise_inflation, decision);
}

}  // namespace

bool stays_open(const Gap& gap, const DecisionOptions& decision) {
  if (!is_above(gap, decision.explained_gap, decision)) return false;
  // Scatter over few windows, or one that stands for most of it, hides no gap that is large
  // against the noise.
  return gap.above_floor >= decision.significance ||
         gap.after > decision.open_gap * gap.noise_floor;
}

std::vector<Index> equations_turned_off(const Problem& problem,
                                        const CompositeModel& composite) {
  const std::vector<bool>& hidden = composite.base->fit_options.hidden;
  const OdeModel& nominal = problem.nominal;
  std::vector<Index> off;
  for (Index k = 0; k < nominal.dimension(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    const Equation& given = nominal.equations()[at];
    const Equation& fitted = composite.explanation.fit.model.equations()[at];
    if (at >= hidden.size() || !hidden[at] || given.empty()) continue;
    bool is_off = true;
    for (std::size_t j = 0; j < given.size(); ++j)
      is_off = is_off && problem.options.decision.out_of_scale *
                                 std::abs(fitted[j].coefficient) <
                             std::abs(given[j].coefficient);
    if (is_off) off.push_back(k);
  }
  return off;
}

bool runs_away(const Gap& gap, const DecisionOptions& decision) {
  return gap.free_after && !(gap.free_after->apart <= decision.diverging);
}

namespace {

/// Beside names noise with a memory is noise; where nothing is named it may be what has no
/// name.
std::string open_gap_phrase(const Gap& gap, bool is_named) {
  const double floor = is_named ? gap.noise_floor : gap.white_floor;
  return "the gap on the records that were not used stays at " +
         format_number(gap.after / floor, 3) + " times its noise floor" +
         (floor > gap.white_floor ? ", with noise that has a memory" : "");
}

}  // namespace

Sentences reservations(const Problem& problem, const CompositeModel& composite,
                       const std::optional<Gap>& gap) {
  Sentences said;
  const bool is_named = !composite.named.empty();
  if (gap && (stays_open(*gap, problem.options.decision) ||
              (is_named && exceeds_noise(*gap, problem.options.decision))))
    said.push_back(open_gap_phrase(*gap, is_named || !composite.findings.empty()));
  if (gap && runs_away(*gap, problem.options.decision))
    said.push_back("no model yet: run freely over the whole of the records that were not used "
                   "it is off by " +
                   format_number(gap->free_after->apart, 3) + " times their spread");
  add_turned_off(problem, composite, said);
  if (!is_named && composite.findings.empty()) return said;
  add_bounds(composite, said);
  add_cancelling(problem, composite, said);
  add_coefficients(problem, composite, said);
  add_rescaled(problem, composite, said);
  add_idle(problem, composite, said);
  add_hardly_closing(problem, composite, said);
  add_small_structure(problem, composite, said);
  add_unconfirmed(problem, composite, said);
  add_seldom_recorded(problem, composite, said);
  return said;
}

}  // namespace lacuna
