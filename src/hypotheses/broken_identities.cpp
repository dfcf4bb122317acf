// SPDX-License-Identifier: MIT
#include "hypotheses/broken_identities.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "lacuna/estimation/disturbance_test.hpp"
#include "hypotheses/search.hpp"

namespace lacuna {
namespace {

/// Whether the noise of some channel, white and with a memory, is larger than what samples show
/// against their neighbours.
bool noise_is_inflated(const NoiseModel& noise, const Assimilation& exact) {
  constexpr double kInflated = 1.3;
  const Vector seen = exact.seen_noise.cwiseMax(10.0 * exact.least_noise);
  for (std::size_t k = 0; k < noise.measurement.size(); ++k) {
    if (!noise.measurement[k]) continue;
    const double slow = noise.coloured[k] ? noise.coloured[k]->deviation : 0.0;
    if (std::hypot(*noise.measurement[k], slow) > kInflated * seen[static_cast<Index>(k)])
      return true;
  }
  return false;
}

/// Whether an equation says something of measured states only; of a state that was not measured
/// an identity is the definition.
bool is_measured(const OdeModel& model, const NoiseModel& noise, std::size_t equation) {
  for (std::size_t j = 0; j < model.states().size(); ++j) {
    const std::set<std::string> used =
        model.equations()[equation].front().term.expression().variables();
    const bool concerned = j == equation || used.contains(model.states()[j].name);
    if (concerned && !noise.measurement[j]) return false;
  }
  return true;
}

}  // namespace

std::optional<Assimilation> with_broken_identities(const OdeModel& nominal, const Dataset& data,
                                                   const Assimilation& exact,
                                                   const NoiseModel& explained,
                                                   const DiagnosisOptions& options,
                                                   const RunContext& context) {
  const auto m = static_cast<std::size_t>(nominal.dimension());
  std::vector<bool> disturbed(m), doubted(m);
  for (std::size_t k = 0; k < m; ++k) {
    disturbed[k] = exact.noise.disturbance[static_cast<Index>(k)] > 0.0;
    doubted[k] = !disturbed[k] && is_measured(nominal, exact.noise, k);
  }
  const bool doubt = std::find(doubted.begin(), doubted.end(), true) != doubted.end();
  if (!doubt || !noise_is_inflated(explained, exact)) return std::nullopt;
  context.report("testing the identities", 0.0);
  const auto with = [&](const std::vector<bool>& more) {
    AssimilationOptions loose;
    for (std::size_t k = 0; k < m; ++k) loose.disturbed.push_back(disturbed[k] || more[k]);
    return assimilate(nominal, data, exact.omitted, loose, context);
  };
  std::vector<bool> broken(m, false);
  for (const EquationStructure& structure : test_structure(with(doubted), context)) {
    const auto k = static_cast<std::size_t>(structure.equation);
    broken[k] = doubted[k] && is_substantial(structure, options);
  }
  if (std::find(broken.begin(), broken.end(), true) == broken.end()) return std::nullopt;
  return with(broken);
}

}  // namespace lacuna
