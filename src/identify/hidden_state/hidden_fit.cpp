// SPDX-License-Identifier: MIT
#include "identify/hidden_state/hidden_fit.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "core/statistics/information.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

ParametrisedModel parametrised(OdeModel model, Index of) {
  const std::string& hidden = model.states().back().name;
  std::vector<FreeCoefficient> free;
  for (Index k = 0; k < model.dimension(); ++k) {
    const Equation& equation = model.equations()[static_cast<std::size_t>(k)];
    for (std::size_t i = 0; i < equation.size(); ++i)
      if (k != of || equation[i].term.name() != hidden)
        free.push_back({k, static_cast<Index>(i), {}});
  }
  return ParametrisedModel(std::move(model), std::move(free));
}

/// What a state's residuals are compared with: those of digits and steps.
double digits_of(const Refinement& fit, Index state) {
  const Vector path = fit.states.col(state);
  return kDigitsAndSteps * std::sqrt((path.array() - path.mean()).square().mean());
}

OdeModel with_equations(const OdeModel& model, std::vector<Equation> equations) {
  return OdeModel(model.states(), model.inputs(), std::move(equations), model.time_unit());
}

bool has(const Equation& equation, const Term& term) {
  return std::any_of(equation.begin(), equation.end(), [&](const WeightedTerm& summand) {
    return summand.term.name() == term.name();
  });
}

/// The model with each term of the library that the hidden state's equation lacks.
std::vector<OdeModel> with_one_more(const OdeModel& model, const TermLibrary& library) {
  std::vector<OdeModel> models;
  for (const Term& term : library.terms) {
    if (has(model.equations().back(), term)) continue;
    std::vector<Equation> equations = model.equations();
    equations.back().push_back({term, 0.0});
    models.push_back(with_equations(model, std::move(equations)));
  }
  return models;
}

/// The model without each of its terms but the one that sets the scale; equations keep one.
std::vector<OdeModel> with_one_less(const OdeModel& model, Index of) {
  const std::string& hidden = model.states().back().name;
  std::vector<OdeModel> models;
  for (Index k = 0; k < model.dimension(); ++k) {
    const Equation& equation = model.equations()[static_cast<std::size_t>(k)];
    for (std::size_t i = 0; i < equation.size() && equation.size() > 1; ++i) {
      if (k == of && equation[i].term.name() == hidden) continue;
      std::vector<Equation> equations = model.equations();
      Equation& shorter = equations[static_cast<std::size_t>(k)];
      shorter.erase(shorter.begin() + static_cast<std::ptrdiff_t>(i));
      models.push_back(with_equations(model, std::move(equations)));
    }
  }
  return models;
}

/// Takes the best of some models where it is better. @return whether one was.
bool take_best(std::vector<OdeModel> models, Index of, const Dataset& data, Refinement& fit,
               const RunContext& context) {
  double least = criterion(fit);
  bool taken = false;
  for (OdeModel& model : models) {
    Refinement other = fit_hidden(std::move(model), of, data, false, context);
    if (other.status == RefineStatus::Diverged || !(criterion(other) < least)) continue;
    least = criterion(other);
    fit = std::move(other);
    taken = true;
  }
  return taken;
}

}  // namespace

Refinement fit_hidden(OdeModel model, Index of, const Dataset& data, bool may_be_cut,
                      const RunContext& context) {
  return refine(parametrised(std::move(model), of), data, {.may_be_cut = may_be_cut}, context);
}

double criterion(const Refinement& fit) {
  const auto samples = static_cast<double>(fit.states.rows());
  const Index initial = static_cast<Index>(fit.windows.size()) * fit.states.cols();
  double deviance = 0.0;
  for (const ResidualStatistics& residual : fit.residuals)
    deviance += 2.0 * samples *
                std::log(std::max({residual.rms, digits_of(fit, residual.state), 1e-300}));
  return deviance +
         parameter_penalty(samples) * static_cast<double>(fit.model.values().size() + initial);
}

bool is_clean(const Refinement& fit, const ResidualStatistics& residual) {
  return residual.rms <= digits_of(fit, residual.state);
}

bool is_explained(const Refinement& fit, const ResidualStatistics& residual) {
  return residual.is_noise || is_clean(fit, residual);
}

bool spans(const Refinement& fit, Index period) {
  constexpr double kPeriods = 1.0;  // a decision (docs/decisions/numbers.md)
  const double window =
      static_cast<double>(fit.states.rows()) / static_cast<double>(fit.windows.size());
  return window >= kPeriods * static_cast<double>(period);
}

bool is_explained(const Refinement& fit, Index period) {
  return spans(fit, period) && std::all_of(fit.residuals.begin(), fit.residuals.end(),
                                           [&](const ResidualStatistics& residual) {
                                             return is_explained(fit, residual);
                                           });
}

Refinement with_a_term_of_trajectories(Refinement fit, Index of, const Dataset& data,
                                       const TermLibrary& library, Index period,
                                       const RunContext& context) {
  if (is_explained(fit, period)) return fit;
  Refinement best = fit;
  const auto take = [&](std::vector<OdeModel> models) {
    return take_best(std::move(models), of, data, best, context);
  };
  try {
    if (!take(with_one_more(best.fitted(), library))) return fit;
    while (take(with_one_less(best.fitted(), of))) {
    }
  } catch (const OutOfTime&) {
    fit.in_time = best.in_time = false;
  }
  return is_explained(best, period) ? best : fit;
}

}  // namespace lacuna
