// SPDX-License-Identifier: MIT
#include "fit_answer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/base/text.hpp"
#include "lacuna/records/binding/gaps.hpp"
#include "trajectories/fit/adequacy/fit_adequacy.hpp"

namespace lacuna {
namespace {

/// Gives a coefficient its number. Where the model has joined terms (they are one with numbers
/// for fixed parameters), it is that of their sum: the first that is free takes what the others
/// leave.
void set_coefficient(const SystemModel& system, const std::vector<Index>& places, Index place,
                     const FittedParameter& number, Equation& equation) {
  WeightedTerm* first = nullptr;
  double others = 0.0;
  for (std::size_t i = 0; i < equation.size(); ++i) {
    if (places[i] != place) continue;
    const bool free = !equation[i].fixed && !system.gives_size(equation[i].term.expression());
    if (first == nullptr && free)
      first = &equation[i];
    else
      others += equation[i].coefficient;
  }
  first->coefficient = number.value - others;
  first->standard_error = number.standard_error;
  first->ci95 = number.ci95;
  if (first->ci95)
    for (double& end : *first->ci95) end -= others;
}

/// Whether `diagnose` takes the model and the records.
bool may_be_diagnosed(const Fit& fit) {
  const auto is_long = [](const FitRun& run) {
    return run.time.size() >= GapOptions{}.shortest_record;
  };
  return fit.model.symbolic().events().empty() &&
         std::any_of(fit.runs.begin(), fit.runs.end(), is_long);
}

/// What follows from residuals that are not noise.
std::string lack_of(const Fit& fit) {
  if (const Admission admission = standing_of(fit).admission; !admission.stands())
    return "whether the model lacks something is open (" + admission.why + ")";
  return std::string("the model lacks something (") +
         (may_be_diagnosed(fit) ? "see `lacuna diagnose`"
                                : "`lacuna fit ONE.ode TWO.ode DATA` compares structures") +
         "), and intervals hold for this model only";
}

/// What the residuals of a channel say; empty where they are noise or rounding.
std::string note_of(const FitQuality& quality, const Fit& fit) {
  if (quality.residuals == Adequate::No)
    return "the residuals of " + quality.channel + " are not white (" + quality.sign +
           ", p = " + format_number(quality.chance, 2) + "): " + lack_of(fit);
  if (quality.residuals == Adequate::Undetermined && !(quality.fit_percent >= kExactFit))
    return std::to_string(quality.samples) + " samples of " + quality.channel +
           " are too few to show a deviation of the model as large as the noise";
  return "";
}

/// Log-likelihoods of the values of one record, n x c: NaN for what is no value. A channel
/// without a law is normal with the mean square of its residuals.
Matrix likelihoods_of(const FitEngine& engine, const FitPath& path, Index record) {
  const Index first = engine.records.first(record), n = engine.records.end(record) - first;
  Matrix all = Matrix::Constant(n, engine.count(), std::numeric_limits<double>::quiet_NaN());
  for (Index c = 0; c < engine.count(); ++c) {
    const auto& law = engine.laws[static_cast<std::size_t>(c)];
    const double count = engine.records.valid.col(c).sum();
    const double variance = std::max(path.residuals.col(c).squaredNorm() / count,
                                     std::numeric_limits<double>::min());
    for (Index i = 0; i < n; ++i) {
      if (engine.records.valid(first + i, c) == 0.0) continue;
      const double value = engine.records.values(first + i, c),
                   residual = path.residuals(first + i, c);
      const bool known =
          engine.records.deviations.size() > 0 && engine.records.deviations(first + i, c) > 0.0;
      const double own =
          known ? std::pow(engine.records.deviations(first + i, c), 2) : variance;
      all(i, c) = law ? law->log_likelihood(value, value - residual)
                      : -0.5 * (std::log(2.0 * std::numbers::pi * own) +
                                residual * residual / own);
    }
  }
  return all;
}

}  // namespace

std::vector<std::vector<FittedStart>> starts_of(const FitEngine& engine,
                                                const FitUnknowns& unknowns,
                                                const FitPoint& point,
                                                const Matrix& errors) {
  std::vector<std::vector<FittedStart>> records;
  for (Index r = 0; r < point.starts.rows(); ++r) {
    std::vector<FittedStart>& states = records.emplace_back();
    for (Index k = 0; k < engine.states(); ++k) {
      const auto& initial = unknowns.initial[static_cast<std::size_t>(k)];
      FittedStart start{engine.model.symbolic().states()[static_cast<std::size_t>(k)].name,
                        point.starts(r, k), initial && initial->fixed};
      if (!start.fixed && std::isfinite(errors(r, k)))
        start.standard_error = errors(r, k);
      states.push_back(std::move(start));
    }
  }
  return records;
}

std::vector<FitCorrelation> correlations_of(const FitEngine& engine,
                                            const FitUnknowns& unknowns,
                                            const Matrix& covariance) {
  constexpr double kMuch = 0.9;
  const std::vector<std::string> names = engine.model.names();
  const auto name = [&](Index i) {
    return names[static_cast<std::size_t>(unknowns.global[static_cast<std::size_t>(i)])];
  };
  const Vector deviation = covariance.diagonal().cwiseSqrt();
  std::vector<FitCorrelation> found;
  for (Index i = 0; i < deviation.size(); ++i)
    for (Index j = i + 1; j < deviation.size(); ++j) {
      const double both = deviation[i] * deviation[j];
      if (both > 0.0 && std::isfinite(both) && std::abs(covariance(i, j)) > kMuch * both)
        found.push_back({name(i), name(j), covariance(i, j) / both});
    }
  return found;
}

SystemModel with_numbers(const SystemModel& system, const ParametrisedModel& model,
                         std::vector<FittedParameter>& numbers) {
  std::vector<Equation> equations = system.symbolic().equations();
  const std::vector<std::vector<Index>> places = system.places_in_parametrised();
  std::size_t i = 0;
  for (const FreeCoefficient& free : model.coefficients()) {
    const auto k = static_cast<std::size_t>(free.equation);
    set_coefficient(system, places[k], free.summand, numbers[i++], equations[k]);
  }
  std::vector<Parameter> parameters = system.parameters();
  for (Parameter& parameter : parameters) {
    if (!parameter.free) continue;
    numbers[i].unit = parameter.unit;
    parameter.value = numbers[i].value;
    parameter.deviation.reset();  // what was known before is part of the estimate now
    parameter.factor.reset();
    if (const auto& spread = numbers[i].spread; spread && spread->value == 0.0)
      parameter.varies.reset();
    else if (spread)
      parameter.varies->size = spread->by_factor ? std::exp(spread->value) : spread->value;
    parameter.standard_error = numbers[i].standard_error;
    parameter.ci95 = numbers[i++].ci95;
  }
  return {system.symbolic().with_equations(std::move(equations)), std::move(parameters)};
}

double total_of(const std::vector<FitRun>& runs) {
  double total = 0.0;
  for (const FitRun& run : runs)
    for (const double likelihood : run.log_likelihood.reshaped())
      if (std::isfinite(likelihood)) total += likelihood;
  return total;
}

std::string searches_sentence(int starts, int agreeing) {
  if (agreeing >= starts)
    return "all " + std::to_string(starts) +
           " searches, from different starts, came to this fit";
  const std::string others = starts - agreeing == 1
                                 ? "the other one"
                                 : "the other " + std::to_string(starts - agreeing);
  if (agreeing > 1)
    return std::to_string(agreeing) + " of " + std::to_string(starts) +
           " searches, from different starts, came to this fit, " + others + " to worse ones";
  return "one of " + std::to_string(starts) +
         " searches, from different starts, came to this " + "fit, the best, and " + others +
         " to worse ones: another start may come to a better " + "one (--starts 60)";
}

std::vector<std::string> notes_of(const Fit& fit) {
  std::vector<std::string> notes;
  if (!fit.converged)
    notes.push_back("the fit did not converge: the numbers are the last ones");
  for (const FittedParameter& number : fit.numbers)
    if (number.bound)
      notes.push_back(number.name + " ended at the " + *number.bound + " of its range");
  for (const FitQuality& quality : fit.quality)
    if (const std::string note = note_of(quality, fit); !note.empty()) notes.push_back(note);
  if (fit.starts > 1) notes.push_back(searches_sentence(fit.starts, fit.agreeing));
  if (const std::string line = left_out_line(fit.stages); !line.empty()) notes.push_back(line);
  return notes;
}

Matrix usual_states(const FitPath& path) {
  Matrix usual(path.states.cols(), 2);
  for (Index k = 0; k < usual.rows(); ++k) {
    const double mean = path.states.col(k).mean();
    usual(k, 0) = mean;
    usual(k, 1) = std::sqrt((path.states.col(k).array() - mean).square().mean());
  }
  return usual;
}

void add_laws(const FitEngine& engine, std::vector<FitQuality>& quality) {
  for (std::size_t c = 0; c < quality.size(); ++c) {
    const auto channel = static_cast<Index>(c);
    const Matrix& known = engine.records.deviations;
    if (known.size() > 0 && known.col(channel).maxCoeff() > 0.0) quality[c].sizes = 0;
    if (!engine.laws[c]) continue;
    const NoiseLaw& given = engine.laws[c]->law();
    quality[c].law = engine.laws[c]->sized();
    quality[c].sizes = (has_constant(given.form) && !given.constant ? 1 : 0) +
                       (has_fraction(given.form) && !given.fraction ? 1 : 0);
    for (Index n = 0; n < engine.records.samples(); ++n)
      if (engine.records.valid(n, channel) > 0.0 && !is_value(engine, n, channel))
        ++quality[c].censored;
  }
}

std::vector<FitRun> runs_of(const FitEngine& engine, const FitPath& path) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::vector<FitRun> runs;
  for (Index r = 0; r < engine.records.records(); ++r) {
    const Index first = engine.records.first(r), n = engine.records.end(r) - first;
    FitRun run{engine.records.sources[static_cast<std::size_t>(r)],
               engine.records.series.time.segment(first, n),
               engine.records.values.middleRows(first, n), Matrix(),
               likelihoods_of(engine, path, r)};
    run.model = run.measured - path.residuals.middleRows(first, n);
    for (Index c = 0; c < engine.count(); ++c)
      for (Index i = 0; i < n; ++i)
        if (engine.records.valid(first + i, c) == 0.0)
          run.measured(i, c) = run.model(i, c) = kNone;
    runs.push_back(std::move(run));
  }
  return runs;
}

