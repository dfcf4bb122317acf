// SPDX-License-Identifier: MIT
#include "identify/hidden_state/identify_hidden.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/text.hpp"
#include "data/derivatives/moving_polynomial.hpp"
#include "identify/hidden_state/hidden_fit.hpp"
#include "identify/hidden_state/sparse_coordinates.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/records/binding/embedding.hpp"
#include "trajectories/shooting/refine.hpp"
#include "trajectories/windows/window_gap.hpp"

namespace lacuna {
namespace {

using Exponents = Polynomial::Exponents;

/// A model in which the rate of a measured state is a state.
struct DerivativeModel {
  Index of = 0;  ///< the measured state
  IdentificationResult result;
};

/// Place of a variable of the embedded model (measured states with the derivative behind its
/// own, inputs, t) among those of the model with the hidden state last.
std::vector<std::size_t> places(std::size_t variables, std::size_t states, std::size_t hidden) {
  std::vector<std::size_t> result(variables);
  for (std::size_t i = 0; i < variables; ++i) result[i] = i > hidden && i < states ? i - 1 : i;
  result[hidden] = states - 1;
  return result;
}

/// @throws ConfigError when a term is not a monomial.
HiddenStateModel polynomials_of(const DerivativeModel& found) {
  const OdeModel& model = found.result.model;
  const auto variables = static_cast<std::size_t>(model.variables().count());
  const auto place =
      places(variables, model.states().size(), static_cast<std::size_t>(found.of) + 1);
  HiddenStateModel polynomials{std::vector<Polynomial>(model.states().size()),
                               model.variables().count(), model.dimension() - 1};
  for (std::size_t k = 0; k < model.equations().size(); ++k)
    for (const WeightedTerm& summand : model.equations()[k]) {
      const auto& powers = summand.term.exponents();
      if (!powers)
        throw ConfigError("--hidden", "the term " + summand.term.name() + " is no monomial",
                          "choose a polynomial library (--degree)");
      Exponents exponents(variables, 0);
      for (std::size_t i = 0; i < variables; ++i) exponents[place[i]] = (*powers)[i];
      const double error = summand.standard_error.value_or(0.0);
      polynomials.rates[place[k]].add(exponents, {summand.coefficient, error * error});
    }
  return polynomials;
}

OdeModel model_of(const HiddenStateModel& polynomials, const Dataset& data,
                  const std::string& name) {
  std::vector<Quantity> states = data.states;
  states.push_back({name, ""});
  const Variables variables{names_of(states), names_of(data.inputs)};
  std::vector<Equation> equations;
  for (const Polynomial& rate : polynomials.rates) {
    Equation& equation = equations.emplace_back();
    for (const auto& [exponents, coefficient] : rate.terms())
      equation.push_back({Term::monomial(exponents, variables), coefficient.value});
  }
  return OdeModel(std::move(states), data.inputs, std::move(equations), data.time_unit);
}

/// Whether a fit is as good as another one, within what is known of the rms of residuals.
bool is_as_good(const Refinement& fit, const Refinement& as) {
  if (fit.status == RefineStatus::Diverged) return false;
  const double samples = static_cast<double>(fit.states.rows());
  const double scatter = 4.0 / std::sqrt(2.0 * samples);
  for (std::size_t q = 0; q < fit.residuals.size(); ++q)
    if (fit.residuals[q].rms > (1.0 + scatter) * as.residuals[q].rms &&
        !is_clean(fit, fit.residuals[q]))
      return false;
  return true;
}

/// A model with the hidden state, fitted to what was measured.
struct HiddenFit {
  DerivativeModel derivative;
  Refinement fit;
  int complexity = 0;
  Index period = 0;  ///< samples that a model has to follow

