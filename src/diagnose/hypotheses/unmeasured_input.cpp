// SPDX-License-Identifier: MIT
#include "diagnose/hypotheses/unmeasured_input.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/base/parallel.hpp"
#include "core/base/text.hpp"
#include "core/statistics/significance.hpp"
#include "diagnose/search/effect_names.hpp"
#include "diagnose/search/function_basis.hpp"

namespace lacuna {
namespace {

/// Where an input is sought.
struct Search {
  const Problem& problem;
  const Baseline& base;
  Index equation = 0;  ///< with the most structure
  Assimilation start;  ///< the disturbances that the input takes over had hidden the noise
};

/// An input that was fitted.
struct FoundInput {
  Explanation explanation;
  double value = 0.0;         ///< by the criterion
  double gain = 0.0;          ///< drop of the deviance against the baseline
  double contribution = 0.0;  ///< its rms over that of the state's rate

  const FittedEffect& effect() const { return explanation.effects.front(); }
};

std::optional<Candidate> input_candidate(const Search& search) {
  for (const Stage<Effect>& effect : search.problem.options.effects)
    for (Candidate& candidate : effect->candidates(search.base.scope, search.equation))
      if (candidate.is_driven()) return candidate;
  return std::nullopt;
}

/// The most likely of some memories, with its deviance.
std::pair<Vector, double> likeliest(const Search& search, const Candidate& candidate,
                                    const std::vector<Vector>& memories) {
  const auto& [nominal, records, options, context, memory, fewer] = search.problem;
  context.report("fitting an input that was not measured", 0.0);
  const RunContext quiet = context.beside_others();
  const Problem alone{nominal, records, options, quiet};
  std::vector<double> deviance(memories.size());
  parallel_for(memories.size(), context.threads, [&](std::size_t i) {
    const Explanation fit = explain_roughly_on(alone, search.base, search.start,
                                               {{candidate, memories[i], 1.0, 0.0}});
    deviance[i] = std::isfinite(fit.fit.deviance) ? fit.fit.deviance
                                                  : std::numeric_limits<double>::infinity();
  });
  const auto best = std::min_element(deviance.begin(), deviance.end());
  return {memories[static_cast<std::size_t>(best - deviance.begin())], *best};
}

/// How long the input remembers; nothing when it is the shortest that is tried, as a white
/// disturbance does as well then.
std::optional<Vector> best_memory(const Search& search, const Candidate& candidate) {
  auto [best, least] = likeliest(search, candidate, candidate.starts);
  if (best == candidate.starts.front() || !(least < search.base.fitted.deviance))
    return std::nullopt;
  const double longest = candidate.shapes.front().high;
  // The starts are a factor of 3 apart.
  for (const double factor : {std::sqrt(3.0), std::pow(3.0, 0.25)}) {
    const Vector longer = (best * factor).cwiseMin(longest);
    auto [nearer, less] = likeliest(search, candidate, {best / factor, longer});
    if (!(less < least)) continue;
    best = std::move(nearer);
    least = less;
  }
  return best;
}

/// rms of the smoothed input over that of the state's rate.
double contribution_of(const Explanation& explanation, const Search& search) {
  const Index drive = search.problem.nominal.dimension();
  double sum = 0.0, count = 0.0;
  for (const LinearisedRecord& record : explanation.fit.records) {
    sum += record.path.col(drive).squaredNorm();
    count += static_cast<double>(record.samples());
  }
  return std::sqrt(sum / count) / rate_rms(explanation.fit)[search.equation];
}

double value_of(const Explanation& explanation, const Search& search) {
  return criterion_of(search.problem, search.base, explanation);
}

std::optional<FoundInput> find_input(const Search& search) {
  const std::optional<Candidate> candidate = input_candidate(search);
  if (!candidate) return std::nullopt;
  const std::optional<Vector> memory = best_memory(search, *candidate);
  if (!memory) return std::nullopt;
  FoundInput input{
      explain_on(search.problem, search.base, search.start, {{*candidate, *memory, 1.0, 0.0}})};
  input.value = value_of(input.explanation, search);
  input.gain = search.base.fitted.deviance - input.explanation.fit.deviance;
  input.contribution = contribution_of(input.explanation, search);
  return input;
}

/// Whether it explains the records much better than a white disturbance, and is of the size of
/// an effect.
bool is_evident(const FoundInput& input, const Search& search) {
  const DecisionOptions& decision = search.problem.options.decision;
  const double white = value_of({{}, search.base.fitted}, search);
  return input.value + decision.undecided < white && input.contribution >= decision.effect_size;
}

/// Structure that an input leaves in the equations of the nominal model.
std::vector<EquationStructure> left_by(const FoundInput& input, const Search& search) {
  std::vector<EquationStructure> left =
      test_disturbances(input.explanation.fit, search.problem.context);
  std::erase_if(left, [&](const EquationStructure& structure) {
    return structure.equation >= search.problem.nominal.dimension();
  });
  return left;
}

/// Under a true input the innovations have nothing to do with what is known at the time.
bool depends_on_the_present(const FoundInput& input, const Search& search) {
  const DecisionOptions& decision = search.problem.options.decision;
  const FunctionScreening screening(input.explanation.fit);
  const std::vector<FunctionBasis> bases =
      present_functions(search.base.fitted, search.base.scope, search.equation);
  return std::any_of(bases.begin(), bases.end(), [&](const FunctionBasis& basis) {
    search.problem.context.report("looking for what an input depends on", 0.0);
    const FunctionScore score = screening.score(basis);
    const double sigma =
        sigma_of_gain(score.gain, std::max(1.0, static_cast<double>(score.members.size())),
                      basis.tried * static_cast<double>(bases.size()));
    return sigma >= decision.significance && score.gain > decision.negligible * input.gain;
  });
}

/// Whether earlier values of the variables explain the records better.
bool follows_the_past(const FoundInput& input, const Search& search) {
  const FunctionScreening screening(search.base.fitted);
  std::vector<FunctionBasis> bases = other_functions(search.base.scope, search.equation);
  std::erase_if(bases, [](const FunctionBasis& basis) {
    return basis.kind != FunctionBasis::Kind::Memory;
  });
  const auto best = screening.best_of(std::move(bases), *search.problem.options.criterion);
  if (!best) return false;
  const Explanation past =
      explain_roughly_on(search.problem, search.base, search.base.fitted, best->members());
  return value_of(past, search) < input.value;
}

/// Whether the records are explained better by a process that multiplies a variable: a
/// coefficient that changes at random.
bool is_a_factor(const FoundInput& input, const Search& search) {
  for (const VariableRange& variable : search.base.scope.variables) {
    FittedEffect factor = input.effect();
    const double size = variable.magnitude();
    if (!(size > 0.0)) continue;
    search.problem.context.report("looking for what an input multiplies", 0.0);
    factor.candidate.form =
        factor.candidate.form * Expression::variable(variable.name) / Expression::number(size);
    const Explanation fit =
        explain_on(search.problem, search.base, search.start, {std::move(factor)});
    if (value_of(fit, search) + search.problem.options.decision.undecided < input.value)
      return true;
  }
  return false;
}

/// How large an input is and how long it remembers: ", 0.3 m/s^2 rms over 2 s".
std::string size_of(const FoundInput& input, const Search& search) {
  const OdeModel& model = search.problem.nominal;
  const auto k = static_cast<std::size_t>(search.equation);
  const double rms = input.contribution * rate_rms(input.explanation.fit)[search.equation];
  const std::string& unit = model.states()[k].unit;
  return ", " + format_number(rms, 2) + " " + (unit.empty() ? "1" : unit) + "/" +
         model.time_unit() + " rms over " + format_number(input.effect().shapes[0], 2) + " " +
         model.time_unit();
}

NamedEffect name_of(const FoundInput& input, const Search& search) {
  const NameTable table{search.problem.options.effects, search.base.scope,
                        search.problem.options.decision.naming};
  const std::vector<Name> names = table.names_of(input.effect(), input.explanation.fit.model);
  NamedEffect named;
  named.equation = search.equation;
  if (!names.empty()) take_name(input.effect(), names.front(), named);
  named.description += size_of(input, search);
  named.sigma = sigma_of_gain(input.gain, 2.0, 1.0);
  named.contribution = input.contribution;
  named.probability = 1.0;
  const double fraction = input.explanation.fit.noise.disturbance[search.equation] /
                          search.base.fitted.noise.disturbance[search.equation];
  named.gap_closed = std::clamp(1.0 - fraction * fraction, 0.0, 1.0);
  return named;
}

/// The composite model in which the input is the only effect.
CompositeModel named_composite(FoundInput input, std::vector<EquationStructure> left,
                               const Search& search, const CompositeModel& best) {
  NamedEffect named = name_of(input, search);
  const double sigma = named.sigma;
  CompositeModel composite{.hypothesis = {},
                           .base = best.base,
                           .explanation = std::move(input.explanation),
                           .named = {std::move(named)},
                           .left = std::move(left)};
  composite.rounds = best.rounds;
  composite.rounds.push_back({1, "unmeasured-input", sigma, true});
  update_numbers(composite.explanation, composite.named);
  return composite;
}

/// The composite model in which nothing has a name, as a process in time that is no input
/// explains the records better than the effects.
Proposal unnamed_proposal(const Search& search, const CompositeModel& best) {
  Proposal proposal{bare_composite(search.problem, {}, best.base)};
  proposal.composite.rounds = best.rounds;
  proposal.judged = ByRule{
      "a process in time explains the records better than the effects, and is no input: it "
      "depends on what was recorded"};
  return proposal;
}

/// Whether no residual structure is there, and what moves the input has nothing to do with what
/// was recorded.
bool stands_alone(const FoundInput& input, const std::vector<EquationStructure>& left,
                  const Search& search) {
  return std::none_of(left.begin(), left.end(),
                      [&](const auto& one) {
                        return is_substantial(one, search.problem.options.decision);
                      }) &&
         !depends_on_the_present(input, search) && !follows_the_past(input, search) &&
         !is_a_factor(input, search);
}

/// Whether an effect is a function of time: where it leaves structure, something acted from outside
/// that need not be of its form.
bool is_of_time(const std::vector<FittedEffect>& effects) {
  return std::any_of(effects.begin(), effects.end(), [](const FittedEffect& effect) {
    return effect.candidate.depends_on("t");
  });
}

}  // namespace

Proposals UnmeasuredInput::do_propose(const Problem& problem,
                                      const CompositeModel& best) const {
  const DecisionOptions& decision = problem.options.decision;
  if (!leaves_structure(best, decision) ||
      (shows_the_motion(best, problem) && !is_of_time(best.explanation.effects)))
    return {};
  const Baseline& base = *best.base;
  const auto structure = test_disturbances(base.fitted, problem.context);
  const Search search{problem, base, structure.empty() ? 0 : structure.front().equation,
                      with_estimated_noise(base.fitted).value_or(base.fitted)};
  if (base.scope.is_identity(search.equation)) return {};  // by definition nothing acts there
  const std::string name(info().name), says = "an input that was not measured";
  std::optional<FoundInput> input = find_input(search);
  if (!input || !is_evident(*input, search)) return {};
  const double least = problem.options.criterion->value(evidence_of(best));
  if (input->value > least)
    return {{},
            {{name, says, input->value, false,
              std::string(problem.options.criterion->info().name), input->value, least}}};
  std::vector<EquationStructure> left = left_by(*input, search);
  Proposal proposal =
      stands_alone(*input, left, search)
          ? Proposal{named_composite(std::move(*input), std::move(left), search, best)}
          : unnamed_proposal(search, best);
  proposal.composite.hypothesis = name;
  return {{std::move(proposal)}, {}};
}

}  // namespace lacuna
