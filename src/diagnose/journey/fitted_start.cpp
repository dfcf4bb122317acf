// SPDX-License-Identifier: MIT
#include "fitted_start.hpp"

#include <utility>

#include "lacuna/core/base/error.hpp"
#include "lacuna/trajectories/fit/fit.hpp"
#include "records/channels/shown_holds.hpp"

namespace lacuna {
namespace {

/// Other starts than the nominal numbers, where residuals are above the noise: a start for
/// other fits need not be the best of many.
constexpr int kRestarts = 3;

/// The nominal model with the coefficients of the same terms in another one, whose states are
/// the first of it.
OdeModel with_coefficients_of(const OdeModel& fitted, const OdeModel& nominal) {
  std::vector<Equation> equations = nominal.equations();
  for (std::size_t k = 0; k < fitted.equations().size(); ++k)
    for (std::size_t j = 0; j < fitted.equations()[k].size(); ++j)
      equations[k][j].coefficient = fitted.equations()[k][j].coefficient;
  return nominal.with_equations(std::move(equations));
}

bool have_the_same_terms(const OdeModel& one, const OdeModel& other) {
  if (one.equations().size() != other.equations().size()) return false;
  for (std::size_t k = 0; k < one.equations().size(); ++k)
    if (one.equations()[k].size() != other.equations()[k].size()) return false;
  return true;
}

}  // namespace

std::optional<OdeModel> fitted_start(const OdeModel& model, const OdeModel& nominal,
                                     const Dataset& measured, const RunContext& context) {
  context.report("fitting the nominal structure to whole records", 0.0);
  const RunContext quiet{context.stop, {}, context.threads, context.seed};
  try {
    const Fit found = fit(SystemModel(with_shown_holds(model, measured)), measured, {}, {.restarts = kRestarts}, quiet);
    const OdeModel fitted = found.model.model();
    if (!have_the_same_terms(fitted, model)) return std::nullopt;
    return with_coefficients_of(fitted, nominal);
  } catch (const Error&) {
    return std::nullopt;  // what cannot be fitted so is diagnosed from where it is
  }
}

}  // namespace lacuna
