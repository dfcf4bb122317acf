// SPDX-License-Identifier: MIT
#include <algorithm>

#include "lacuna/regression/stages/refiner.hpp"

namespace lacuna {
namespace {

void sort_out(CoefficientPlaces& places) {
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
}

/// Whether a constraint asks for all of its coefficients.
bool asks_for_all(const CoefficientConstraint& constraint, const CoefficientPlaces& all,
                  const CoefficientPlaces& places) {
  const auto present = std::count_if(all.begin(), all.end(), [&](const auto& place) {
    return std::binary_search(places.begin(), places.end(), place);
  });
  const bool is_alone = present == 1 && all.size() > 1;
  return is_alone || (present == 0 && constraint.value != 0.0);
}

}  // namespace

ConstraintMatrix constraint_matrix(const std::vector<CoefficientConstraint>& constraints,
                                   const CoefficientPlaces& places) {
  const auto rows = static_cast<Index>(constraints.size());
  ConstraintMatrix result{Matrix::Zero(rows, static_cast<Index>(places.size())), Vector(rows)};
  for (Index i = 0; i < rows; ++i) {
    const CoefficientConstraint& constraint = constraints[static_cast<std::size_t>(i)];
    result.b[i] = constraint.value;
    for (const ConstrainedCoefficient& summand : constraint.summands) {
      const auto found =
          std::find(places.begin(), places.end(), std::pair(summand.equation, summand.term));
      if (found != places.end()) result.a(i, found - places.begin()) += summand.factor;
    }
  }
  return result;
}

CoefficientPlaces constrained_coefficients(
    const std::vector<CoefficientConstraint>& constraints) {
  CoefficientPlaces places;
  for (const CoefficientConstraint& constraint : constraints)
    for (const ConstrainedCoefficient& summand : constraint.summands)
      places.emplace_back(summand.equation, summand.term);
  sort_out(places);
  return places;
}

CoefficientPlaces closure(const std::vector<CoefficientConstraint>& constraints,
                          CoefficientPlaces places) {
  sort_out(places);
  for (bool grows = true; grows;) {
    grows = false;
    for (const CoefficientConstraint& constraint : constraints) {
      const CoefficientPlaces all = constrained_coefficients({constraint});
      if (!asks_for_all(constraint, all, places)) continue;
      places.insert(places.end(), all.begin(), all.end());
      sort_out(places);
      grows = true;
    }
  }
  return places;
}

}  // namespace lacuna
