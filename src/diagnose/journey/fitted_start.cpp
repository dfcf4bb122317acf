// SPDX-License-Identifier: MIT
#include "fitted_start.hpp"

#include <string>
#include <utility>
#include <vector>

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

/// The model with the term of a parameter "w: sin(th)" fixed at its coefficient in another one;
/// nothing where there is no such term.
std::optional<OdeModel> with_fixed(const OdeModel& model, const std::string& number,
                                   const OdeModel& given) {
  std::vector<Equation> equations = model.equations();
  for (std::size_t k = 0; k < equations.size(); ++k)
    for (std::size_t j = 0; j < equations[k].size(); ++j) {
      WeightedTerm& term = equations[k][j];
      if (term.fixed || model.states()[k].name + ": " + term.term.name() != number) continue;
      term.coefficient = given.equations()[k][j].coefficient;
      term.fixed = true;
      return model.with_equations(std::move(equations));
    }
  return std::nullopt;
}

/// The fit; of numbers that the records determine only together one stays as it was given, so
/// that the others are determined.
Fit determined_fit(const OdeModel& model, const Dataset& measured,
                   const std::vector<StateNoise>& noise, const RunContext& context) {
  constexpr int kMostFixed = 3;  // a fact of cost: of each the model is fitted once more
  const FitOptions options{.restarts = kRestarts, .starts = 0, .rough = true, .noise = noise};
  Fit found = fit(SystemModel(model), measured, {}, options, context);
  for (int i = 0; i < kMostFixed && !found.combinations.empty(); ++i) {
    const std::vector<std::string>& members = found.combinations.front().members;
    if (members.empty()) break;
    const OdeModel& fitted = found.model.model();
    if (!have_the_same_terms(fitted, model)) break;
    const auto fixed = with_fixed(fitted, members.back(), model);
    if (!fixed) break;
    found = fit(SystemModel(*fixed), measured, {}, options, context);
  }
  return found;
}

}  // namespace

std::optional<OdeModel> fitted_start(const OdeModel& model, const OdeModel& nominal,
                                     const Dataset& measured,
                                     const std::vector<StateNoise>& noise,
                                     const RunContext& context) {
  context.report("fitting the nominal structure to whole records", 0.0);
  const RunContext quiet{context.stop, {}, context.threads, context.seed};
  try {
    const Fit found = determined_fit(with_shown_holds(model, measured), measured, noise, quiet);
    const OdeModel fitted = found.model.model();
    if (!have_the_same_terms(fitted, model)) return std::nullopt;
    return with_coefficients_of(fitted, nominal);
  } catch (const Error&) {
    return std::nullopt;  // what cannot be fitted so is diagnosed from where it is
  }
}

}  // namespace lacuna
