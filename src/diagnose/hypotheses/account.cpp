// SPDX-License-Identifier: MIT
#include "lacuna/diagnose/hypotheses/account.hpp"

#include <algorithm>
#include <cmath>

#include "diagnose/search/effect_size.hpp"

namespace lacuna {
namespace {

/// What it took to choose the effects.
double log_choices(const std::vector<NamedEffect>& named) {
  double sum = 0.0;
  for (const NamedEffect& effect : named)
    sum += std::log(static_cast<double>(std::max<Index>(1, effect.tried)));
  return sum;
}

}  // namespace

Account bare_account(const Problem& problem, std::string hypothesis,
                     std::shared_ptr<const Baseline> base) {
  Explanation nothing{{}, base->fitted};
  std::vector<EquationStructure> left = test_disturbances(nothing.fit, problem.context);
  return {.hypothesis = std::move(hypothesis),
          .base = std::move(base),
          .explanation = std::move(nothing),
          .named = {},
          .left = std::move(left)};
}

Evidence evidence_of(const Account& account) {
  const Explanation& explanation = account.explanation;
  return {explanation.fit.deviance,
          static_cast<double>(account.base->fit_options.free.size()) +
              account.base->parameters + static_cast<double>(explanation.parameters()),
          static_cast<double>(explanation.fit.used), log_choices(account.named)};
}

bool is_substantial(const EquationStructure& structure, const DecisionOptions& decision) {
  return structure.sigma >= decision.significance && structure.relative >= decision.effect_size;
}

bool leaves_structure(const Account& account, const DecisionOptions& decision) {
  return std::any_of(account.left.begin(), account.left.end(),
                     [&](const auto& left) { return is_substantial(left, decision); });
}

bool is_anything_left(const std::vector<EquationStructure>& left,
                      const DecisionOptions& decision) {
  DecisionOptions smaller = decision;
  smaller.effect_size *= decision.minor;
  return std::any_of(left.begin(), left.end(),
                     [&](const auto& one) { return is_substantial(one, smaller); });
}

bool closes_most(const Account& account, const Problem& problem) {
  if (account.named.empty()) return false;
  const Assimilation& base = account.base->fitted;
  const Vector rates = rate_rms(base);
  const double before = total_disturbance(base, rates);
  const double after = total_disturbance(account.explanation.fit, rates);
  return after < (1.0 - problem.options.decision.major) * before ||
         shows_the_motion(account, problem);
}

bool shows_the_motion(const Account& account, const Problem& problem) {
  if (account.named.empty()) return false;
  const Explanation& explanation = account.refitted ? *account.refitted : account.explanation;
  return EffectSize(problem, *account.base).gap(explanation.fit) <
         problem.options.decision.minor;
}

}  // namespace lacuna