namespace {

/// What it rests on that the model fits or lacks something. Other starts find nothing better than
/// noise; what a quick run leaves out nobody expects of it, but where something is lacking they
/// might have found a fit.
VerdictBasis basis_of(const Fit& fit, const FitStanding& standing) {
  const bool lacks = standing.fits == Adequate::No;
  VerdictBasis basis{.claim = lacks ? Claim::WrongStructure : Claim::Fits,
                     .open = standing.open,
                     .shows_opposite =
                         standing.fits != Adequate::Undetermined || standing.is_exact};
  for (const StageDone& stage : fit.stages) {
    const bool finds_more = stage.name == "starts" && standing.fits != Adequate::Yes &&
                            (lacks || stage.why != kIsQuick);
    if (stage.name == "fit" || finds_more) basis.stages.push_back(stage);
  }
  return basis;
}

}  // namespace

FitStanding standing_of(const Fit& fit) {
  FitStanding standing{.converged = fit.converged,
                       .fits = fit.adequacy.fits,
                       .numbers = fit.numbers.size()};
  for (const FittedParameter& number : fit.numbers) {
    const auto& errors = number.per_record_errors;
    const bool each = !number.spread && !number.per_record.empty() &&
                      std::all_of(errors.begin(), errors.end(),
                                  [](double error) { return std::isfinite(error); });
    if (number.bound)
      standing.at_ends.push_back(number.name);
    else if (!number.ci95 && !each)
      standing.open.push_back(number.name);
  }
  standing.is_exact = fit.adequacy.fits == Adequate::Undetermined && !fit.quality.empty() &&
                      std::all_of(fit.quality.begin(), fit.quality.end(),
                                  [](const FitQuality& quality) {
                                    return quality.fit_percent >= kExactFit;
                                  });
  standing.admission = admit(basis_of(fit, standing));
  return standing;
}

std::string sentence_of(const FitStanding& standing) {
  if (standing.admission.standing == Standing::Incomplete)
    return "Incomplete, " + standing.admission.why + ": the numbers are the best so far.";
  if (!standing.converged) return "The fit did not converge.";
  std::string numbers = "The parameters are estimated";
  const std::size_t off = standing.open.size() + standing.at_ends.size();
  if (off > 0) {
    std::vector<std::string> parts;
    if (!standing.open.empty())
      parts.push_back("the records do not determine " + join(standing.open, ", "));
    if (!standing.at_ends.empty())
      parts.push_back(join(standing.at_ends, ", ") + " ended at the end of the range");
    numbers = std::to_string(standing.numbers - off) + " of " +
              std::to_string(standing.numbers) + " parameters are determined (" +
              join(parts, "; ") + ")";
  }
  switch (standing.fits) {
    case Adequate::Yes:
      return numbers + ", and the residuals are noise.";
    case Adequate::No:
      return numbers + "; the residuals have structure.";
    case Adequate::Undetermined:
      break;
  }
  if (standing.is_exact) return numbers + "; the residual is rounding.";
  return numbers +
         "; the samples are too few to show whether the residuals are noise.";
}

}  // namespace lacuna
