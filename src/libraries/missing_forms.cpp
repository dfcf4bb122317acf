// SPDX-License-Identifier: MIT
#include "lacuna/libraries/missing_forms.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "candidates/nelder_mead.hpp"
#include "lacuna/core/error.hpp"
#include "lacuna/formulations/weak_form.hpp"
#include "lacuna/linear/least_squares_system.hpp"
#include "lacuna/linear/subproblem.hpp"

namespace lacuna {
namespace {

/// Sums of squares that differ by less are equal: residuals are known to a tenth.
constexpr double kSame = 1.21;

/// A value of shape parameters on the unit cube and back.
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

/// Test functions as wide as the noise asks for, but not so wide that few rows are left: where
/// there is no noise a few samples will do.
WeakForm narrow_form(const Dataset& data) {
  constexpr double kRows = 400.0, kSamplesOfARow = 4.0;
  const TestFunction wide = choose_test_function(data);
  const Trajectory& record = longest_record(data);
  const double duration = record.time[record.samples() - 1] - record.time[0];
  const double wanted = std::min(kRows, static_cast<double>(record.samples()) / kSamplesOfARow);
  const double narrow = duration / wanted * std::sqrt(static_cast<double>(wide.order));
  return WeakForm{{.radius = std::min(wide.radius, narrow), .order = wide.order}};
}

/// The rows of one equation beside a library.
class Residuals {
 public:
  Residuals(const Dataset& data, std::vector<Term> base, Index equation)
      : data_(data), base_(std::move(base)), equation_(equation), form_(narrow_form(data)) {
    for (const Quantity& state : data.states) variables_.states.push_back(state.name);
    for (const Quantity& input : data.inputs) variables_.inputs.push_back(input.name);
  }

  /// The library with more terms; those that it has already are not there twice.
  LeastSquaresSystem system(const std::vector<Expression>& forms,
                            const RunContext& context) const {
    TermLibrary library{variables_, base_};
    for (const Expression& form : forms) library.terms.emplace_back(form, variables_);
    return form_.assemble(data_, library, context);
  }

  Index base_size() const { return static_cast<Index>(base_.size()); }
  Index equation() const { return equation_; }

  /// |residual|^2 beside the library and all of these forms; infinite where a form has no
  /// value.
  double left(const std::vector<Expression>& forms, const RunContext& context) const {
    try {
      const LeastSquaresSystem rows = system(forms, context);
      return std::pow(rows.subproblem(equation_, rows.all_terms()).residual_norm(), 2);
    } catch (const DataError&) {
      return std::numeric_limits<double>::infinity();
    }
  }

