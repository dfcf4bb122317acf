// SPDX-License-Identifier: MIT
#include "rational_forms.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/parallel.hpp"
#include "core/numerics/least_squares.hpp"
#include "core/numerics/qr.hpp"
#include "core/statistics/information.hpp"
#include "product_forms.hpp"
#include "trajectories/subset_selection/subset_search.hpp"

namespace lacuna {
namespace {

/// Q = u_0 + sum_j q_j u_j.
struct Denominator {
  std::vector<Expression> monomials;  ///< u_0, u_1, ...
  Vector numbers;                     ///< q
  double score = 0.0;
};

/// Shapes by which numbers are named in a form.
constexpr const char* kNames[] = {"a", "b", "c"};

/// The formula with names or numbers for q.
Expression formula_of(const Denominator& denominator, const std::vector<Expression>& numbers) {
  Expression sum = denominator.monomials[0];
  for (std::size_t j = 0; j < numbers.size(); ++j)
    sum = sum + numbers[j] * denominator.monomials[j + 1];
  return sum;
}

std::vector<Expression> numbers_of(const Vector& values) {
  std::vector<Expression> numbers;
  for (const double value : values) numbers.push_back(Expression::number(value));
  return numbers;
}

/// Whether a monomial is a power of one variable: such denominators are shaped forms already.
bool is_power(const Expression& monomial) { return monomial.variables().size() < 2; }

bool is_one(const Expression& monomial) { return monomial.variables().empty(); }

/// Largest value of a monomial in the records.
double size_of(const Expression& monomial, const FormRows& rows) {
  return std::max(rows.values({monomial}).maxCoeff(), 1e-300);
}

/// One equation in rows, with the library as numerators.
struct Numerators {
  Vector target;      ///< K
  Vector rate;        ///< at the samples
  Matrix values;      ///< samples x terms
  Matrix projected;   ///< K x terms
  double unit = 1.0;  ///< rms of what they leave beside a constant denominator
};

Numerators numerators_of(const EquationForms& equation, const FormRows& rows) {
  std::vector<Expression> library;
  for (const Term& term : equation.terms) library.push_back(term.expression());
  Numerators all{
      rows.target(equation.equation), rows.rate(equation.equation), rows.values(library), {}};
  all.projected = rows.projected(all.values);
  const double least = 1e-16 * all.target.squaredNorm();
  all.unit = std::sqrt(std::max(residual_squares(all.projected, all.target), least) /
                       static_cast<double>(all.target.size()));
  return all;
}

/// A fact of amounts: beside their largest value this is 0 with noise, on either side of it.
constexpr double kNearZero = 0.05;

/// Monomials that are amounts in the records: sums of them have a zero only where all are 0.
std::vector<Expression> amounts(const Scope& scope, const FormRows& rows) {
  constexpr std::size_t kFewVariables = 3;  // of more: the variables themselves
  const int degree = scope.variables.size() <= kFewVariables ? 2 : 1;
  std::vector<Expression> result;
  for (const Expression& monomial : monomials_of(scope, degree)) {
    if (is_one(monomial)) continue;
    const Matrix values = rows.values({monomial});
    if (values.minCoeff() >= -kNearZero * values.maxCoeff()) result.push_back(monomial);
  }
  return result;
}

/// Whether u + q v has a zero in the records: that of a variable which is a factor of both.
bool vanish_together(const Expression& u, const Expression& v, const FormRows& rows) {
  for (const std::string& name : u.variables()) {
    if (!v.variables().contains(name)) continue;
    const Matrix values = rows.values({Expression::variable(name)}).cwiseAbs();
    if (values.minCoeff() < kNearZero * values.maxCoeff()) return true;
  }
  return false;
}

/// 1 + q u, 1 + q u + r v and u + q v of all monomials u and v.
std::vector<Denominator> denominators_of(const std::vector<Expression>& monomials,
                                         const FormRows& rows) {
  const Expression one = Expression::number(1.0);
  std::vector<Denominator> all;
  for (std::size_t i = 0; i < monomials.size(); ++i) {
    if (!is_power(monomials[i])) all.push_back({{one, monomials[i]}, {}, 0.0});
    for (std::size_t j = 0; j < i; ++j) {
      all.push_back({{one, monomials[j], monomials[i]}, {}, 0.0});
      if (!vanish_together(monomials[j], monomials[i], rows))
        all.push_back({{monomials[j], monomials[i]}, {}, 0.0});
    }
  }
  return all;
}

/// q of the implicit form; what is not positive begins at a tenth of what is large.
Vector implicit_numbers(const Denominator& denominator, const Numerators& numerators,
                        const FormRows& rows) {
  Matrix monomials = rows.values(denominator.monomials);
  monomials.array().colwise() *= numerators.rate.array();
  const Matrix products = rows.projected(monomials);
  const Index count = products.cols() - 1;
  const Matrix& projected = numerators.projected;
  Matrix columns(projected.rows(), projected.cols() + count);
  columns << products.rightCols(count), projected;
  const Vector norms = columns.colwise().norm().cwiseMax(1e-300);
  columns.array().rowwise() /= norms.transpose().array();
  const Vector left =
      is_one(denominator.monomials[0]) ? numerators.target : Vector(products.col(0));
  const Vector solution = least_squares(columns, left);
  Vector numbers = -(solution.head(count).array() / norms.head(count).array());
  const double size = size_of(denominator.monomials[0], rows);
  for (Index j = 0; j < count; ++j) {
    const double unit =
        size / size_of(denominator.monomials[static_cast<std::size_t>(j + 1)], rows);
    if (!(numbers[j] > 0.01 * unit)) numbers[j] = 0.1 * unit;
    numbers[j] = std::min(numbers[j], 50.0 * unit);
  }
  return numbers;
}

/// |y - sum theta_i p_i / Q|^2 over what all of them leave, with a penalty for each term.
double score_of(const Denominator& denominator, const Numerators& numerators,
                const FormRows& rows, const RunContext& context) {
  const Vector divisor =
      rows.values({formula_of(denominator, numbers_of(denominator.numbers))}).col(0);
  const Matrix samples = numerators.values.array().colwise() / divisor.array();
  if (!samples.allFinite()) return std::numeric_limits<double>::infinity();
  Matrix system(numerators.target.size(), samples.cols() + 1);
  system << rows.projected(samples), numerators.target;
  return best_subset(subset_problem(Qr(system).triangle() / numerators.unit),
                     parameter_penalty(static_cast<double>(system.rows())), {},
                     Exchange::Single, context)
      .score;
}

/// Rates denominators, the best first.
void rate(std::vector<Denominator>& all, const Numerators& numerators, const FormRows& rows,
          const RunContext& context) {
  parallel_for(all.size(), context.threads, [&](std::size_t i) {
    context.check_stop();
    all[i].numbers = implicit_numbers(all[i], numerators, rows);
    all[i].score = score_of(all[i], numerators, rows, context);
  });
  std::stable_sort(all.begin(), all.end(), [](const Denominator& a, const Denominator& b) {
    return a.score < b.score;
  });
}

/// 1 + q u + r v + s w from the best of three monomials.
std::vector<Denominator> of_four_monomials(const std::vector<Denominator>& best,
                                           const std::vector<Expression>& monomials) {
  // A fact of the search: what is not among the first with three is not with four.
  constexpr std::size_t kGoOn = 3, kMonomials = 3;
  std::vector<Denominator> all;
  std::size_t gone_on = 0;
  for (const Denominator& denominator : best) {
    const auto& own = denominator.monomials;
    if (own.size() != kMonomials || !is_one(own[0]) || gone_on++ == kGoOn) continue;
    for (const Expression& monomial : monomials) {
      if (std::find(own.begin(), own.end(), monomial) != own.end()) continue;
      all.push_back({own, {}, 0.0});
      all.back().monomials.push_back(monomial);
    }
  }
  return all;
}

/// The best denominators of an equation, each with its numbers.
std::vector<Denominator> best_denominators(const Scope& scope, const FormRows& rows,
                                           const EquationForms& equation, std::size_t count,
                                           const RunContext& context) {
  const Numerators numerators = numerators_of(equation, rows);
  const std::vector<Expression> monomials = amounts(scope, rows);
  std::vector<Denominator> all = denominators_of(monomials, rows);
  rate(all, numerators, rows, context);
  std::vector<Denominator> longer = of_four_monomials(all, monomials);
  rate(longer, numerators, rows, context);
  // They stand beside the others: with a number more, of a denominator that needs none, they
  // would take the places of what is right.
  constexpr std::size_t kLonger = 2;
  if (longer.size() > kLonger) longer.resize(kLonger);
  if (all.size() > count) all.resize(count);
  const double penalty = parameter_penalty(static_cast<double>(rows.rows()));
  for (const Denominator& one : longer)
    if (!all.empty() && one.score + penalty < all.front().score) all.push_back(one);
  return all;
}

/// Whether a variable is a factor of the numerator and of all of the denominator.
bool is_reducible(const Expression& numerator, const Denominator& denominator) {
  for (const std::string& name : numerator.variables())
    if (std::all_of(denominator.monomials.begin(), denominator.monomials.end(),
                    [&](const Expression& each) { return each.variables().contains(name); }))
      return true;
  return false;
}

Candidate fraction(const Scope& scope, const FormRows& rows, const Denominator& denominator,
                   const Expression& numerator) {
  std::vector<Expression> names;
  Candidate candidate;
  const double size = size_of(denominator.monomials[0], rows);
  for (Index j = 0; j < denominator.numbers.size(); ++j) {
    const auto place = static_cast<std::size_t>(j);
    const std::string name = scope.free_name(kNames[place]);
    const double unit = size / size_of(denominator.monomials[place + 1], rows);
    names.push_back(Expression::variable(name));
    candidate.shapes.push_back({name, "", 0.005 * unit, 100.0 * unit, true});
  }
  candidate.form = numerator / formula_of(denominator, names);
  candidate.argument = formula_of(denominator, names);
  for (const double factor : {0.4, 1.0, 2.5})
    candidate.starts.push_back(factor * denominator.numbers);
  return candidate;
}

}  // namespace

std::vector<Candidate> rational_forms(const Scope& scope, const FormRows& rows,
                                      const EquationForms& equation, std::size_t denominators,
                                      const RunContext& context) {
  std::vector<Candidate> result;
  if (rows.rows() <= static_cast<Index>(equation.terms.size()) + 3) return result;
  for (const Denominator& denominator :
       best_denominators(scope, rows, equation, denominators, context))
    for (const Expression& numerator : monomials_of(scope, 2)) {
      if (is_reducible(numerator, denominator)) continue;
      result.push_back(fraction(scope, rows, denominator, numerator));
      result.back().equation = equation.equation;
    }
  return result;
}

}  // namespace lacuna