  /// What the better one of two has less of: what is no noise in windows of a period, then
  /// terms, or else residuals. In windows of a few samples any model follows the records.
  std::pair<bool, double> worth() const {
    const bool explained = is_explained(fit, period);
    double misfit = 0.0;
    for (const ResidualStatistics& residual : fit.residuals)
      misfit = std::max(misfit, residual.rms / std::max(residual.noise, 1e-300));
    return {!explained, explained ? complexity : misfit};
  }
};

/// Samples of the shortest mean period of what was measured.
Index samples_of_period(const Dataset& data) {
  std::vector<Matrix> paths;
  for (const Trajectory& record : data.trajectories) paths.push_back(record.states);
  std::vector<bool> measured;
  for (Index k = 0; k < data.state_count(); ++k) measured.push_back(data.is_measured(k));
  return window_samples(paths, measured);
}

/// Whether no fit makes a model with so many terms better than one that is found.
bool is_beaten(int complexity, const std::optional<HiddenFit>& by) {
  return by && by->worth() <= std::pair(false, static_cast<double>(complexity));
}

/// The simplest model that does what the model of the derivative does; nothing where that has
/// no solutions, or cannot be better than the best one so far. Past the deadline a first one is
/// fitted in short windows as it was found.
/// @throws OutOfTime past the deadline, where there is a best one.
std::optional<HiddenFit> fitted(DerivativeModel derivative,
                                const std::optional<HiddenFit>& best, const Dataset& data,
                                const std::string& name, const RunContext& context) {
  const Index period = samples_of_period(data);
  const HiddenStateModel plain = without_vanishing(polynomials_of(derivative));
  const HiddenStateModel sparse = in_sparse_coordinates(plain);
  const bool is_simpler = complexity(sparse) < complexity(plain);
  if (is_beaten(complexity(is_simpler ? sparse : plain), best)) return std::nullopt;
  Refinement as_found =
      fit_hidden(model_of(plain, data, name), derivative.of, data, !best, context);
  if (as_found.status == RefineStatus::Diverged) return std::nullopt;
  try {
    if (is_simpler && as_found.in_time)
      if (Refinement simple =
              fit_hidden(model_of(sparse, data, name), derivative.of, data, false, context);
          is_as_good(simple, as_found))
        return HiddenFit{std::move(derivative), std::move(simple), complexity(sparse), period};
  } catch (const OutOfTime&) {
    as_found.in_time = false;
  }
  return HiddenFit{std::move(derivative), std::move(as_found), complexity(plain), period};
}

/// What the derivatives of the measured states lead to.
struct HiddenFits {
  std::optional<HiddenFit> best;
  bool in_time = true;  ///< or the deadline came before all states had had their turn
};

/// The best one of the models that the derivatives of the measured states give. Past the
/// deadline the remaining states are left out, as soon as there is a model.
HiddenFits fits_to(const Dataset& data, const Pipeline& pipeline,
                   const Differentiator& differentiator, const std::string& name,
                   const RunContext& context) {
  HiddenFits fits;
  try {
    for (Index k = 0; k < data.state_count(); ++k) {
      if (data.rate_state(k) || !data.is_measured(k)) continue;
      const std::string& state = data.states[static_cast<std::size_t>(k)].name;
      const RunContext needed = fits.best ? context : context.unhurried();
      needed.report("derivative of " + state, double(k) / double(data.state_count()));
      DerivativeModel derivative{
          k, identify(embed(data, {{state, 2}}, differentiator), pipeline, context)};
      if (fits.best) context.check_stop();  // a model in a hurry is no better one
      std::optional<HiddenFit> found =
          fitted(std::move(derivative), fits.best, data, name, context);
      if (found && (!fits.best || found->worth() < fits.best->worth()))
        fits.best = std::move(found);
    }
  } catch (const OutOfTime&) {
    fits.in_time = false;
  }
  return fits;
}

/// What there was no time for.
void enter_hurry(const HiddenFits& fits, IdentificationResult& result) {
  std::erase_if(result.stages, [](const StageDone& s) { return s.name == kTrajectoriesStage; });
  if (fits.best->fit.in_time) {
    result.stages.push_back({kTrajectoriesStage});
  } else {
    result.stages.push_back({kTrajectoriesStage, false, kTimeIsUp});
    result.warnings.push_back(std::string("no plainer model was looked for: ") + kTimeIsUp);
  }
  if (!fits.in_time)
    result.warnings.push_back(
        std::string("the rates of some measured states were not tried: ") + kTimeIsUp);
}

/// The records with the hidden state along them: what dx_k/dt leaves, x_k smoothed.
Dataset with_hidden(const Dataset& data, const OdeModel& model, Index of, double noise) {
  Dataset result = data;
  const Index m = data.state_count();
  const Quantity& hidden = model.states().back();
  result.states.push_back(hidden);
  result.reconstructed.resize(static_cast<std::size_t>(m), false);
  result.reconstructed.push_back(true);
  if (!result.rate_of.empty()) result.rate_of.resize(static_cast<std::size_t>(m) + 1);
  CompiledModel rates = model.compile();
  for (Trajectory& record : result.trajectories) {
    const Vector rate = smooth_by_polynomials(record.time, record.states.col(of), noise).col(1);
    record.derivatives.resize(0, 0);
    record.states.conservativeResize(Eigen::NoChange, m + 1);
    if (record.marks.size() > 0) {
      record.marks.conservativeResize(Eigen::NoChange, m + 1);
      record.marks.col(m).setZero();
    }
    Vector x(m + 1), f(m + 1), u(record.inputs.cols());
    for (Index i = 0; i < record.samples(); ++i) {
      x << record.states.row(i).head(m).transpose(), 0.0;
      u = record.inputs.row(i).transpose();
      rates.evaluate(record.time[i], x.data(), u.data(), nullptr, f.data());
      record.states(i, m) = rate[i] - f[of];
    }
  }
  return result;
}

/// Numbers of the equations, of the fit that has the last word.
/// @param period samples that a model has to follow: in shorter windows nothing is shown.
std::vector<EquationFit> fits_of(const Refinement& fit, Index period) {
  const bool shown = spans(fit, period);
  std::vector<EquationFit> result;
  for (const Quantity& state : fit.model.symbolic().states()) {
    EquationFit& equation = result.emplace_back();
    equation.equation = state.name;
    equation.rows = fit.states.rows();
    equation.converged = fit.status == RefineStatus::Converged;
    equation.iterations = fit.iterations;
  }
  for (const ResidualStatistics& residual : fit.residuals) {
    EquationFit& equation = result[static_cast<std::size_t>(residual.state)];
    equation.misfit = residual.noise > 0.0 ? residual.rms / residual.noise : 0.0;
    equation.fits_to_noise = shown && is_explained(fit, residual);
  }
  return result;
}

}  // namespace

HiddenIdentification identify_hidden(const Dataset& data, const Pipeline& pipeline,
                                     const Differentiator& differentiator,
                                     const std::string& name, const RunContext& context) {
  for (const auto* quantities : {&data.states, &data.inputs})
    for (const Quantity& quantity : *quantities)
      if (quantity.name == name)
        throw ConfigError("--hidden", "the name '" + name + "' is taken",
                          "rename that column with --map");
  HiddenFits fits = fits_to(data, pipeline, differentiator, name, context);
  if (!fits.best)
    throw DataError("records", "no measured state's rate gives a model that has solutions",
                    "measure more, or give candidate terms (--terms, --degree)");
  const Index of = fits.best->derivative.of;
  const std::string rate = data.states[static_cast<std::size_t>(of)].name;
  const Index period = fits.best->period;
  Refinement& fit = fits.best->fit;
  const TermLibrary library = pipeline.basis->library(fit.model.symbolic().variables());
  fit = with_a_term_of_trajectories(std::move(fit), of, data, library, period, context);
  IdentificationResult result = std::move(fits.best->derivative.result);
  const double noise = result.noise[of];
  result.model = fit.fitted();
  result.fit = fits_of(fit, period);
  result.noise = Vector::Zero(result.model.dimension());
  for (const ResidualStatistics& residual : fit.residuals)
    result.noise[residual.state] = residual.rms;
  result.path.clear();
  result.warnings.clear();
  result.warnings.push_back(name + " was not measured: it is the residual of d" + rate +
                            "/dt, where its coefficient is set to 1; the trail is that of " +
                            rate + "_d1 = d" + rate + "/dt");
  if (!fit.message.empty()) result.warnings.push_back("fit with " + name + ": " + fit.message);
  if (!spans(fit, period))
    result.warnings.push_back("the model follows the records in windows of " +
                              std::to_string(fit.states.rows() / Index(fit.windows.size())) +
                              " samples, shorter than a mean period of " +
                              std::to_string(period) + ": they do not show that it is right");
  for (const EquationFit& equation : result.fit)
    if (spans(fit, period) && !equation.fits_to_noise.value_or(true))
      result.warnings.push_back(
          "d" + equation.equation + "/dt: trajectories of the model are off by " +
          format_number(*equation.misfit, 2) + " times the measurement noise");
  enter_hurry(fits, result);
  Dataset along = with_hidden(data, result.model, of, noise);
  return {std::move(result), std::move(along), rate};
}

}  // namespace lacuna
