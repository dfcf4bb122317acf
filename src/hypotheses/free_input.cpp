// SPDX-License-Identifier: MIT
#include "hypotheses/free_input.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lacuna/candidates/name_table.hpp"
#include "lacuna/core/parallel.hpp"
#include "lacuna/numerics/significance.hpp"

namespace lacuna {
namespace {

/// From here on 2 log B is very strong evidence (Kass and Raftery, JASA 90 (1995)).
constexpr double kVeryStrong = 10.0;

std::vector<FittedEffect> chosen_members(const Bank& bank, const BankScore& score) {
  std::vector<FittedEffect> effects;
  for (const std::size_t place : score.members)
    effects.push_back({bank.members[place], Vector(0), 0.0, 0.0});
  return effects;
}

/// A bank with what it explains less the price of its members.
struct ScoredBank {
  Bank bank;
  BankScore score;
  double net = 0.0;
};

/// The best of some banks by BIC.
std::optional<ScoredBank> best_bank(std::vector<Bank> banks, const BankScreening& screening) {
  std::optional<ScoredBank> best;
  for (Bank& bank : banks) {
    BankScore score = screening.score(bank);
    const double price = screening.log_samples() * static_cast<double>(score.members.size());
    const double net = score.gain - price;
    if (!score.members.empty() && (!best || net > best->net))
      best = ScoredBank{std::move(bank), std::move(score), net};
  }
  return best;
}

class FreeInput {
 public:
  explicit FreeInput(const Unexplained& problem)
      : p_(problem), start_(with_seen_noise(problem.base).value_or(problem.base)) {}

  std::optional<RankedEffect> find() const {
    const std::optional<Candidate> candidate = input_candidate();
    if (!candidate) return std::nullopt;
    const std::optional<Vector> memory = best_memory(*candidate);
    if (!memory) return std::nullopt;
    RankedEffect input{explain(p_.data, p_.scope.model, start_,
                               {{*candidate, *memory, 1.0, 0.0}}, p_.fit_options, p_.context)};
    input.names = NameTable{p_.options.effects, p_.scope, p_.options.rank.naming}.names_of(
        input.effect(), input.explanation.fit.model);
    judge(input);
    if (input.names.empty() || !(input.gain > price() + kVeryStrong) ||
        input.contribution < p_.options.substance)
      return std::nullopt;
    return input;
  }

  bool stands_alone(const RankedEffect& input) const {
    return !leaves_structure(input) && !depends_on_the_present(input) &&
           !follows_the_past(input) && !is_a_factor(input);
  }

 private:
  std::optional<Candidate> input_candidate() const {
    for (const Stage<Effect>& effect : p_.options.effects)
      for (Candidate& candidate : effect->candidates(p_.scope, p_.equation))
        if (candidate.is_driven()) return candidate;
    return std::nullopt;
  }

  /// How long the input remembers; nothing when it is the shortest that is tried, as a white
  /// disturbance does as well then.
  std::optional<Vector> best_memory(const Candidate& candidate) const {
    auto [best, least] = best_of(candidate, candidate.starts);
    if (best == candidate.starts.front() || !(least < p_.base.deviance)) return std::nullopt;
    const double longest = candidate.shapes.front().high;
    // The starts are a factor of 3 apart.
    for (const double factor : {std::sqrt(3.0), std::pow(3.0, 0.25)}) {
      const Vector longer = (best * factor).cwiseMin(longest);
      auto [nearer, less] = best_of(candidate, {best / factor, longer});
      if (!(less < least)) continue;
      best = std::move(nearer);
      least = less;
    }
    return best;
  }

  /// The most likely of some shapes, with its deviance.
  std::pair<Vector, double> best_of(const Candidate& candidate,
                                    const std::vector<Vector>& shapes) const {
    p_.context.report("fitting a free input", 0.0);
    constexpr double kNothing = std::numeric_limits<double>::infinity();
    const RunContext quiet{p_.context.stop, {}, 1, p_.context.seed};
    std::vector<double> deviance(shapes.size());
    parallel_for(shapes.size(), p_.context.threads, [&](std::size_t i) {
      const Explanation fit =
          explain_roughly(p_.data, p_.scope.model, start_, {{candidate, shapes[i], 1.0, 0.0}},
                          p_.fit_options, quiet);
      deviance[i] = std::isfinite(fit.fit.deviance) ? fit.fit.deviance : kNothing;
    });
    const auto best = std::min_element(deviance.begin(), deviance.end());
    return {shapes[static_cast<std::size_t>(best - deviance.begin())], *best};
  }

  double log_samples() const { return std::log(static_cast<double>(p_.base.used)); }
  double price() const { return 2.0 * log_samples(); }