 private:
  const Dataset& data_;
  std::vector<Term> base_;
  Variables variables_;
  Index equation_;
  WeakForm form_;
};

std::vector<Expression> expressions_of(const std::vector<MissingForm>& forms) {
  std::vector<Expression> expressions;
  for (const MissingForm& form : forms) expressions.push_back(form.expression());
  return expressions;
}

/// Fits the shapes of forms[place], the others being as they are. @return |residual|^2.
double polish(const Residuals& rows, std::vector<MissingForm>& forms, std::size_t place,
              const RunContext& context) {
  MissingForm& form = forms[place];
  if (form.shapes.size() == 0) return rows.left(expressions_of(forms), context);
  const Candidate& candidate = form.candidate;
  const auto left = [&](const Vector& at) {
    context.check_stop();
    form.shapes = each_shape(candidate, at, from_unit);
    return std::log(std::max(rows.left(expressions_of(forms), context), 1e-300));
  };
  const Vector start = each_shape(candidate, form.shapes, to_unit);
  const Vector best = nelder_mead(left, start, {0.05, 1e-7, 80});
  return std::exp(left(best));
}

/// A candidate at one of its starting points beside what is there, by the columns of one
/// system.
struct Start {
  std::size_t candidate = 0;
  Vector shapes;
  double left = 0.0;
};

/// All candidates at all starting points, the best first, each candidate at its best one.
std::vector<Start> ranked_starts(const Residuals& rows, const std::vector<MissingForm>& chosen,
                                 const std::vector<Candidate>& candidates,
                                 const RunContext& context) {
  std::vector<Start> starts;
  std::vector<Expression> forms;
  constexpr std::size_t kTogether = 24;
  for (std::size_t c = 0; c < candidates.size(); ++c)
    for (const Vector& shapes : candidates[c].starts) {
      starts.push_back({c, shapes, 0.0});
      forms.push_back(
          bind_form(candidates[c], {shapes.data(), static_cast<std::size_t>(shapes.size())}));
    }
  const std::size_t fixed = chosen.size() + static_cast<std::size_t>(rows.base_size());
  for (std::size_t first = 0; first < starts.size(); first += kTogether) {
    const std::size_t last = std::min(first + kTogether, starts.size());
    std::vector<Expression> some = expressions_of(chosen);
    some.insert(some.end(), forms.begin() + static_cast<std::ptrdiff_t>(first),
                forms.begin() + static_cast<std::ptrdiff_t>(last));
    const LeastSquaresSystem system = rows.system(some, context);
    for (std::size_t i = first; i < last; ++i) {
      TermSet active(fixed);
      std::iota(active.begin(), active.end(), Index{0});
      active.push_back(static_cast<Index>(fixed + i - first));
      starts[i].left =
          std::pow(system.subproblem(rows.equation(), std::move(active)).residual_norm(), 2);
    }
  }
  std::stable_sort(starts.begin(), starts.end(),
                   [](const Start& a, const Start& b) { return a.left < b.left; });
  std::vector<Start> best;
  for (Start& start : starts)
    if (std::none_of(best.begin(), best.end(),
                     [&](const Start& other) { return other.candidate == start.candidate; }))
      best.push_back(std::move(start));
  return best;
}

/// The forms that leave least with one more, and what they leave: of those that leave the same
/// to a tenth the plainest.
std::pair<std::vector<MissingForm>, double> with_best_form(
    const Residuals& rows, const std::vector<MissingForm>& chosen,
    const std::vector<Candidate>& candidates, const RunContext& context) {
  constexpr std::size_t kPolished = 8;
  std::vector<std::pair<std::vector<MissingForm>, double>> all;
  for (const Start& start : ranked_starts(rows, chosen, candidates, context)) {
    if (all.size() == kPolished) break;
    std::vector<MissingForm> forms = chosen;
    forms.push_back({candidates[start.candidate], start.shapes});
    const double left = polish(rows, forms, forms.size() - 1, context);
    all.emplace_back(std::move(forms), left);
  }
  const auto leaves_less = [](const auto& a, const auto& b) { return a.second < b.second; };
  const double least = std::min_element(all.begin(), all.end(), leaves_less)->second;
  const auto plainer = [&](const auto& a, const auto& b) {
    const bool good = a.second <= kSame * least, other = b.second <= kSame * least;
    if (good != other) return good;
    const Index intricacy = a.first.back().candidate.intricacy();
    if (good && intricacy != b.first.back().candidate.intricacy())
      return intricacy < b.first.back().candidate.intricacy();
    return a.second < b.second;
  };
  return *std::min_element(all.begin(), all.end(), plainer);
}

}  // namespace

Expression MissingForm::expression() const {
  return bind_form(candidate, {shapes.data(), static_cast<std::size_t>(shapes.size())});
}

std::vector<MissingForm> missing_forms(const FormSearch& search,
                                       const std::vector<Candidate>& candidates,
                                       const RunContext& context) {
  constexpr double kNoise = 1.2;
  if (candidates.empty()) return {};
  const Index k = candidates.front().equation;
  const Residuals rows(search.data, search.library.terms, k);
  const auto samples = static_cast<double>(rows.system({}, context).rows());
  const double noise = kNoise * samples * search.noise[k] * search.noise[k];
  std::vector<MissingForm> chosen;
  double left = rows.left({}, context);
  for (int i = 0; i < search.most_forms && left > noise; ++i) {
    auto [forms, now] = with_best_form(rows, chosen, candidates, context);
    for (std::size_t place = 0; place + 1 < forms.size(); ++place)
      now = polish(rows, forms, place, context);
    if (!(left > kSame * now)) break;
    chosen = std::move(forms);
    left = now;
  }
  return chosen;
}

namespace {

/// What is left of the terms of an equation beside a form: the least valuable ones leave while
/// the rest does the same.
struct Replacement {
  std::vector<MissingForm> forms;  ///< with the new one at the end
  std::vector<Term> terms;
  double cost = 0.0, left = 0.0;
};

double cost_of(const std::vector<Term>& terms, const std::vector<MissingForm>& forms) {
  double cost = static_cast<double>(terms.size() + forms.size());
  for (const MissingForm& form : forms) cost += static_cast<double>(form.shapes.size());
  return cost;
}

/// Takes terms out beside the form at the end of the list. @param limit of the residual.
Replacement thinned(const Dataset& data, std::vector<Term> terms,
                    std::vector<MissingForm> forms, double limit, const RunContext& context) {
  const Index equation = forms.front().candidate.equation;
  double left = Residuals(data, terms, equation).left(expressions_of(forms), context);
  for (;;) {
    std::optional<std::size_t> out;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < terms.size(); ++i) {
      std::vector<Term> fewer = terms;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
      const double now = Residuals(data, fewer, equation).left(expressions_of(forms), context);
      if (now < least) {
        least = now;
        out = i;
      }
    }
    if (!out) break;
    std::vector<Term> fewer = terms;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(*out));
    if (least > limit) {
      least = polish(Residuals(data, fewer, equation), forms, forms.size() - 1, context);
      if (least > limit) break;
    }
    terms = std::move(fewer);
    left = least;
  }
  const double cost = cost_of(terms, forms);
  return {std::move(forms), std::move(terms), cost, left};
}

}  // namespace

bool replace_terms(const Dataset& data, const std::vector<Term>& terms,
                   const std::vector<Candidate>& candidates, std::vector<MissingForm>& forms,
                   const RunContext& context) {
  constexpr std::size_t kTried = 12;
  if (terms.size() < 2 || candidates.empty()) return false;
  const Residuals rows(data, terms, candidates.front().equation);
  const double before = rows.left(expressions_of(forms), context);
  double least = cost_of(terms, forms);
  std::optional<Replacement> best;
  std::size_t tried = 0;
  for (const Start& start : ranked_starts(rows, forms, candidates, context)) {
    if (tried++ == kTried) break;
    std::vector<MissingForm> more = forms;
    more.push_back({candidates[start.candidate], start.shapes});
    Replacement now = thinned(data, terms, std::move(more), kSame * before, context);
    if (now.cost > least || (now.cost == least && (!best || now.left >= best->left))) continue;
    least = now.cost;
    best = std::move(now);
  }
  if (!best) return false;
  forms = std::move(best->forms);
  return true;
}

void refit_shapes(const Dataset& data, const std::vector<Term>& terms,
                  std::vector<MissingForm>& forms, const RunContext& context) {
  if (forms.empty()) return;
  constexpr int kRounds = 3;
  const Residuals rows(data, terms, forms.front().candidate.equation);
  for (int round = 0; round < kRounds; ++round)
    for (std::size_t place = 0; place < forms.size(); ++place)
      polish(rows, forms, place, context);
}

}  // namespace lacuna
