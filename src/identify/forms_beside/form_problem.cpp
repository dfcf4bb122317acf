// SPDX-License-Identifier: MIT
#include "form_problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "base_columns.hpp"
#include "core/base/parallel.hpp"
#include "core/numerics/qr.hpp"
#include "core/statistics/information.hpp"
#include "forms/candidate/gauss_newton.hpp"
#include "forms/candidate/shape_scale.hpp"
#include "forms/candidate/shape_search.hpp"
#include "trajectories/subset_selection/subset_search.hpp"

namespace lacuna {
namespace {

/// Whether a candidate is taken in already: with other numbers it would only cancel itself.
bool has_form(const EquationForms& equation, const Candidate& candidate) {
  if (candidate.repeats) return false;
  return std::any_of(
      equation.forms.begin(), equation.forms.end(),
      [&](const MissingForm& form) { return are_one_form(form.candidate, candidate); });
}

/// By how much the sum of squares grows without each of the columns, h_i^2 / ((A'A)^-1)_ii.
/// Nothing where columns depend on one another, to within what residual_squares() counts.
std::optional<Vector> column_losses(const Matrix& columns, const Vector& target) {
  constexpr double kIndependent = 1e-9;  // well above the rank of residual_squares()
  if (columns.cols() < 2 || columns.rows() < columns.cols() || !columns.allFinite())
    return std::nullopt;
  const Vector norms = columns.colwise().norm().cwiseMax(1e-300);
  const PivotedQr factor(columns * norms.cwiseInverse().asDiagonal(), kIndependent);
  const Index count = columns.cols();
  if (factor.rank() < count) return std::nullopt;
  Vector variances(count);
  variances(factor.order()) = factor.inverse_triangle().rowwise().squaredNorm();
  return Vector(factor.solve(target).array().square() / variances.array());
}

/// In the place of a residual.
constexpr double kNotWorthAFit = std::numeric_limits<double>::infinity();

/// An equation with its columns, as forms are rated beside it.
class RatedBase {
 public:
  RatedBase(const Beside& beside, BaseColumns columns)
      : beside_(beside), columns_(std::move(columns)) {
    const EquationForms& equation = beside.equation;
    sizes_.assign(equation.terms.size(), 1);
    for (const MissingForm& form : equation.forms) sizes_.push_back(parameters_of(form));
    std::sort(sizes_.rbegin(), sizes_.rend());
    if (!(beside.takes > 0.0)) return;
    for (std::size_t gone = 0; gone <= sizes_.size(); ++gone)
      left_without_.push_back(columns_.left_without(static_cast<Index>(gone)));
  }

  /// Whether a form has few enough parameters to stand beside the equation, or in its place.
  bool has_room_for(const MissingForm& form) const {
    return parameters_of(form) + beside_.fewest_members <= beside_.most_parameters;
  }

  /// What the equation leaves with a form; infinite where that is not worth a fit.
  double rating(const MissingForm& form, const Vector& column) const {
    if (!has_room_for(form)) return kNotWorthAFit;
    if (left_without_.empty()) return columns_.left_with(column);
    const std::size_t gone = members_to_go(form);
    const double without = left_without_[gone];
    const double left = columns_.left_without(static_cast<Index>(gone), column);
    const double most = without - beside_.takes * std::max(0.0, without - beside_.limit);
    return left <= most ? left : kNotWorthAFit;
  }

 private:
  static std::size_t parameters_of(const MissingForm& form) {
    return 1 + static_cast<std::size_t>(form.shapes.size());
  }

  /// The fewest without which an equation with the form has as few parameters as it should.
  std::size_t members_to_go(const MissingForm& form) const {
    std::size_t count = parameters_of(form);
    for (const std::size_t size : sizes_) count += size;
    std::size_t gone = 0;
    while (gone < sizes_.size() && count > beside_.most_parameters) count -= sizes_[gone++];
    return gone;
  }

