// SPDX-License-Identifier: MIT
#include "fitted_start.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/numerics/qr.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/trajectories/fit/fit.hpp"
#include "lacuna/trajectories/smoother/assimilation.hpp"
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

/// The place of the coefficient that a fit calls "w: sin(th)"; nothing where there is none.
std::optional<CoefficientPlace> place_of(const OdeModel& model, const std::string& number) {
  for (std::size_t k = 0; k < model.equations().size(); ++k)
    for (std::size_t j = 0; j < model.equations()[k].size(); ++j)
      if (model.states()[k].name + ": " + model.equations()[k][j].term.name() == number)
        return CoefficientPlace{static_cast<Index>(k), static_cast<Index>(j)};
  return std::nullopt;
}

/// By which factors all numbers change that are known only together with one of them where this
/// one changes by a factor: units of hidden states change logarithms of coefficients in
/// proportion, so that the least of all changes that nothing measured shows is a straight line.
Vector factors_with(const Fit& found, Index number, double factor) {
  const auto count = static_cast<Index>(found.numbers.size());
  Matrix open = found.spread.open;
  for (Index p = 0; p < count; ++p)
    open.row(p) /= found.numbers[static_cast<std::size_t>(p)].value;
  const Matrix basis = orthonormal_basis(open);
  const double own = basis.row(number).squaredNorm();
  if (!(own > 0.0) || !(factor > 0.0)) return Vector::Ones(count);
  return (basis * basis.row(number).transpose() * (std::log(factor) / own)).array().exp();
}

WeightedTerm& term_at(std::vector<Equation>& equations, const CoefficientPlace& place) {
  return equations[static_cast<std::size_t>(place.equation)]
                  [static_cast<std::size_t>(place.term)];
}

/// The fitted model with a number as it was given, fixed, and those that are known only together
/// with it moved as it is; nothing where it is the coefficient of no term.
std::optional<OdeModel> with_given(const Fit& found, const std::string& number,
                                   const OdeModel& given) {
  const OdeModel& fitted = found.model.model();
  std::vector<Equation> equations = fitted.equations(), before = given.equations();
  const auto own = place_of(fitted, number);
  const auto row =
      std::find_if(found.numbers.begin(), found.numbers.end(),
                   [&](const FittedParameter& one) { return one.name == number; });
  if (!own || row == found.numbers.end()) return std::nullopt;
  const double value = term_at(before, *own).coefficient;
  const Vector factors = factors_with(found, row - found.numbers.begin(),
                                      value / term_at(equations, *own).coefficient);
  for (Index p = 0; p < factors.size(); ++p)
    if (const auto place = place_of(fitted, found.numbers[static_cast<std::size_t>(p)].name))
      term_at(equations, *place).coefficient *= factors[p];
  term_at(equations, *own).coefficient = value;
  term_at(equations, *own).fixed = true;
  return fitted.with_equations(std::move(equations));
}

/// The fit; of numbers that the records determine only together one stays as it was given, so
/// that the others are determined.
Fit determined_fit(const OdeModel& model, const Dataset& measured,
                   const std::vector<StateNoise>& noise, const RunContext& context) {
  constexpr int kMostFixed = 3;  // a fact of cost: of each the model is fitted once more
  FitOptions options{.restarts = kRestarts, .starts = 0, .rough = true, .noise = noise};
  Fit found = fit(SystemModel(model), measured, {}, options, context);
  options.effort = Thoroughness::Quick;  // what follows begins at a fit
  for (int i = 0; i < kMostFixed && !found.combinations.empty(); ++i) {
    const std::vector<std::string>& members = found.combinations.front().members;
    if (members.empty()) break;
    if (!have_the_same_terms(found.model.model(), model)) break;
    const auto next = with_given(found, members.back(), model);
    if (!next) break;
    found = fit(SystemModel(*next), measured, {}, options, context);
  }
  return found;
}

}  // namespace

std::optional<OdeModel> fitted_start(const OdeModel& model, const OdeModel& nominal,
                                     const Dataset& measured,
                                     const std::vector<StateNoise>& noise,
                                     const RunContext& context) {
  context.unhurried().report("fitting the nominal structure to whole records", 0.0);
  RunContext quiet = context;
  quiet.progress = nullptr;
  try {
    const Fit found = determined_fit(with_shown_holds(model, measured), measured, noise, quiet);
    const OdeModel fitted = found.model.model();
    if (!have_the_same_terms(fitted, model)) return std::nullopt;
    return with_coefficients_of(fitted, nominal);
  } catch (const OutOfTime&) {
    return std::nullopt;  // the nominal numbers are a start, too
  } catch (const Error&) {
    return std::nullopt;  // what cannot be fitted so is diagnosed from where it is
  }
}

}  // namespace lacuna
