// SPDX-License-Identifier: MIT
#include "identify/forms_beside/missing_forms.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/base/parallel.hpp"
#include "form_problem.hpp"
#include "product_forms.hpp"
#include "rational_forms.hpp"

namespace lacuna {
namespace {

/// A decision (docs/decisions/numbers.md): what takes the place of something leaves half of it, a
/// quarter of squares.
constexpr double kHalf = 0.25;

bool jumps(const Expression& form) {
  return form.operation() == Operation::Sign || form.operation() == Operation::Step ||
         std::any_of(form.operands().begin(), form.operands().end(), jumps);
}

bool is_among(const Start& start, const std::vector<Start>& others) {
  return std::any_of(others.begin(), others.end(), [&](const Start& other) {
    return other.candidate == start.candidate && other.form.shapes == start.form.shapes;
  });
}

/// Without a form that is there twice: two that were shaped apart may have become one.
std::vector<MissingForm> distinct(const std::vector<MissingForm>& forms) {
  std::vector<MissingForm> result;
  for (const MissingForm& form : forms)
    if (std::none_of(result.begin(), result.end(), [&](const MissingForm& other) {
          return other.expression() == form.expression();
        }))
      result.push_back(form);
  return result;
}

/// Without one of the terms or, behind them, of the forms.
EquationForms without(EquationForms equation, std::size_t place) {
  const std::size_t terms = equation.terms.size();
  if (place < terms)
    equation.terms.erase(equation.terms.begin() + static_cast<std::ptrdiff_t>(place));
  else
    equation.forms.erase(equation.forms.begin() + static_cast<std::ptrdiff_t>(place - terms));
  return equation;
}

}  // namespace

Expression MissingForm::expression() const {
  return bind_form(candidate, {shapes.data(), static_cast<std::size_t>(shapes.size())});
}

std::size_t EquationForms::parameters() const {
  std::size_t count = terms.size() + forms.size();
  for (const MissingForm& form : forms) count += static_cast<std::size_t>(form.shapes.size());
  return count;
}

FormSearch::FormSearch(const Dataset& data, Vector noise, FormOptions options,
                       RunContext context, const std::vector<Term>& library,
                       const std::optional<Vector>& seen)
    : problem_(std::make_unique<const FormProblem>(data, std::move(noise), options,
                                                   std::move(context), library, seen)) {}
FormSearch::~FormSearch() = default;

Index FormSearch::rows() const { return problem_->rows(); }

double FormSearch::left(const EquationForms& equation) const {
  return problem_->left(equation);
}

bool FormSearch::would_fit_noise(const EquationForms& equation, double fraction) const {
  return problem_->would_fit_noise(equation, fraction);
}

std::vector<Candidate> FormSearch::fractions(const Scope& scope, Index equation,
                                             const std::vector<Term>& library) const {
  return rational_forms(scope, problem_->all_rows(), {equation, library, {}},
                        static_cast<std::size_t>(problem_->options().denominators),
                        problem_->context());
}

std::vector<Candidate> FormSearch::tones(const Scope& scope, Index equation,
                                         const std::vector<Term>& library) const {
  // A fact of the search: further peaks are sidelobes, or tones for a later round.
  constexpr std::size_t kPeaks = 3;
  return forcing_forms(scope, problem_->all_rows(), {equation, library, {}}, kPeaks,
                       problem_->context());
}

EquationForms FormSearch::recomposed(const EquationForms& equation,
                                     const std::vector<Candidate>& candidates,
                                     const std::vector<Term>& library,
                                     double negligible) const {
  const Index k = equation.equation;
  const auto most_forms = static_cast<std::size_t>(problem_->options().most_forms);
  const double solver = squares_of(negligible, k);
  const double least = std::max(solver, problem_->residual_noise(k));
  EquationForms whole{k, library, {}};
  if (problem_->left(whole) <= least) return whole;
  whole.forms = equation.forms;
  const std::size_t known = whole.forms.size();
  whole = extended(std::move(whole), candidates, known + most_forms, least);
  // Thinned it leaves no less. What is taken in the end fits or leaves half.
  if (problem_->left(whole) > std::max(fitting(least), kHalf * problem_->left(equation)))
    return equation;
  const double same = problem_->same_as(problem_->left(whole), problem_->residual_noise(k));
  const Limit limit{std::max(same, solver), 0.0, whole.parameters()};
  if (whole.forms.size() == known && problem_->left(equation) <= limit.left) return equation;
  Trial best{equation, std::numeric_limits<double>::infinity()};
  // Beside a library many functions leave the same: which one needs the least of it?
  const auto consider = [&](const EquationForms& others) {
    const Trial few = fewest_beside(others, candidates, limit);
    if (std::isfinite(few.left) && (!std::isfinite(best.left) || Limit::prefers(few, best)))
      best = few;
  };
  if (whole.forms.size() == known) consider(whole);
  for (std::size_t place = known; place < whole.forms.size(); ++place) {
    EquationForms others = whole;
    others.forms.erase(others.forms.begin() + static_cast<std::ptrdiff_t>(place));
    consider(others);
  }
  return std::isfinite(best.left) ? refitted(best.equation) : equation;
}

Trial FormSearch::fewest_beside(const EquationForms& others,
                                const std::vector<Candidate>& candidates,
                                const Limit& limit) const {
  std::vector<Trial> trials = problem_->with_each(others, candidates);
  // A form that is fitted roughly may still come within the limit: `thinned()` fits it.
  constexpr double kRoughly = 4.0;
  std::erase_if(trials, [&](const Trial& t) { return !(t.left <= kRoughly * limit.left); });
  const auto tried = static_cast<std::size_t>(problem_->options().thinned);
  if (trials.size() > tried)
    trials.erase(trials.begin() + static_cast<std::ptrdiff_t>(tried), trials.end());
  parallel_for(trials.size(), problem_->context().threads, [&](std::size_t i) {
    const MissingForm form = trials[i].equation.forms.back();
    trials[i] = problem_->chosen(others, form, limit);
  });
  Trial best{others, std::numeric_limits<double>::infinity()};
  for (const Trial& trial : trials)
    if (std::isfinite(trial.left) && (!std::isfinite(best.left) || Limit::prefers(trial, best)))
      best = trial;
  return best;
}

EquationForms FormSearch::with_missing_forms(EquationForms equation,
                                             const std::vector<Candidate>& candidates,
                                             std::size_t most_forms,
                                             double most_residual) const {
  const double least = fitting(problem_->residual_noise(equation.equation));
  return extended(std::move(equation), candidates, most_forms, least, most_residual);
}

double FormSearch::fitting(double noise) const {
  // A mean of squares of noise is known to sqrt(2 / rows) of it.
  const double scatter =
      problem_->options().significance * std::sqrt(2.0 / static_cast<double>(problem_->rows()));
  return (1.0 + scatter) * noise;
}

double FormSearch::squares_of(double fraction, Index equation) const {
  return fraction * fraction * problem_->all_rows().target(equation).squaredNorm();
}

EquationForms FormSearch::extended(EquationForms equation,
                                   const std::vector<Candidate>& candidates,
                                   std::size_t most_forms, double least,
                                   double most_residual) const {
  const Index k = equation.equation;
  double left = problem_->left(equation);
  while (equation.forms.size() < most_forms && left > least) {
    const double wanted = most_residual < 1.0 ? most_residual * most_residual * left : 0.0;
    const std::vector<Trial> trials = problem_->with_each(equation, candidates, wanted);
    if (trials.empty()) break;
    const double same = problem_->same_as(trials.front().left, problem_->residual_noise(k));
    if (!(left > same)) break;
    const auto plainer = [&](const Trial& a, const Trial& b) {
      const bool good = a.left <= same, other = b.left <= same;
      if (good != other) return good;
      const std::size_t cost = a.equation.parameters(), others = b.equation.parameters();
      return good && cost != others ? cost < others : a.left < b.left;
    };
    equation = refitted(std::min_element(trials.begin(), trials.end(), plainer)->equation);
    left = problem_->left(equation);
  }
  return equation;
}

EquationForms FormSearch::with_fewer_terms(EquationForms equation,
                                           const std::vector<Candidate>& candidates,
                                           const std::vector<Term>& library,
                                           Remainder remainder, double negligible) const {
  const auto tried = static_cast<std::size_t>(problem_->options().thinned);
  if (equation.terms.size() + equation.forms.size() < 2) return equation;
  Trial best{equation, problem_->left(equation)};
  Limit limit = problem_->limit_of(equation, remainder);
  limit.left = std::max(limit.left, squares_of(negligible, equation.equation));
  const EquationForms linear{equation.equation, problem_->linear_terms(), {}};
  const EquationForms whole{equation.equation, library, {}};
  const auto take = [&](const Trial& now) {
    const bool is_fewer = now.equation.parameters() < equation.parameters();
    if (std::isfinite(now.left) && is_fewer && Limit::prefers(now, best)) best = now;
  };
  std::vector<Start> starts = all_starts(candidates);
  const std::size_t most = equation.parameters() - 1;
  const double takes = problem_->options().takes;
  // Beside the whole library little lacks: there any form may be the one. What stands alone is
  // tried in the place of the equation's terms.
  const std::vector<Beside> bases{{equation, most, 0, takes, limit.left},
                                  {linear, most, 1, takes, limit.left},
                                  {whole, most, 1}};
  const Matrix rated = problem_->rated(bases, starts);
  std::vector<Start> chosen_starts;  ///< with which terms of the library were chosen already
  for (std::size_t b = 0; b < bases.size(); ++b) {
    const EquationForms* const from = &bases[b].equation;
    set_residuals(rated.col(static_cast<Index>(b)), starts);
    const std::vector<Start> best_starts = best_of(starts, tried);
    std::vector<std::array<std::optional<Trial>, 2>> trials(best_starts.size());
    parallel_for(trials.size(), problem_->context().threads, [&](std::size_t i) {
      const MissingForm& form = best_starts[i].form;
      if (from != &whole) trials[i][0] = problem_->thinned(*from, form, limit);
      const bool is_chosen = from == &whole && is_among(best_starts[i], chosen_starts);
      if (from != &linear && !is_chosen)
        trials[i][1] = problem_->chosen(whole, form, limit);
    });
    if (from == &equation) chosen_starts = best_starts;
    for (const auto& of_start : trials)
      for (const std::optional<Trial>& trial : of_start)
        if (trial) take(*trial);
  }
  // One form may do the work of some terms, another that of others.
  if (best.equation.parameters() < equation.parameters())
    return with_fewer_terms(std::move(best.equation), candidates, library, remainder,
                            negligible);
  return best.equation;
}

EquationForms FormSearch::exchanged(const EquationForms& equation,
                                    const std::vector<Candidate>& candidates) const {
  std::vector<Candidate> plain;
  for (const Candidate& candidate : candidates)
    if (candidate.shapes.empty()) plain.push_back(candidate);
  EquationForms best = with_exchanges(equation, plain);
  const std::size_t terms = equation.terms.size();
  for (std::size_t f = 0; f < equation.forms.size(); ++f) {
    if (equation.forms[f].shapes.size() == 0) continue;
    const std::vector<Trial> trials = problem_->with_each(without(equation, terms + f), plain);
    if (trials.empty()) continue;
    EquationForms other = with_exchanges(trials.front().equation, plain);
    const double same =
        problem_->same_as(problem_->left(best), problem_->residual_noise(best.equation));
    if (other.parameters() < best.parameters() && problem_->left(other) <= same)
      best = std::move(other);
  }
  return best;
}

EquationForms FormSearch::with_exchanges(EquationForms equation,
                                         const std::vector<Candidate>& plain) const {
  const double least = fitting(problem_->residual_noise(equation.equation));
  for (;;) {
    const double left = problem_->left(equation);
    if (!(left > least)) return equation;
    Trial best{equation, kHalf * left};
    bool changed = false;
    for (std::size_t place = 0; place < equation.terms.size() + equation.forms.size(); ++place) {
      const std::vector<Trial> trials = problem_->with_each(without(equation, place), plain);
      if (trials.empty() || !(trials.front().left < best.left)) continue;
      best = trials.front();
      changed = true;
    }
    if (!changed) return equation;
    equation = std::move(best.equation);
  }
}

std::optional<EquationForms> FormSearch::plainer(const EquationForms& equation,
                                                 const std::vector<Candidate>& candidates,
                                                 Plainness kind) const {
  EquationForms result = equation;
  bool changed = false;
  for (MissingForm& form : result.forms) {
    if (form.shapes.size() == 0) continue;
    for (const Candidate& candidate : candidates) {
      const MissingForm other{candidate, Vector()};
      if (!candidate.shapes.empty()) continue;
      if (kind == Plainness::Jump && !jumps(candidate.form)) continue;
      if (!problem_->alike(form, other, kind)) continue;
      form = other;
      changed = true;
      break;
    }
  }
  if (!changed) return std::nullopt;
  result.forms = distinct(result.forms);
  return result;
}

std::optional<EquationForms> FormSearch::with_fewer_shapes(
    const EquationForms& equation, const std::vector<Candidate>& candidates) const {
  EquationForms result = equation;
  bool changed = false;
  for (std::size_t f = 0; f < equation.forms.size(); ++f) {
    const auto shapes = static_cast<std::size_t>(equation.forms[f].shapes.size());
    if (shapes < 2) continue;
    std::vector<Candidate> fewer;
    for (const Candidate& candidate : candidates)
      if (!candidate.shapes.empty() && candidate.shapes.size() < shapes)
        fewer.push_back(candidate);
    EquationForms others = result;
    others.forms.erase(others.forms.begin() + static_cast<std::ptrdiff_t>(f));
    const std::vector<Trial> trials = problem_->with_each(others, fewer);
    if (trials.empty()) continue;
    result.forms[f] = trials.front().equation.forms.back();
    changed = true;
  }
  if (!changed) return std::nullopt;
  return refitted(std::move(result));
}

EquationForms FormSearch::plainly_written(EquationForms equation, const Vector& coefficients,
                                          const std::vector<Candidate>& candidates) const {
  const auto terms = static_cast<Index>(equation.terms.size());
  for (std::size_t f = 0; f < equation.forms.size(); ++f)
    for (Index i = 0; i < terms; ++i) {
      const double of_term = coefficients[i];
      const double of_form = coefficients[terms + static_cast<Index>(f)];
      if (!(std::abs(of_term + of_form) < std::abs(of_term))) continue;
      const auto& term = equation.terms[static_cast<std::size_t>(i)];
      if (const auto rest = problem_->rest_of(term, equation.forms[f], candidates)) {
        equation.forms[f] = *rest;
        break;
      }
    }
  equation.forms = distinct(equation.forms);
  return equation;
}

std::vector<MissingForm> FormSearch::shared_forms(
    const std::vector<EquationForms>& equations) const {
  std::vector<MissingForm> result;
  const auto is_one = [&](const MissingForm& form, const MissingForm& other) {
    Candidate there = form.candidate;
    there.equation = other.candidate.equation;
    return are_one_form(there, other.candidate) && problem_->alike(form, other, Plainness::Any);
  };
  for (const EquationForms& equation : equations)
    for (const MissingForm& form : equation.forms)
      if (std::none_of(result.begin(), result.end(),
                       [&](const MissingForm& other) { return is_one(form, other); }))
        result.push_back(form);
  return result;
}

EquationForms FormSearch::refitted(EquationForms equation) const {
  // A fact of the search: what further rounds move no test would notice.
  constexpr int kRounds = 3;
  const bool alone = equation.forms.size() == 1;
  for (int round = 0; round < (alone ? 1 : kRounds); ++round)
    for (std::size_t place = 0; place < equation.forms.size(); ++place)
      problem_->polish(equation, place);
  return equation;
}

}  // namespace lacuna