  const Beside& beside_;
  BaseColumns columns_;
  std::vector<std::size_t> sizes_;     ///< parameters of the members, most first
  std::vector<double> left_without_;  ///< so many members, without a form
};

template <class T>
std::vector<T> without(std::vector<T> list, std::size_t place) {
  list.erase(list.begin() + static_cast<std::ptrdiff_t>(place));
  return list;
}

}  // namespace

std::vector<Start> all_starts(const std::vector<Candidate>& candidates) {
  std::vector<Start> starts;
  for (std::size_t c = 0; c < candidates.size(); ++c) {
    if (!has_ranges(candidates[c])) continue;
    for (const Vector& shapes : candidates[c].starts)
      if (shapes.allFinite()) starts.push_back({{candidates[c], shapes}, c, 0.0});
  }
  return starts;
}

void set_residuals(const Vector& left, std::vector<Start>& starts) {
  for (std::size_t i = 0; i < starts.size(); ++i) starts[i].left = left[static_cast<Index>(i)];
}

std::vector<Start> best_of(const std::vector<Start>& starts, std::size_t count) {
  std::vector<std::size_t> order(starts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return starts[a].left < starts[b].left;
  });
  std::vector<Start> best;
  for (const std::size_t i : order) {
    const Start& start = starts[i];
    if (best.size() == count || !std::isfinite(start.left)) break;
    if (std::none_of(best.begin(), best.end(),
                     [&](const Start& other) { return other.candidate == start.candidate; }))
      best.push_back(start);
  }
  return best;
}

double Limit::operator()(const EquationForms& equation) const {
  const std::size_t now = equation.parameters();
  return left + (now < parameters ? penalty * static_cast<double>(parameters - now) : 0.0);
}

bool Limit::prefers(const Trial& a, const Trial& b) {
  const std::size_t cost = a.equation.parameters(), other = b.equation.parameters();
  return cost != other ? cost < other : a.left < b.left;
}

FormProblem::FormProblem(const Dataset& data, Vector noise, FormOptions options,
                         RunContext context, const std::vector<Term>& library,
                         const std::optional<Vector>& seen)
    : rows_(data, noise, library, context.threads, seen),
      noise_(std::move(noise)),
      options_(options),
      context_(std::move(context)) {}

double FormProblem::residual_noise(Index equation) const {
  constexpr double kResolution = 1e-8;  // of the target
  return static_cast<double>(rows_.rows()) * noise_[equation] * noise_[equation] +
         kResolution * kResolution * rows_.target(equation).squaredNorm();
}

double FormProblem::same_as(double left, double noise) const {
  const double chance = 2.0 * parameter_penalty(static_cast<double>(rows_.rows()));
  if (left > options_.mostly_noise * noise)
    return (1.0 + options_.same) * (1.0 + options_.same) * left;
  return std::max(left, noise) * (1.0 + chance / static_cast<double>(rows_.rows()));
}

Limit FormProblem::limit_of(const EquationForms& equation, Remainder remainder) const {
  const Index k = equation.equation;
  const double now = left(equation);
  const double noise = std::max(residual_noise(k), remainder == Remainder::Noise ? now : 0.0);
  const auto rows = static_cast<double>(rows_.rows());
  const bool is_noise = now <= options_.mostly_noise * noise;
  return {same_as(now, noise),
          is_noise ? parameter_penalty(rows) / rows * std::max(now, noise) : 0.0,
          equation.parameters()};
}

Matrix FormProblem::columns(const EquationForms& equation) const {
  std::vector<Expression> forms;
  for (const MissingForm& form : equation.forms) forms.push_back(form.expression());
  Matrix all(rows_.rows(), static_cast<Index>(equation.terms.size() + forms.size()));
  all << rows_.columns_of(equation.terms), rows_.columns(forms);
  return all;
}

double FormProblem::left(const EquationForms& equation) const {
  return residual_squares(columns(equation), rows_.target(equation.equation));
}

