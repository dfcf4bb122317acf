// SPDX-License-Identifier: MIT
#include "lacuna/identify/alternatives/alternatives.hpp"

#include <algorithm>
#include <cmath>

#include "core/statistics/information.hpp"
#include "data/records/known_noise.hpp"
#include "identify/forms_beside/base_columns.hpp"
#include "identify/forms_beside/form_problem.hpp"
#include "identify/forms_beside/model_comparison.hpp"
#include "identify/validation/refit.hpp"
#include "identify/validation/validate.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

/// A structure that differs in one equation, by what it scores less than the best there.
struct Neighbour {
  std::size_t equation = 0;
  std::vector<Term> terms;
  double score = 0.0;
};

std::size_t coefficients_of(const OdeModel& model) {
  std::size_t count = 0;
  for (const Equation& equation : model.equations()) count += equation.size();
  return count;
}

bool has(const std::vector<Term>& terms, const Term& term) {
  return std::find(terms.begin(), terms.end(), term) != terms.end();
}

std::vector<Term> terms_of(const Equation& equation) {
  std::vector<Term> terms;
  for (const WeightedTerm& summand : equation) terms.push_back(summand.term);
  return terms;
}

/// Candidates of an equation that it does not have.
std::vector<Term> absent_terms(const IdentificationResult& result, std::size_t equation,
                               const std::vector<Term>& present) {
  std::vector<Term> absent;
  for (const TrailEntry& entry : result.trail) {
    if (entry.equation != result.model.states()[equation].name) continue;
    Term term = Term::parse(entry.term, result.model.variables());
    if (!has(present, term) && !has(absent, term)) absent.push_back(std::move(term));
  }
  return absent;
}

/// The rows of one equation, and what structures score in them.
class Neighbourhood {
 public:
  Neighbourhood(const FormProblem& problem, std::size_t equation, std::vector<Term> present,
                std::vector<Term> absent)
      : equation_(equation),
        present_(std::move(present)),
        absent_(std::move(absent)),
        columns_(problem.all_rows().columns_of(absent_)),
        rows_(problem.all_rows()),
        target_(rows_.target(static_cast<Index>(equation))) {}

  /// Adds the structures one step away.
  void add_to(std::vector<Neighbour>& all) {
    const double best = score(BaseColumns(rows_.columns_of(present_), target_).left(),
                              present_.size());
    add_extended(present_, best, all);
    for (std::size_t i = 0; i < present_.size(); ++i) {
      std::vector<Term> fewer = present_;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
      const double left = BaseColumns(rows_.columns_of(fewer), target_).left();
      if (!fewer.empty())
        all.push_back({equation_, fewer, score(left, fewer.size()) - best});
      add_extended(fewer, best, all);
    }
  }

 private:
  /// With each absent term more.
  void add_extended(const std::vector<Term>& terms, double best, std::vector<Neighbour>& all) {
    const BaseColumns base(rows_.columns_of(terms), target_);
    for (std::size_t j = 0; j < absent_.size(); ++j) {
      const double left = base.left_with(columns_.col(static_cast<Index>(j)));
      if (!std::isfinite(left)) continue;
      std::vector<Term> more = terms;
      more.push_back(absent_[j]);
      const double scored = score(left, more.size()) - best;
      all.push_back({equation_, std::move(more), scored});
    }
  }

  double score(double left, std::size_t terms) const {
    const auto rows = static_cast<double>(target_.size());
    return rows * std::log(std::max(left, 1e-300)) +
           parameter_penalty(rows) * static_cast<double>(terms);
  }

  std::size_t equation_;
  std::vector<Term> present_, absent_;
  Matrix columns_;
  const FormRows& rows_;
  Vector target_;
};

/// The structures one step away, those that score least first.
std::vector<Neighbour> neighbours_of(const Dataset& data, const IdentificationResult& result,
                                     const Vector& seen, const RunContext& context) {
  const FormProblem problem(data, result.noise, {}, context, {}, seen);
  std::vector<Neighbour> all;
  for (std::size_t k = 0; k < result.fit.size(); ++k) {
    std::vector<Term> present = terms_of(result.model.equations()[k]);
    if (result.fit[k].identity || present.empty()) continue;
    std::vector<Term> absent = absent_terms(result, k, present);
    if (problem.rows() <= static_cast<Index>(present.size()) + 1) continue;
    Neighbourhood(problem, k, std::move(present), std::move(absent)).add_to(all);
  }
  std::stable_sort(all.begin(), all.end(), [](const Neighbour& a, const Neighbour& b) {
    return a.score < b.score;
  });
  return all;
}

