// SPDX-License-Identifier: MIT
#include "identify/hidden_state/sparse_coordinates.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "core/numerics/eigenvalues.hpp"

namespace lacuna {
namespace {

using Exponents = Polynomial::Exponents;

int degree_of(const Exponents& exponents) {
  return std::accumulate(exponents.begin(), exponents.end(), 0);
}

int degree_of(const HiddenStateModel& model) {
  int degree = 0;
  for (const Polynomial& rate : model.rates)
    for (const auto& [exponents, coefficient] : rate.terms())
      degree = std::max(degree, degree_of(exponents));
  return degree;
}

/// A monomial with coefficient 1.
Polynomial monomial(const Exponents& exponents) {
  Polynomial result;
  result.add(exponents, {1.0, 0.0});
  return result;
}

/// Monomials of the measured states up to a degree, the constant first.
std::vector<Exponents> shifts(const HiddenStateModel& model, int degree) {
  const auto states = model.rates.size();
  std::vector<Exponents> found{Exponents(static_cast<std::size_t>(model.variables), 0)};
  for (std::size_t next = 0; next < found.size(); ++next) {
    if (degree_of(found[next]) == degree) continue;
    std::size_t last = states;  // variables in order, so that each monomial comes once
    while (last > 0 && found[next][last - 1] == 0) --last;
    for (std::size_t i = last > 0 ? last - 1 : 0; i < states; ++i) {
      if (static_cast<Index>(i) == model.hidden) continue;
      found.push_back(found[next]);
      ++found.back()[i];
    }
  }
  return found;
}

/// The model with one more variable, the last.
HiddenStateModel with_variable(const HiddenStateModel& model) {
  HiddenStateModel wider{{}, model.variables + 1, model.hidden};
  for (const Polynomial& rate : model.rates) {
    Polynomial& copy = wider.rates.emplace_back();
    for (const auto& [exponents, coefficient] : rate.terms()) {
      Exponents longer = exponents;
      longer.push_back(0);
      copy.add(longer, coefficient);
    }
  }
  return wider;
}

/// The model in s' = s - g phi, g being its last variable.
HiddenStateModel shifted(const HiddenStateModel& model, const Exponents& phi) {
  HiddenStateModel result = with_variable(model);
  Exponents shift = phi, state(static_cast<std::size_t>(result.variables), 0);
  shift.push_back(1);
  state[static_cast<std::size_t>(model.hidden)] = 1;
  const Polynomial added = monomial(shift);
  for (Polynomial& rate : result.rates)
    rate = substituted(rate, model.hidden, sum(monomial(state), added));
  Polynomial& hidden = result.rates[static_cast<std::size_t>(model.hidden)];
  for (std::size_t i = 0; i < result.rates.size(); ++i)
    if (static_cast<Index>(i) != model.hidden)
      hidden = sum(hidden, scaled(product(result.rates[i], derivative(added, Index(i))), -1.0));
  return result;
}

/// Real roots of sum_k c_k g^k, from the companion matrix.
std::vector<double> real_roots(std::vector<double> c) {
  while (!c.empty() && c.back() == 0.0) c.pop_back();
  const auto degree = static_cast<Index>(c.size()) - 1;
  if (degree < 1) return {};
  Matrix companion = Matrix::Zero(degree, degree);
  for (Index k = 0; k < degree; ++k) {
    companion(k, degree - 1) = -c[static_cast<std::size_t>(k)] / c.back();
    if (k > 0) companion(k, k - 1) = 1.0;
  }
  std::vector<double> roots;
  for (const auto& value : eigenvalues(companion))
    if (std::abs(value.imag()) <= 1e-6 * std::abs(value)) roots.push_back(value.real());
  return roots;
}

/// Values of the last variable at which a coefficient vanishes.
std::vector<double> vanishing_points(const HiddenStateModel& model) {
  std::vector<double> points;
  for (const Polynomial& rate : model.rates) {
    std::map<Exponents, std::vector<double>> by_monomial;
    for (const auto& [exponents, coefficient] : rate.terms()) {
      const auto power = static_cast<std::size_t>(exponents.back());
      auto& in_g = by_monomial[Exponents(exponents.begin(), exponents.end() - 1)];
      if (in_g.size() <= power) in_g.resize(power + 1, 0.0);
      in_g[power] = coefficient.value;
    }
    for (const auto& [exponents, in_g] : by_monomial)
      for (const double root : real_roots(in_g)) points.push_back(root);
  }
  return points;
}

/// Fraction of what it is a sum of that a coefficient is nothing below: the residual of a clean
/// record's digits and steps.
constexpr double kRounding = 1e-5;

/// The model at a value of its last variable, which it has no more.
HiddenStateModel at(const HiddenStateModel& model, double value) {
  HiddenStateModel result{{}, model.variables - 1, model.hidden};
  for (const Polynomial& rate : model.rates) {
    Polynomial& narrow = result.rates.emplace_back();
    std::map<Exponents, double> scales;  // of what coefficients are sums of
    for (const auto& [exponents, coefficient] : rate.terms()) {
      double& scale = scales[Exponents(exponents.begin(), exponents.end() - 1)];
      scale = std::max(scale, std::abs(coefficient.value * std::pow(value, exponents.back())));
    }
    const Polynomial whole = evaluated(rate, model.variables - 1, value);
    for (const auto& [exponents, coefficient] : whole.terms()) {
      const Exponents rest(exponents.begin(), exponents.end() - 1);
      if (std::abs(coefficient.value) > kRounding * scales[rest]) narrow.add(rest, coefficient);
    }
  }
  return without_vanishing(std::move(result));
}

}  // namespace

int complexity(const HiddenStateModel& model) {
  int total = 0;
  for (const Polynomial& rate : model.rates)
    for (const auto& [exponents, coefficient] : rate.terms()) total += 1 + degree_of(exponents);
  return total;
}

HiddenStateModel without_vanishing(HiddenStateModel model) {
  // A decision (docs/decisions.md).
  constexpr double kStandardErrors = 4.0;
  for (Polynomial& rate : model.rates) {
    Polynomial kept;
    for (const auto& [exponents, coefficient] : rate.terms())
      if (std::abs(coefficient.value) > kStandardErrors * std::sqrt(coefficient.variance))
        kept.add(exponents, coefficient);
    rate = std::move(kept);
  }
  return model;
}

HiddenStateModel in_sparse_coordinates(HiddenStateModel model) {
  const std::vector<Exponents> monomials = shifts(model, degree_of(model));
  for (;;) {
    std::optional<HiddenStateModel> simplest;
    for (const Exponents& phi : monomials) {
      const HiddenStateModel family = shifted(model, phi);
      for (const double g : vanishing_points(family)) {
        HiddenStateModel candidate = at(family, g);
        if (complexity(candidate) < complexity(simplest ? *simplest : model))
          simplest = std::move(candidate);
      }
    }
    if (!simplest) return model;
    model = std::move(*simplest);
  }
}

}  // namespace lacuna
