// SPDX-License-Identifier: MIT
#include "diagnose/hypotheses/broken_identity.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "diagnose/hypotheses/coloured_noise.hpp"

namespace lacuna {
namespace {

/// Whether an equation says something of measured states only; of a state that was not measured
/// an identity is the definition.
bool is_measured(const OdeModel& model, const NoiseModel& noise, std::size_t equation) {
  std::set<std::string> used;
  for (const WeightedTerm& summand : model.equations()[equation])
    used.merge(summand.term.expression().variables());
  for (std::size_t j = 0; j < model.states().size(); ++j) {
    const bool concerned = j == equation || used.contains(model.states()[j].name);
    if (concerned && !noise.measurement[j]) return false;
  }
  return true;
}

/// Equations that hold exactly so far, and about which the records could say something.
std::vector<bool> doubtful(const OdeModel& nominal, const Assimilation& exact) {
  std::vector<bool> doubted;
  for (Index k = 0; k < nominal.dimension(); ++k)
    doubted.push_back(exact.noise.disturbance[k] == 0.0 &&
                      is_measured(nominal, exact.noise, static_cast<std::size_t>(k)));
  return doubted;
}

/// The nominal model on the records with further equations disturbed.
Assimilation loosened(const Problem& problem, const Baseline& base,
                      const std::vector<bool>& further) {
  std::vector<bool> disturbed;
  for (std::size_t k = 0; k < further.size(); ++k)
    disturbed.push_back(further[k] ||
                        base.given.noise.disturbance[static_cast<Index>(k)] > 0.0);
  AssimilationOptions options;
  options.disturbed = std::move(disturbed);
  BoundRecords records = *base.records;
  records.outliers = base.given.omitted;
  return assimilate(problem.nominal, records, options, problem.context);
}

/// Of the doubted equations those that are substantially disturbed when they may be.
std::vector<bool> broken_among(const Problem& problem, const Baseline& base,
                               const std::vector<bool>& doubted) {
  std::vector<bool> broken(doubted.size(), false);
  const Assimilation all = loosened(problem, base, doubted);
  for (const EquationStructure& structure : test_disturbances(all, problem.context)) {
    const auto k = static_cast<std::size_t>(structure.equation);
    broken[k] = doubted[k] && is_substantial(structure, problem.options.decision);
  }
  return broken;
}

/// The baseline in which the broken identities are equations with a coefficient to fit.
Baseline loosened_baseline(const Problem& problem, const Baseline& base,
                           const std::vector<bool>& broken) {
  std::vector<CoefficientPlace> free = base.fit_options.free;
  double more = 0.0;
  for (std::size_t k = 0; k < broken.size(); ++k) {
    if (!broken[k]) continue;
    ++more;
    const CoefficientPlace first{static_cast<Index>(k), 0};
    const bool is_free = std::find(free.begin(), free.end(), first) != free.end();
    if (!problem.nominal.equations()[k].empty() && !is_free) free.push_back(first);
  }
  const Problem same{problem.nominal, *base.records, problem.options, problem.context,
                     problem.memory};
  Baseline next = fitted_baseline(same, loosened(problem, base, broken), std::move(free));
  next.parameters = more;  // a variance of the disturbance each
  next.correct = base.correct;
  next.notes = base.notes;
  next.notes.push_back(
      "the records contradict an identity: what is measured of a state and of its rate does "
      "not fit together, as with an offset or a gain of a sensor");
  return next;
}

bool any(const std::vector<bool>& flags) {
  return std::find(flags.begin(), flags.end(), true) != flags.end();
}

}  // namespace

Proposals BrokenIdentity::do_propose(const Problem& problem, const CompositeModel& best) const {
  const Baseline& base = *best.base;
  const std::vector<bool> doubted = doubtful(problem.nominal, base.given);
  if (!any(doubted)) return {};
  const std::string name(info().name), says = "identities that do not hold";
  const double inflation = noise_inflation(best.explanation.fit.noise, base.given);
  const double doubt = problem.options.decision.noise_inflation;
  if (!(inflation > doubt))
    return {{}, {{name, says, {}, false, "inflation of the noise", inflation, doubt}}};
  problem.context.report("testing the identities", 0.0);
  const std::vector<bool> broken = broken_among(problem, base, doubted);
  if (!any(broken)) return {{}, {{name, says, {}, false, "equations disturbed", 0.0, 1.0}}};
  auto loose = std::make_shared<const Baseline>(loosened_baseline(problem, base, broken));
  CompositeModel composite = bare_composite(problem, name, std::move(loose));
  composite.findings = best.findings;
  return {{{std::move(composite), true}}, {}};
}

}  // namespace lacuna