std::vector<Term> FormProblem::linear_terms() const {
  const Variables& variables = rows_.variables();
  std::vector<Term> terms{Term(Expression::number(1.0), variables)};
  for (const std::string& name : variables.names())
    if (name != "t") terms.emplace_back(Expression::variable(name), variables);
  return terms;
}

std::vector<Trial> FormProblem::with_each(const EquationForms& equation,
                                          const std::vector<Candidate>& candidates,
                                          double wanted) const {
  // A fact of the search: enough to rank forms, which are fitted again.
  constexpr int kEvaluationsRoughly = 25;
  std::vector<Start> starts = all_starts(candidates);
  const double takes = wanted > 0.0 ? options_.takes : 0.0;
  set_residuals(rated({{equation, kAnyNumber, 0, takes, wanted}}, starts).col(0), starts);
  const BaseColumns base(columns(equation), rows_.target(equation.equation));
  std::vector<Trial> trials;
  for (const Start& start :
       best_of(starts, static_cast<std::size_t>(options_.rough_fits))) {
    if (has_form(equation, start.form.candidate)) continue;
    trials.push_back({equation, 0.0});
    trials.back().equation.forms.push_back(start.form);
  }
  const auto fit = [&](std::size_t count, int evaluations) {
    parallel_for(std::min(count, trials.size()), context_.threads, [&](std::size_t i) {
      trials[i].left = fit_shapes(base, trials[i].equation.forms.back(),
                                 {evaluations, wanted});
    });
  };
  fit(trials.size(), kEvaluationsRoughly);
  const auto leaves_less = [](const Trial& a, const Trial& b) { return a.left < b.left; };
  std::stable_sort(trials.begin(), trials.end(), leaves_less);
  fit(static_cast<std::size_t>(options_.exact_fits), kEvaluationsExactly);
  std::stable_sort(trials.begin(), trials.end(), leaves_less);
  return trials;
}

Trial FormProblem::thinned(EquationForms equation, const MissingForm& form,
                           const Limit& limit) const {
  equation.forms.push_back(form);
  const auto last = [](const EquationForms& some) { return some.forms.size() - 1; };
  const auto fit = [&](EquationForms& some) {
    return polish(some, last(some), {kEvaluationsExactly, limit(some)});
  };
  Trial now{equation, fit(equation)};
  now.equation = equation;
  if (now.left > limit(now.equation)) now.left = std::numeric_limits<double>::infinity();
  if (now.left > limit(now.equation)) return now;
  // Columns of members are made once, but for that of the form whose shapes move.
  Matrix members = columns(now.equation);
  while (now.left <= limit(now.equation) && members.cols() > 1) {
    Trial next = without_least(now.equation, members);
    if (next.left > limit(next.equation)) {
      next.left = fit(next.equation);
      if (!(next.left <= limit(next.equation))) break;
      members.col(members.cols() - 1) =
          rows_.columns({next.equation.forms.back().expression()}).col(0);
    }
    now = std::move(next);
  }
  return now;
}

Trial FormProblem::chosen(const EquationForms& from, const MissingForm& form,
                          const Limit& limit) const {
  EquationForms all = from;
  all.forms.push_back(form);
  const Matrix members = columns(all);
  const Trial none{all, std::numeric_limits<double>::infinity()};
  if (!members.allFinite()) return none;
  const Index last = members.cols() - 1;
  Matrix system(members.rows(), members.cols() + 1);
  system << members, rows_.target(from.equation);
  const auto rows = static_cast<double>(rows_.rows());
  const Matrix triangle = Qr(system).triangle();
  const Subset subset =
      best_subset(subset_problem(triangle / std::sqrt(std::max(limit.left, 1e-300) / rows)),
                  2.0 * parameter_penalty(rows), {{last}}, Exchange::Single, context_);
  if (subset.columns.empty() || subset.columns.back() != last) return none;
  EquationForms few{from.equation, {}, {}};
  const auto terms = static_cast<Index>(from.terms.size());
  for (const Index c : subset.columns) {
    if (c == last) break;
    if (c < terms)
      few.terms.push_back(from.terms[static_cast<std::size_t>(c)]);
    else
      few.forms.push_back(from.forms[static_cast<std::size_t>(c - terms)]);
  }
  return thinned(std::move(few), form, limit);
}

