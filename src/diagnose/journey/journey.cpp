// SPDX-License-Identifier: MIT
#include "journey.hpp"

#include <cmath>
#include <utility>

#include "core/base/text.hpp"

namespace lacuna {
namespace {

using Phase = Hypothesis::Phase;
using Hypotheses = std::vector<Stage<Hypothesis>>;

/// What an account says in a few words.
std::string says(const Account& account, const OdeModel& nominal) {
  std::vector<std::string> parts;
  for (const NamedEffect& effect : account.named)
    parts.push_back(effect.name + " in d" +
                    nominal.states()[static_cast<std::size_t>(effect.equation)].name +
                    "/dt: " + effect.term);
  for (const NamedEffect& finding : account.findings) parts.push_back(finding.name);
  return parts.empty() ? "nothing is missing" : join(parts, "; ");
}

/// Effects on the baseline of an account.
Judged with_effects(const Problem& problem, const Hypotheses& hypotheses, Account bare) {
  return judge_phase(problem, hypotheses, Phase::Revision,
                     judge_phase(problem, hypotheses, Phase::Effects, {std::move(bare)}));
}

/// A proposal against the best account so far.
Rival compare(const Problem& problem, const Proposal& proposal, const Account& best) {
  const Criterion& criterion = *problem.options.criterion;
  const double value = criterion.value(evidence_of(proposal.account));
  const double least = criterion.value(evidence_of(best));
  Rival rival{proposal.account.hypothesis, says(proposal.account, problem.nominal), value};
  rival.quantity = criterion.info().name;
  rival.rule = proposal.precedence;
  rival.value = value + proposal.lead;
  rival.threshold = least;
  rival.taken = !proposal.precedence.empty() || rival.value < least;
  return rival;
}

void append(std::vector<Rival>& trail, std::vector<Rival> more) {
  trail.insert(trail.end(), std::make_move_iterator(more.begin()),
               std::make_move_iterator(more.end()));
}

/// What the records do not tell from the account that was taken: another assumption of them.
void add_doubt(const Problem& problem, const Rival& rival, const Account& loser,
               Account& winner) {
  if (!rival.rule.empty() || says(loser, problem.nominal) == says(winner, problem.nominal) ||
      std::abs(rival.value - rival.threshold) > problem.options.decision.undecided)
    return;
  winner.doubts.push_back("the records allow as well (" + loser.hypothesis +
                          "): " + says(loser, problem.nominal));
}

/// One proposal; effects are sought on a new baseline before it is judged or after it has won.
void judge(const Problem& problem, const Hypotheses& hypotheses, Phase phase, Proposal proposal,
           Judged& so_far) {
  const bool is_baseline = phase == Phase::Assumptions;
  std::vector<Rival> inner;
  const auto search = [&] {
    const std::string hypothesis = proposal.account.hypothesis;
    Judged found = with_effects(problem, hypotheses, std::move(proposal.account));
    proposal.account = std::move(found.best);
    proposal.account.hypothesis = hypothesis;
    inner = std::move(found.trail);
  };
  if (is_baseline && proposal.search_first) search();
  const Rival rival = compare(problem, proposal, so_far.best);
  so_far.trail.push_back(rival);
  if (rival.taken) {
    if (is_baseline && !proposal.search_first) search();
    if (is_baseline) add_doubt(problem, rival, so_far.best, proposal.account);
    so_far.best = std::move(proposal.account);
  } else if (is_baseline) {
    add_doubt(problem, rival, proposal.account, so_far.best);
  }
  if (!rival.taken && so_far.best.rounds.empty())
    so_far.best.rounds = std::move(proposal.account.rounds);  // what was tried in vain
  append(so_far.trail, std::move(inner));
}

/// The account with names only where they explain most, and coefficients that hold.
Account with_claims(const Problem& problem, Account account, std::vector<Rival>& trail) {
  const auto with_errors = [&](Account one) {
    one.explanation = with_joint_errors(problem, *one.base, std::move(one.explanation));
    update_numbers(one.explanation, one.named);
    return one;
  };
  if (account.named.empty()) return account;
  if (!leaves_structure(account, problem.options.decision))
    return with_errors(std::move(account));
  if (!closes_most(account, problem)) {
    trail.push_back({account.hypothesis,
                     says(account, problem.nominal),
                     {},
                     false,
                     "disturbances that go",
                     0.0,
                     problem.options.decision.major});
    return without_names(problem, account);
  }
  if (!account.refitted) return with_errors(std::move(account));
  account.explanation = std::move(*account.refitted);
  account.refitted.reset();
  update_numbers(account.explanation, account.named);
  return account;
}

}  // namespace

Judged judge_phase(const Problem& problem, const Hypotheses& hypotheses, Phase phase,
                   Judged so_far) {
  for (const Stage<Hypothesis>& hypothesis : hypotheses) {
    if (hypothesis->phase() != phase) continue;
    Proposals proposals = hypothesis->propose(problem, so_far.best);
    append(so_far.trail, std::move(proposals.trail));
    for (Proposal& proposal : proposals.accounts)
      judge(problem, hypotheses, phase, std::move(proposal), so_far);
  }
  return so_far;
}

Judged first_account(const Problem& problem, const Hypotheses& hypotheses, Baseline base) {
  Account bare = bare_account(problem, "coefficients-only",
                              std::make_shared<const Baseline>(std::move(base)));
  const double value = problem.options.criterion->value(evidence_of(bare));
  Judged best = judge_phase(problem, hypotheses, Phase::Effects, {std::move(bare)});
  best.trail.insert(best.trail.begin(),
                    {"coefficients-only", "nothing is missing", value,
                     best.best.hypothesis == "coefficients-only",
                     std::string(problem.options.criterion->info().name), value, value});
  return best;
}

Judged choose_account(const Problem& problem, const Hypotheses& hypotheses, Judged first) {
  return judge_phase(problem, hypotheses, Phase::Assumptions,
                     judge_phase(problem, hypotheses, Phase::Revision, std::move(first)));
}

Judged settle_account(const Problem& problem, const Hypotheses& hypotheses, Judged so_far) {
  so_far.best = with_claims(problem, std::move(so_far.best), so_far.trail);
  return judge_phase(problem, hypotheses, Phase::Residual, std::move(so_far));
}

Account without_names(const Problem& problem, const Account& account) {
  Account bare = bare_account(problem, account.hypothesis, account.base);
  bare.rounds = account.rounds;
  bare.notes = account.notes;
  bare.findings = account.findings;
  return bare;
}

Account without_claims(const Problem& problem, const Account& account) {
  if (!account.named.empty()) return without_names(problem, account);
  return bare_account(problem, "coefficients-only",
                      std::make_shared<const Baseline>(plain_baseline(problem)));
}

}  // namespace lacuna
