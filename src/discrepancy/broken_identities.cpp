// SPDX-License-Identifier: MIT
#include "broken_identities.hpp"

#include <algorithm>
#include <cmath>

#include "lacuna/discrepancy/structure.hpp"
#include "search.hpp"

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

}  // namespace

std::optional<Assimilation> with_broken_identities(const OdeModel& nominal, const Dataset& data,
                                                   const Assimilation& exact,
                                                   const NoiseModel& explained,
                                                   const DiagnosisOptions& options,
                                                   const RunContext& context) {
  const auto m = static_cast<std::size_t>(nominal.dimension());
  std::vector<bool> disturbed(m);
  for (std::size_t k = 0; k < m; ++k)
    disturbed[k] = exact.noise.disturbance[static_cast<Index>(k)] > 0.0;
  const bool has_identities =
      std::find(disturbed.begin(), disturbed.end(), false) != disturbed.end();
  if (!has_identities || !noise_is_inflated(explained, exact)) return std::nullopt;
  context.report("testing the identities", 0.0);
  AssimilationOptions all;
  all.disturbed.assign(m, true);
  const Assimilation loose = assimilate(nominal, data, exact.omitted, all, context);
  bool broken = false;
  for (const EquationStructure& structure : test_structure(loose, context)) {
    const auto k = static_cast<std::size_t>(structure.equation);
    if (disturbed[k] || !is_substantial(structure, options)) continue;
    disturbed[k] = broken = true;
  }
  if (!broken) return std::nullopt;
  all.disturbed = disturbed;
  return assimilate(nominal, data, exact.omitted, all, context);
}

}  // namespace lacuna