bool FormProblem::alike(const MissingForm& a, const MissingForm& b, Plainness kind) const {
  const Matrix both = rows_.values({a.expression(), b.expression()});
  const double factor = both.col(0).dot(both.col(1)) / both.col(1).squaredNorm();
  const Vector scaled = factor * both.col(1);
  const double size = std::sqrt(scaled.squaredNorm() / static_cast<double>(scaled.size()));
  if (kind == Plainness::Any) return likeness(a, b) > options_.alike;
  const double spread = std::sqrt((scaled.array() - scaled.mean()).square().mean());
  return spread > options_.jump_varies * size &&
         ((both.col(0) - scaled).array().abs() > options_.jump_far * size)
                 .cast<double>()
                 .mean() < options_.jump_samples;
}

std::optional<MissingForm> FormProblem::rest_of(
    const Term& term, const MissingForm& form, const std::vector<Candidate>& candidates) const {
  // A fact of rounding: a rest is exactly a form, or none.
  constexpr double kRounding = 1e-9;
  if (form.shapes.size() == 0) return std::nullopt;
  const Matrix both = rows_.values({term.expression(), form.expression()});
  const Vector rest = both.col(0) - both.col(1);
  for (const Candidate& candidate : candidates) {
    if (candidate.shapes.size() != form.candidate.shapes.size() ||
        !(candidate.argument == form.candidate.argument))
      continue;
    const MissingForm other{candidate, form.shapes};
    const Vector values = rows_.values({other.expression()}).col(0);
    const Vector off = values * (values.dot(rest) / values.squaredNorm()) - rest;
    if (off.cwiseAbs().maxCoeff() <= kRounding * both.col(0).cwiseAbs().maxCoeff())
      return other;
  }
  return std::nullopt;
}

double FormProblem::likeness(const MissingForm& a, const MissingForm& b) const {
  Matrix both = rows_.values({a.expression(), b.expression()});
  both.rowwise() -= both.colwise().mean().eval();
  return std::abs(both.col(0).dot(both.col(1))) / (both.col(0).norm() * both.col(1).norm());
}

double FormProblem::polish(EquationForms& equation, std::size_t place,
                           const ShapeFit& fit) const {
  EquationForms others = equation;
  others.forms.erase(others.forms.begin() + static_cast<std::ptrdiff_t>(place));
  const BaseColumns base(columns(others), rows_.target(equation.equation));
  return fit_shapes(base, equation.forms[place], fit);
}

double FormProblem::fit_shapes(const BaseColumns& base, MissingForm& form,
                               const ShapeFit& fit) const {
  const ShapeScale scale(form.candidate.shapes);
  const auto column = [&](const Vector& at) -> Vector {
    context_.check_stop();
    form.shapes = scale.shapes(at);
    return rows_.columns({form.expression()}).col(0);
  };
  const Vector start = scale.unit(form.shapes);
  if (start.size() == 0) return base.left_with(column(start));
  const auto rest = [&](const Vector& at) { return base.rest_with(column(at)); };
  const CubeMinimum reached = gauss_newton(rest, start, {.wanted = fit.wanted});
  // At an end of its range a shape is not found, and a form is one of the library's terms; a
  // search without derivatives ends there as well.
  const bool is_out_of_reach = fit.wanted > 0.0 && is_far_above(reached.squares, fit.wanted);
  if (is_out_of_reach || reached.converged) {
    form.shapes = scale.shapes(reached.point);
    return reached.squares;
  }
  // Jumps have no derivative: they are sought without one.
  const auto left = [&](const Vector& at) {
    return std::log(std::max(base.left_with(column(at)), 1e-300));
  };
  const int most = fit.evaluations * static_cast<int>(start.size() * start.size());
  const double searched = std::exp(left(least_in_cube(left, start, {0.03, 1e-7, most})));
  const bool is_inside = reached.point.minCoeff() > 0.0 && reached.point.maxCoeff() < 1.0;
  if (!(is_inside && reached.squares < searched)) return searched;
  // Where rounding is left no step goes down, and none converges.
  form.shapes = scale.shapes(reached.point);
  return reached.squares;
}

