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

  /// The sum of squares that noise leaves.
  double noise_left(Index equation) const {
    return static_cast<double>(rows_.rows()) * noise_[equation] * noise_[equation];
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

  /// Correlation of two forms in the rows, without their means.
  double likeness(const MissingForm& a, const MissingForm& b) const {
    Matrix both = rows_.columns({a.expression(), b.expression()});
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
    const int most = evaluations * static_cast<int>(start.size());
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
  constexpr int kRough = 25, kExact = 80;
  constexpr double kClose = 3.0;
  const Index k = equation.equation;
  double left = problem_->left(equation);
  while (equation.forms.size() < most_forms &&
         left > problem_->same_as(problem_->noise_left(k), k)) {
    std::vector<Start> starts = all_starts(candidates);
    problem_->rate(equation, false, starts);
    std::vector<std::pair<EquationForms, double>> tried;
    double least = std::numeric_limits<double>::infinity();
    for (const Start& start : best_of(std::move(starts), candidates.size())) {
      if (has_form(equation, start.form.candidate)) continue;
      EquationForms more = equation;
      more.forms.push_back(start.form);
      double now = problem_->polish(more, more.forms.size() - 1, kRough);
      if (now < kClose * least) now = problem_->polish(more, more.forms.size() - 1, kExact);
      least = std::min(least, now);
      tried.emplace_back(std::move(more), now);
    }
    if (tried.empty() || !(left > problem_->same_as(least, k))) break;
    const double same = problem_->same_as(least, k);
    const auto plainer = [&](const auto& a, const auto& b) {
      const bool good = a.second <= same, other = b.second <= same;
      if (good != other) return good;
      const std::size_t cost = a.first.parameters(), others = b.first.parameters();
      return good && cost != others ? cost < others : a.second < b.second;
    };
    equation = refitted(std::min_element(tried.begin(), tried.end(), plainer)->first);
    left = problem_->left(equation);
  }
  return equation;
}

EquationForms FormSearch::with_fewer_terms(EquationForms equation,
                                           const std::vector<Candidate>& candidates) const {
  constexpr std::size_t kTried = 40;
  constexpr int kExact = 80;
  if (equation.terms.size() + equation.forms.size() < 2) return equation;
  const double limit = problem_->same_as(problem_->left(equation), equation.equation);
  std::vector<Start> starts = all_starts(candidates);
  problem_->rate(equation, true, starts);
  EquationForms best = equation;
  double least = problem_->left(equation);
  for (const Start& start : best_of(std::move(starts), kTried)) {
    EquationForms now = equation;
    now.forms.push_back(start.form);
    for (double left = problem_->polish(now, now.forms.size() - 1, kExact); left <= limit;) {
      if (now.parameters() < best.parameters() ||
          (now.parameters() == best.parameters() && left < least)) {
        best = now;
        least = left;
      }
      // The next to leave is the one that is missed least.
      EquationForms next = now;
      left = std::numeric_limits<double>::infinity();
      const std::size_t members = now.terms.size() + now.forms.size() - 1;
      for (std::size_t i = 0; i < members; ++i) {
        EquationForms fewer = now;
        if (i < now.terms.size())
          fewer.terms = without(now.terms, i);
        else
          fewer.forms = without(now.forms, i - now.terms.size());
        const double without_it = problem_->left(fewer);
        if (without_it >= left) continue;
        left = without_it;
        next = std::move(fewer);
      }
      if (members == 0) break;
      if (left > limit) left = problem_->polish(next, next.forms.size() - 1, kExact);
      now = std::move(next);
    }
  }
  return best;
}

std::optional<EquationForms> FormSearch::plainer(
    const EquationForms& equation, const std::vector<Candidate>& candidates) const {
  constexpr double kAlike = 0.998;
  EquationForms result = equation;
  bool changed = false;
  for (MissingForm& form : result.forms) {
    if (form.shapes.size() == 0) continue;
    for (const Candidate& candidate : candidates) {
      const MissingForm other{candidate, Vector()};
      if (!candidate.shapes.empty() || problem_->likeness(form, other) < kAlike) continue;
      form = other;
      changed = true;
      break;
    }
  }
  if (!changed) return std::nullopt;
  return result;
}

EquationForms FormSearch::refitted(EquationForms equation) const {
  constexpr int kRounds = 3, kExact = 80;
  const bool alone = equation.forms.size() == 1;
  for (int round = 0; round < (alone ? 1 : kRounds); ++round)
    for (std::size_t place = 0; place < equation.forms.size(); ++place)
      problem_->polish(equation, place, kExact);
  return equation;
}

}  // namespace lacuna