OdeModel with_structure(const OdeModel& model, const Neighbour& neighbour) {
  std::vector<Equation> equations = model.equations();
  Equation& equation = equations[neighbour.equation];
  equation.clear();
  for (const Term& term : neighbour.terms) equation.push_back({term, 1.0});
  return model.with_equations(std::move(equations));
}

/// "dx/dt: x*y" of every term that one model has and the other does not.
std::vector<std::string> terms_only_in(const OdeModel& model, const OdeModel& other) {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < model.equations().size(); ++k) {
    const std::vector<Term> others = terms_of(other.equations()[k]);
    for (const Term& term : terms_of(model.equations()[k]))
      if (!has(others, term))
        names.push_back(left_hand_side(model.states()[k].name, model.evolution()) + ": " +
                        term.name());
  }
  return names;
}

/// The largest error of predictions as a fraction of the motion.
std::optional<double> error_of(const Validation& validation) {
  const PredictionTest& test =
      validation.windows.states.empty() ? validation.one_step : validation.windows;
  std::optional<double> largest;
  for (const PredictionError& state : test.states)
    if (state.motion > 0.0)
      largest = std::max(largest.value_or(0.0), state.error / state.motion);
  return largest;
}

/// Weights of the models, the best one among them.
void set_weights(std::vector<AlternativeModel>& found) {
  double lowest = 0.0;
  for (const AlternativeModel& one : found) lowest = std::min(lowest, one.criterion);
  double sum = std::exp(0.5 * lowest);  // of the best model, whose criterion is 0
  for (const AlternativeModel& one : found) sum += std::exp(0.5 * (lowest - one.criterion));
  for (AlternativeModel& one : found) one.weight = std::exp(0.5 * (lowest - one.criterion)) / sum;
}

}  // namespace

std::vector<AlternativeModel> find_alternatives(const RecordStream& records,
                                                const IdentificationResult& result,
                                                const Pipeline& pipeline,
                                                const AlternativeOptions& options,
                                                const RunContext& context) {
  std::vector<AlternativeModel> found;
  if (result.model.is_map() || options.count == 0) return found;
  const Dataset& data = records.excerpt();
  const std::vector<StateNoise> noise = records.noise(context.threads);
  const ModelComparison models(data, noise);
  const auto n = static_cast<double>(data.samples());
  const double penalty = parameter_penalty(n * static_cast<double>(data.state_count()));
  std::vector<Neighbour> neighbours = neighbours_of(data, result, white_noise(noise), context);
  const std::size_t fitted = options.count * options.fitted;
  if (neighbours.size() > fitted) neighbours.resize(fitted);
  // The best is fitted as they are, so that they differ in structure alone.
  const auto best = refitted_result_on(data, result.model, pipeline, context);
  if (!best) return found;
  for (std::size_t i = 0; i < neighbours.size(); ++i) {
    context.check_stop();
    context.report("fitting other structures",
                   static_cast<double>(i) / static_cast<double>(neighbours.size()));
    const auto other = refitted_result_on(data, with_structure(result.model, neighbours[i]),
                                          pipeline, context);
    if (!other) continue;
    const double more = static_cast<double>(coefficients_of(other->model)) -
                        static_cast<double>(coefficients_of(best->model));
    const double criterion = 2.0 * n * models.excess(*other, *best) + penalty * more;
    if (!(criterion <= options.difference)) continue;
    const ValidationTask task{*other, data, pipeline, {}, KnownNoise(noise)};
    found.push_back({other->model, criterion, 0.0,
                     error_of(validate(task, options.validation, context)),
                     terms_only_in(result.model, other->model),
                     terms_only_in(other->model, result.model)});
  }
  const auto is_ahead = [](const AlternativeModel& a, const AlternativeModel& b) {
    return a.criterion < b.criterion;
  };
  std::stable_sort(found.begin(), found.end(), is_ahead);
  if (found.size() > options.count)
    found.erase(found.begin() + static_cast<std::ptrdiff_t>(options.count), found.end());
  set_weights(found);
  return found;
}

}  // namespace lacuna