  void judge(RankedEffect& input) const {
    const Assimilation& fit = input.explanation.fit;
    const Index drive = p_.scope.model.dimension();
    input.criterion = fit.deviance + price();
    input.gain = p_.base.deviance - fit.deviance;
    input.sigma = sigma_of_gain(input.gain, 2.0, 1.0);
    input.probability = 1.0;
    double sum = 0.0, count = 0.0;
    for (const LinearisedRecord& record : fit.records) {
      sum += record.path.col(drive).squaredNorm();
      count += static_cast<double>(record.samples());
    }
    input.contribution = std::sqrt(sum / count) / rate_rms(fit)[p_.equation];
  }

  bool leaves_structure(const RankedEffect& input) const {
    const auto left = test_structure(input.explanation.fit, p_.context);
    return std::any_of(left.begin(), left.end(), [&](const EquationStructure& structure) {
      return structure.equation < p_.scope.model.dimension() &&
             is_substantial(structure, p_.options);
    });
  }

  /// Under a true input the innovations have nothing to do with what is known at the time.
  bool depends_on_the_present(const RankedEffect& input) const {
    constexpr double kOfSubstance = 0.05;  // of what the input explains
    const BankScreening screening(input.explanation.fit);
    const std::vector<Bank> banks = present_banks(p_.scope, p_.equation);
    return std::any_of(banks.begin(), banks.end(), [&](const Bank& bank) {
      p_.context.report("looking for what a free input depends on", 0.0);
      const BankScore score = screening.score(bank);
      const double sigma =
          sigma_of_gain(score.gain, std::max(1.0, static_cast<double>(score.members.size())),
                        static_cast<double>(banks.size()));
      return sigma >= p_.options.significance && score.gain > kOfSubstance * input.gain;
    });
  }

  /// Whether earlier values of the variables explain the records better.
  bool follows_the_past(const RankedEffect& input) const {
    const BankScreening screening(p_.base);
    std::vector<Bank> banks = other_banks(p_.scope, p_.equation);
    std::erase_if(banks, [](const Bank& bank) { return bank.kind != Bank::Kind::Memory; });
    const auto best = best_bank(std::move(banks), screening);
    if (!best) return false;
    const Explanation past =
        explain_roughly(p_.data, p_.scope.model, p_.base,
                        chosen_members(best->bank, best->score), p_.fit_options, p_.context);
    return criterion_of(past) < input.criterion;
  }

  /// Whether the records are explained better by a process that multiplies a variable: a
  /// coefficient that changes at random.
  bool is_a_factor(const RankedEffect& input) const {
    for (const VariableRange& variable : p_.scope.variables) {
      FittedEffect factor = input.effect();
      const double size = variable.magnitude();
      if (!(size > 0.0)) continue;
      p_.context.report("looking for what a free input multiplies", 0.0);
      factor.candidate.form = factor.candidate.form * Expression::variable(variable.name) /
                              Expression::number(size);
      const Explanation fit = explain(p_.data, p_.scope.model, start_, {std::move(factor)},
                                      p_.fit_options, p_.context);
      if (fit.fit.deviance + price() + kVeryStrong < input.criterion) return true;
    }
    return false;
  }

  const Unexplained& p_;
  Assimilation start_;  ///< the disturbances that the input takes over had hidden the noise
};

double variance_of(const Assimilation& fit, Index equation) {
  return fit.noise.disturbance[equation] * fit.noise.disturbance[equation];
}

}  // namespace

std::optional<RankedEffect> find_free_input(const Unexplained& problem) {
  return FreeInput(problem).find();
}

bool stands_alone(const RankedEffect& input, const Unexplained& problem) {
  return FreeInput(problem).stands_alone(input);
}

Unnamed describe_unnamed(const Unexplained& problem, bool fill, Explanation& explanation) {
  const BankScreening screening(problem.base);
  const auto present = best_bank(present_banks(problem.scope, problem.equation), screening);
  const auto other = best_bank(other_banks(problem.scope, problem.equation), screening);
  Unnamed unnamed{problem.equation, {}, 0.0, false, false, false};
  const double now = present ? present->net : 0.0;
  const bool is_other = other && other->net > now;
  unnamed.memory = is_other && other->bank.kind == Bank::Kind::Memory;
  unnamed.periodic = is_other && other->bank.kind == Bank::Kind::Lines;
  if (is_other)
    unnamed.variables = other->bank.variables;
  else if (now > 0.0)
    unnamed.variables = present->bank.variables;
  if (!present || !(now > 0.0)) return unnamed;
  const auto fit = fill ? explain : explain_roughly;
  Explanation filled =
      fit(problem.data, problem.scope.model, problem.base,
          chosen_members(present->bank, present->score), problem.fit_options, problem.context);
  const double before = variance_of(problem.base, problem.equation);
  if (!(criterion_of(filled) < problem.base.deviance) || !(before > 0.0)) return unnamed;
  unnamed.explained =
      std::clamp(1.0 - variance_of(filled.fit, problem.equation) / before, 0.0, 1.0);
  if (!fill) return unnamed;
  unnamed.filled = true;
  explanation = std::move(filled);
  return unnamed;
}

}  // namespace lacuna