Matrix FormProblem::rated(const std::vector<Beside>& equations,
                          const std::vector<Start>& starts) const {
  // A fact of the machines: columns in memory at a time.
  constexpr std::size_t kColumnsTogether = 32;
  std::vector<RatedBase> bases;
  for (const Beside& beside : equations) {
    const EquationForms& equation = beside.equation;
    bases.emplace_back(beside, BaseColumns(columns(equation), rows_.target(equation.equation)));
  }
  Matrix left = Matrix::Constant(static_cast<Index>(starts.size()),
                                 static_cast<Index>(equations.size()), kNotWorthAFit);
  std::vector<std::size_t> rated_starts;
  for (std::size_t i = 0; i < starts.size(); ++i)
    if (std::any_of(bases.begin(), bases.end(),
                    [&](const RatedBase& base) { return base.has_room_for(starts[i].form); }))
      rated_starts.push_back(i);
  const std::size_t chunks = (rated_starts.size() + kColumnsTogether - 1) / kColumnsTogether;
  parallel_for(chunks, context_.threads, [&](std::size_t chunk) {
    context_.check_stop();
    const std::size_t first = chunk * kColumnsTogether;
    const std::size_t end = std::min(rated_starts.size(), first + kColumnsTogether);
    std::vector<Expression> forms;
    for (std::size_t i = first; i < end; ++i)
      forms.push_back(starts[rated_starts[i]].form.expression());
    const Matrix added = columns_.columns(
        forms, rows(), [&](const std::vector<Expression>& some) { return rows_.columns(some); });
    for (std::size_t i = first; i < end; ++i)
      for (std::size_t e = 0; e < bases.size(); ++e)
        left(static_cast<Index>(rated_starts[i]), static_cast<Index>(e)) = bases[e].rating(
            starts[rated_starts[i]].form, added.col(static_cast<Index>(i - first)));
  });
  return left;
}

Trial FormProblem::without_least(const EquationForms& equation, Matrix& members) const {
  // Facts of rounding: sums of squares that differ by less are one.
  constexpr double kSame = 1e-6, kRounding = 1e-20;
  Trial best{equation, std::numeric_limits<double>::infinity()};
  const Index count = members.cols();
  const Vector target = rows_.target(equation.equation);
  const auto losses = column_losses(members, target);
  // Of members that can stand for one another (x for max(x, 0) and min(x, 0)) the one with most
  // parameters goes.
  const auto is_better = [&](const Trial& trial) {
    const double same = kSame * best.left + kRounding * target.squaredNorm();
    if (std::isfinite(best.left) && std::abs(trial.left - best.left) <= same)
      return trial.equation.parameters() < best.equation.parameters();
    return trial.left < best.left;
  };
  Matrix least;
  for (Index i = 0; i + 1 < count; ++i) {
    // Where columns depend on one another each is tried.
    if (losses && (*losses)[i] > losses->head(count - 1).minCoeff()) continue;
    Trial fewer{equation, 0.0};
    const auto place = static_cast<std::size_t>(i);
    if (place < equation.terms.size())
      fewer.equation.terms = without(equation.terms, place);
    else
      fewer.equation.forms = without(equation.forms, place - equation.terms.size());
    Matrix others(members.rows(), count - 1);
    others << members.leftCols(i), members.rightCols(count - 1 - i);
    fewer.left = residual_squares(others, target);
    if (!is_better(fewer)) continue;
    best = std::move(fewer);
    least = std::move(others);
  }
  if (std::isfinite(best.left)) members = std::move(least);
  return best;
}

}  // namespace lacuna
