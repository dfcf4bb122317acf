// SPDX-License-Identifier: MIT
#include "rational_forms.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/parallel.hpp"
#include "core/numerics/least_squares.hpp"
#include "core/numerics/qr.hpp"
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
constexpr const char* kNames[] = {"a", "b"};

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

/// The denominators of one equation.
class Denominators {
 public:
  Denominators(const Scope& scope, const FormRows& rows, Index equation,
               const std::vector<Term>& library, const RunContext& context)
      : scope_(scope), rows_(rows), context_(context), target_(rows.target(equation)) {
    for (const Term& term : library) library_.push_back(term.expression());
    numerators_ = rows.values(library_);
    rate_ = rows.rate(equation);
    projected_ = rows.projected(numerators_);
    const double least = 1e-16 * target_.squaredNorm();
    unit_ = std::sqrt(std::max(squares_left(projected_, target_), least) /
                      static_cast<double>(target_.size()));
    add_monomials();
  }

  /// The best, each with its numbers.
  std::vector<Denominator> best(std::size_t count) const {
    std::vector<Denominator> all = pairs();
    parallel_for(all.size(), context_.threads, [&](std::size_t i) {
      context_.check_stop();
      all[i].numbers = implicit(all[i]);
      all[i].score = score(all[i]);
    });
    std::stable_sort(all.begin(), all.end(), [](const Denominator& a, const Denominator& b) {
      return a.score < b.score;
    });
    if (all.size() > count) all.resize(count);
    return all;
  }

  /// Largest value of a monomial in the records.
  double size_of(const Expression& monomial) const {
    return std::max(rows_.values({monomial}).maxCoeff(), 1e-300);
  }

 private:
  void add_monomials() {
    constexpr std::size_t kFewVariables = 3;  // of more: the variables themselves
    const int degree = scope_.variables.size() <= kFewVariables ? 2 : 1;
    for (const Expression& monomial : monomials_of(scope_, degree)) {
      if (monomial.variables().empty()) continue;
      const Matrix values = rows_.values({monomial});
      if (values.minCoeff() >= -0.05 * values.maxCoeff()) monomials_.push_back(monomial);
    }
  }

  std::vector<Denominator> pairs() const {
    const Expression one = Expression::number(1.0);
    std::vector<Denominator> all;
    for (std::size_t i = 0; i < monomials_.size(); ++i) {
      if (!is_power(monomials_[i])) all.push_back({{one, monomials_[i]}, {}, 0.0});
      for (std::size_t j = 0; j < i; ++j) {
        all.push_back({{one, monomials_[j], monomials_[i]}, {}, 0.0});
        all.push_back({{monomials_[j], monomials_[i]}, {}, 0.0});
      }
    }
    return all;
  }

  /// q of the implicit form; what is not positive begins at a tenth of what is large.
  Vector implicit(const Denominator& denominator) const {
    Matrix monomials = rows_.values(denominator.monomials);
    monomials.array().colwise() *= rate_.array();
    const Matrix products = rows_.projected(monomials);
    const Index count = products.cols() - 1;
    Matrix columns(projected_.rows(), projected_.cols() + count);
    columns << products.rightCols(count), projected_;
    const Vector norms = columns.colwise().norm().cwiseMax(1e-300);
    columns.array().rowwise() /= norms.transpose().array();
    const Vector left = is_one(denominator.monomials[0]) ? target_ : Vector(products.col(0));
    const Vector solution = least_squares(columns, left);
    Vector numbers = -(solution.head(count).array() / norms.head(count).array());
    const double size = size_of(denominator.monomials[0]);
    for (Index j = 0; j < count; ++j) {
      const double unit =
          size / size_of(denominator.monomials[static_cast<std::size_t>(j + 1)]);
      if (!(numbers[j] > 0.01 * unit)) numbers[j] = 0.1 * unit;
      numbers[j] = std::min(numbers[j], 50.0 * unit);
    }
    return numbers;
  }

  static bool is_one(const Expression& monomial) { return monomial.variables().empty(); }

  /// |y - sum theta_i p_i / Q|^2 over what all of them leave, with a price for each term.
  double score(const Denominator& denominator) const {
    const Vector divisor =
        rows_.values({formula_of(denominator, numbers_of(denominator.numbers))}).col(0);
    const Matrix samples = numerators_.array().colwise() / divisor.array();
    if (!samples.allFinite()) return std::numeric_limits<double>::infinity();
    Matrix system(target_.size(), samples.cols() + 1);
    system << rows_.projected(samples), target_;
    const auto rows = static_cast<double>(target_.size());
    return best_subset(subset_problem(Qr(system).triangle() / unit_), std::log(rows), {},
                       Exchange::Single, context_)
        .score;
  }

  const Scope& scope_;
  const FormRows& rows_;
  const RunContext& context_;
  Vector target_, rate_;
  std::vector<Expression> library_, monomials_;
  Matrix numerators_, projected_;
  double unit_ = 1.0;  ///< rms of what the library leaves beside a constant denominator
};

/// Whether a variable is a factor of the numerator and of all of the denominator.
bool is_reducible(const Expression& numerator, const Denominator& denominator) {
  for (const std::string& name : numerator.variables())
    if (std::all_of(denominator.monomials.begin(), denominator.monomials.end(),
                    [&](const Expression& each) { return each.variables().contains(name); }))
      return true;
  return false;
}

Candidate fraction(const Scope& scope, const Denominators& all, const Denominator& denominator,
                   const Expression& numerator) {
  std::vector<Expression> names;
  Candidate candidate;
  const double size = all.size_of(denominator.monomials[0]);
  for (Index j = 0; j < denominator.numbers.size(); ++j) {
    const auto place = static_cast<std::size_t>(j);
    const std::string name = scope.free_name(kNames[place]);
    const double unit = size / all.size_of(denominator.monomials[place + 1]);
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
  const Denominators all(scope, rows, equation.equation, equation.terms, context);
  for (const Denominator& denominator : all.best(denominators))
    for (const Expression& numerator : monomials_of(scope, 2)) {
      if (is_reducible(numerator, denominator)) continue;
      result.push_back(fraction(scope, all, denominator, numerator));
      result.back().equation = equation.equation;
    }
  return result;
}

}  // namespace lacuna
