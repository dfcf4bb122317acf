// SPDX-License-Identifier: MIT
#include "lacuna/libraries/missing_forms.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "candidates/nelder_mead.hpp"
#include "form_rows.hpp"

namespace lacuna {
namespace {

/// Evaluations for each shape when it is fitted to the last digits.
constexpr int kExact = 80;

/// A value of a shape parameter on the unit interval and back.
double to_unit(const ShapeParameter& shape, double value) {
  if (shape.logarithmic) return std::log(value / shape.low) / std::log(shape.high / shape.low);
  return (value - shape.low) / (shape.high - shape.low);
}

double from_unit(const ShapeParameter& shape, double place) {
  if (shape.logarithmic) return shape.low * std::pow(shape.high / shape.low, place);
  return shape.low + place * (shape.high - shape.low);
}

template <class Function>
Vector each_shape(const Candidate& candidate, const Vector& values, Function function) {
  Vector result(values.size());
  for (Index i = 0; i < values.size(); ++i)
    result[i] = function(candidate.shapes[static_cast<std::size_t>(i)], values[i]);
  return result;
}

/// A candidate at one of its starting points.
struct Start {
  MissingForm form;
  std::size_t candidate = 0;
  double left = 0.0;
};

bool jumps(const Expression& form) {
  return form.operation() == Operation::Sign || form.operation() == Operation::Step ||
         std::any_of(form.operands().begin(), form.operands().end(), jumps);
}

/// An equation and what it leaves.
struct Trial {
  EquationForms equation;
  double left = 0.0;
};

std::vector<Start> all_starts(const std::vector<Candidate>& candidates) {
  std::vector<Start> starts;
  for (std::size_t c = 0; c < candidates.size(); ++c)
    for (const Vector& shapes : candidates[c].starts)
      starts.push_back({{candidates[c], shapes}, c, 0.0});
  return starts;
}

/// The first so many, each candidate at its best starting point only.
std::vector<Start> best_of(std::vector<Start> starts, std::size_t count) {
  std::stable_sort(starts.begin(), starts.end(),
                   [](const Start& a, const Start& b) { return a.left < b.left; });
  std::vector<Start> best;
  for (Start& start : starts) {
    if (best.size() == count) break;
    if (std::none_of(best.begin(), best.end(),
                     [&](const Start& other) { return other.candidate == start.candidate; }))
      best.push_back(std::move(start));
  }
  return best;
}

/// Whether a candidate is taken in already: with other numbers it would only cancel itself.
bool has_form(const EquationForms& equation, const Candidate& candidate) {
  return std::any_of(
      equation.forms.begin(), equation.forms.end(),
      [&](const MissingForm& form) { return are_one_form(form.candidate, candidate); });
}

template <class T>
std::vector<T> without(std::vector<T> list, std::size_t place) {
  list.erase(list.begin() + static_cast<std::ptrdiff_t>(place));
  return list;
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

/// Rows, and what is left in them.
class FormSearch::Problem {
 public:
  Problem(const Dataset& data, Vector noise, RunContext context)
      : rows_(data, noise), noise_(std::move(noise)), context_(std::move(context)) {}

  /// The sum of squares that noise leaves, or quadrature and rounding where there is none.
  double noise_left(Index equation) const {
    constexpr double kResolution = 1e-6;  // of the target
    return static_cast<double>(rows_.rows()) * noise_[equation] * noise_[equation] +
           kResolution * kResolution * rows_.target(equation).squaredNorm();
  }

  /// The largest sum of squares that is the same as another: what is no noise is known to a
  /// tenth (rms), noise to what chance does for the best of many forms.
  double same_as(double left, Index equation) const {
    constexpr double kTenth = 1.21, kMostlyNoise = 2.0;
    const double noise = noise_left(equation);
    const double chance = 2.0 * std::log(static_cast<double>(rows_.rows()));
    if (left > kMostlyNoise * noise) return kTenth * left;
    return std::max(left, noise) * (1.0 + chance / static_cast<double>(rows_.rows()));
  }

  /// Columns of an equation: terms, then forms.
  Matrix columns(const EquationForms& equation) const {
    std::vector<Expression> all;
    for (const Term& term : equation.terms) all.push_back(term.expression());
    for (const MissingForm& form : equation.forms) all.push_back(form.expression());
    return all.empty() ? Matrix(rows_.rows(), 0) : rows_.columns(all);
  }

  double left(const EquationForms& equation) const {
    return squares_left(columns(equation), rows_.target(equation.equation));
  }

  /// The equation with each of the candidates, shapes fitted, the one that leaves least first.
  std::vector<Trial> with_each(const EquationForms& equation,
                               const std::vector<Candidate>& candidates) const {
    constexpr int kRough = 25;
    constexpr std::size_t kExactly = 6;
    std::vector<Start> starts = all_starts(candidates);
    rate(equation, false, starts);
    std::vector<Trial> trials;
    for (const Start& start : best_of(std::move(starts), candidates.size())) {
      if (has_form(equation, start.form.candidate)) continue;
      trials.push_back({equation, 0.0});
      trials.back().equation.forms.push_back(start.form);
      trials.back().left = polish(trials.back().equation, equation.forms.size(), kRough);
    }
    const auto leaves_less = [](const Trial& a, const Trial& b) { return a.left < b.left; };
    std::stable_sort(trials.begin(), trials.end(), leaves_less);
    for (std::size_t i = 0; i < std::min(kExactly, trials.size()); ++i)
      trials[i].left = polish(trials[i].equation, equation.forms.size(), kExact);
    std::stable_sort(trials.begin(), trials.end(), leaves_less);
    return trials;
  }

  /// The equation with one form more and without those members that are missed least, as long
  /// as what is left stays within a limit; infinite where already the form does not.
  Trial thinned(EquationForms equation, const MissingForm& form, double limit) const {
    equation.forms.push_back(form);
    Trial now{equation, polish(equation, equation.forms.size() - 1, kExact)};
    now.equation = equation;
    if (now.left > limit) now.left = std::numeric_limits<double>::infinity();
    while (now.left <= limit) {
      Trial next = without_least(now.equation);
      if (next.left > limit && !next.equation.forms.empty())
        next.left = polish(next.equation, next.equation.forms.size() - 1, kExact);
      if (!(next.left <= limit)) break;
      now = std::move(next);
    }
    return now;
  }

  /// Correlation of two forms over the samples.
  double likeness(const MissingForm& a, const MissingForm& b) const {
    Matrix both = rows_.values({a.expression(), b.expression()});
    both.rowwise() -= both.colwise().mean().eval();
    return std::abs(both.col(0).dot(both.col(1))) / (both.col(0).norm() * both.col(1).norm());
  }

  /// Fits the shapes of one form. @return what is left.
  double polish(EquationForms& equation, std::size_t place, int evaluations) const {
    MissingForm& form = equation.forms[place];
    const Vector target = rows_.target(equation.equation);
    Matrix all = columns(equation);
    const Index column = static_cast<Index>(equation.terms.size() + place);
    const auto left = [&](const Vector& at) {
      context_.check_stop();
      form.shapes = each_shape(form.candidate, at, from_unit);
      all.col(column) = rows_.columns({form.expression()});
      return std::log(std::max(squares_left(all, target), 1e-300));
    };
    if (form.shapes.size() == 0) return squares_left(all, target);
    const Vector start = each_shape(form.candidate, form.shapes, to_unit);
    const int most = evaluations * static_cast<int>(start.size() * start.size());
    return std::exp(left(nelder_mead(left, start, {0.03, 1e-7, most})));
  }

  /// What is left with one of the starting points more, and `fewer` of the terms gone, the best
  /// of them.
  void rate(const EquationForms& equation, bool without_two, std::vector<Start>& starts) const {
    const Matrix base = columns(equation);
    const Vector target = rows_.target(equation.equation);
    std::vector<Expression> forms;
    for (const Start& start : starts) forms.push_back(start.form.expression());
    const Matrix added = rows_.columns(forms);
    for (std::size_t i = 0; i < starts.size(); ++i) {
      Matrix all(base.rows(), base.cols() + 1);
      all << added.col(static_cast<Index>(i)), base;
      starts[i].left = without_two ? least_without_two(all, target) : squares_left(all, target);
    }
  }

 private:
  /// The equation without that member, the last form apart, that is missed least.
  Trial without_least(const EquationForms& equation) const {
    Trial best{equation, std::numeric_limits<double>::infinity()};
    for (std::size_t i = 0; i + 1 < equation.terms.size() + equation.forms.size(); ++i) {
      EquationForms fewer = equation;
      if (i < equation.terms.size())
        fewer.terms = without(equation.terms, i);
      else
        fewer.forms = without(equation.forms, i - equation.terms.size());
      const double without_it = left(fewer);
      if (without_it < best.left) best = {std::move(fewer), without_it};
    }
    return best;
  }

  /// What is left when the two columns behind the first leave that are missed least.
  static double least_without_two(const Matrix& all, const Vector& target) {
    double least = std::numeric_limits<double>::infinity();
    Matrix fewer(all.rows(), all.cols() - 2);
    for (Index i = 1; i < all.cols(); ++i)
      for (Index j = i + 1; j < all.cols(); ++j) {
        Index place = 0;
        for (Index c = 0; c < all.cols(); ++c)
          if (c != i && c != j) fewer.col(place++) = all.col(c);
        least = std::min(least, squares_left(fewer, target));
      }
    return least;
  }

  FormRows rows_;
  Vector noise_;
  RunContext context_;
};

FormSearch::FormSearch(const Dataset& data, Vector noise, RunContext context)
    : problem_(std::make_unique<const Problem>(data, std::move(noise), std::move(context))) {}
FormSearch::~FormSearch() = default;

EquationForms FormSearch::with_missing_forms(EquationForms equation,
                                             const std::vector<Candidate>& candidates,
                                             std::size_t most_forms) const {
  const Index k = equation.equation;
  double left = problem_->left(equation);
  while (equation.forms.size() < most_forms &&
         left > problem_->same_as(problem_->noise_left(k), k)) {
    const std::vector<Trial> trials = problem_->with_each(equation, candidates);
    if (trials.empty()) break;
    const double same = problem_->same_as(trials.front().left, k);
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
                                           const std::vector<Candidate>& candidates) const {
  constexpr std::size_t kTried = 40;
  if (equation.terms.size() + equation.forms.size() < 2) return equation;
  Trial best{equation, problem_->left(equation)};
  const double limit = problem_->same_as(best.left, equation.equation);
  std::vector<Start> starts = all_starts(candidates);
  problem_->rate(equation, true, starts);
  for (const Start& start : best_of(std::move(starts), kTried)) {
    const Trial now = problem_->thinned(equation, start.form, limit);
    const std::size_t cost = now.equation.parameters(), least = best.equation.parameters();
    const bool replaces = least < equation.parameters() && cost == least;
    if (std::isfinite(now.left) && (cost < least || (replaces && now.left < best.left)))
      best = now;
  }
  // One form may do the work of some terms, another that of others.
  if (best.equation.parameters() < equation.parameters())
    return with_fewer_terms(std::move(best.equation), candidates);
  return best.equation;
}

std::optional<EquationForms> FormSearch::plainer(const EquationForms& equation,
                                                 const std::vector<Candidate>& candidates,
                                                 Plainness kind) const {
  const double alike = kind == Plainness::Jump ? 0.97 : 0.99;
  EquationForms result = equation;
  bool changed = false;
  for (MissingForm& form : result.forms) {
    if (form.shapes.size() == 0) continue;
    for (const Candidate& candidate : candidates) {
      const MissingForm other{candidate, Vector()};
      if (!candidate.shapes.empty()) continue;
      if (kind == Plainness::Jump && !jumps(candidate.form)) continue;
      if (!(problem_->likeness(form, other) > alike)) continue;
      form = other;
      changed = true;
      break;
    }
  }
  if (!changed) return std::nullopt;
  // Two forms that were shaped apart may be one.
  for (std::size_t i = result.forms.size(); i-- > 1;)
    for (std::size_t j = 0; j < i; ++j)
      if (result.forms[i].expression() == result.forms[j].expression()) {
        result.forms = without(std::move(result.forms), i);
        break;
      }
  return result;
}

EquationForms FormSearch::refitted(EquationForms equation) const {
  constexpr int kRounds = 3;
  const bool alone = equation.forms.size() == 1;
  for (int round = 0; round < (alone ? 1 : kRounds); ++round)
    for (std::size_t place = 0; place < equation.forms.size(); ++place)
      problem_->polish(equation, place, kExact);
  return equation;
}

}  // namespace lacuna
