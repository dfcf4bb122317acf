// SPDX-License-Identifier: MIT
#include "solvers/entropic.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <vector>

#include "core/base/random.hpp"
#include "core/numerics/least_squares.hpp"
#include "core/statistics/gaussian_information.hpp"
#include "core/statistics/robust_statistics.hpp"
#include "core/statistics/significance.hpp"
#include "regression/linear/gathered_rows.hpp"
#include "reweighting.hpp"
#include "subset_fit.hpp"

namespace lacuna {
namespace {

/// Facts of rounding: residuals and columns that are smaller, as fractions, are none.
constexpr double kNoResidual = 1e-12, kDependent = 1e-10;

/// Fits end where residuals, as they are weighted, change by less than this fraction.
constexpr double kSettled = 1e-4;

/// One row of each of `count` equal parts, drawn at random; all where there are no more.
Matrix drawn_rows(Matrix rows, Index count, Random& random) {
  if (rows.rows() <= count) return rows;
  Matrix drawn(count, rows.cols());
  for (Index i = 0; i < count; ++i) {
    const Index begin = i * rows.rows() / count, end = (i + 1) * rows.rows() / count;
    drawn.row(i) = rows.row(
        begin + static_cast<Index>(random.below(static_cast<std::uint64_t>(end - begin))));
  }
  return drawn;
}

/// Terms S with their fit.
struct Fit {
  TermSet terms;
  Vector fitted, residual, weights;

  bool has(Index term) const { return std::binary_search(terms.begin(), terms.end(), term); }
};

/// I(residual; part | fitted).
struct Information {
  double value = 0.0;
  double by_chance = 0.0;  ///< mean of what shuffled rows have
};

/// Rows in an order, in equal parts.
struct Blocks {
  std::vector<Index> order;
  Index count = 1;

  std::vector<Index> rows(Index block) const {
    const auto n = static_cast<Index>(order.size());
    return {order.begin() + block * n / count, order.begin() + (block + 1) * n / count};
  }
};

/// Rows of a problem, and what is asked of them.
class Rows {
 public:
  /// @param error root mean square systematic error of the target.
  Rows(const Matrix& rows, double error, const EntropicOptions& options, Random& random)
      : columns_(rows.leftCols(rows.cols() - 1)),
        target_(rows.rightCols(1)),
        quantiles_(normal_quantiles(rows.rows())),
        no_residual_(std::max(error, kNoResidual * root_mean_square(target_))),
        options_(options),
        random_(random) {
    for (auto column : columns_.colwise())
      if (const double norm = column.norm(); norm > 0.0) column /= norm;
  }

  Index terms() const { return columns_.cols(); }

  /// The fit that minimises the Huber function with the median of residuals as its corner.
  /// @param weights to begin with.
  Fit fit(TermSet terms, Vector weights) const {
    constexpr int kRounds = 50;
    const Matrix theta = columns_(Eigen::all, terms);
    Fit fit{std::move(terms), Vector::Zero(target_.size()), target_, std::move(weights)};
    for (int round = 0; round < kRounds && !fit.terms.empty(); ++round) {
      const Vector roots = fit.weights.cwiseSqrt(), before = fit.residual;
      fit.fitted =
          theta * least_squares(roots.asDiagonal() * theta, roots.cwiseProduct(target_));
      fit.residual = target_ - fit.fitted;
      if (is_exact(fit)) break;
      fit.weights = weights_of(fit.residual);
      if (round > 0 && roots.cwiseProduct(fit.residual - before).norm() <=
                           kSettled * roots.cwiseProduct(before).norm())
        break;
    }
    return fit;
  }

  /// The fit of no terms.
  Fit nothing() const { return fit({}, Vector::Ones(target_.size())); }

  /// Whether three of four rows leave no residual.
  bool is_exact(const Fit& fit) const {
    std::vector<double> sizes = magnitudes(fit.residual);
    return quantile(sizes, 0.75) <= no_residual_;
  }

  /// The parts of columns that a fit's terms leave, with its weights; zeros for none.
  Matrix parts_beyond(const Fit& fit, const std::vector<Index>& columns) const {
    Matrix parts = columns_(Eigen::all, columns);
    if (fit.terms.empty()) return parts;
    const Matrix theta = columns_(Eigen::all, fit.terms);
    const Vector roots = fit.weights.cwiseSqrt();
    parts -=
        theta * least_squares(roots.asDiagonal() * theta, Matrix(roots.asDiagonal() * parts));
    for (auto part : parts.colwise())
      if (part.norm() <= kDependent) part.setZero();
    return parts;
  }

  /// I(y; z_{S+j} | z_S) of each term j beside those of a fit; 0 for those.
  Vector information(const Fit& fit) const {
    std::vector<Index> others;
    for (Index term = 0; term < terms(); ++term)
      if (!fit.has(term)) others.push_back(term);
    const Matrix parts = parts_beyond(fit, others);
    const Blocks blocks = blocks_of(fit);
    const Vector y = centred(scores(fit.residual), blocks);
    Vector found = Vector::Zero(terms());
    for (std::size_t i = 0; i < others.size(); ++i) {
      const Vector part = parts.col(static_cast<Index>(i));
      found[others[i]] = is_constant(columns_.col(others[i]))
                             ? signed_information(fit.residual, part)
                             : gaussian_information(y, centred(scores(part), blocks));
    }
    return found;
  }

  /// The same of one term, and what it is by chance.
  Information tested(const Fit& fit, Index term) const {
    const Vector part = parts_beyond(fit, {term});
    if (is_constant(columns_.col(term)))
      return {signed_information(fit.residual, part), 0.5 / static_cast<double>(part.size())};
    const Blocks blocks = blocks_of(fit);
    const Vector y = centred(scores(fit.residual), blocks);
    const Vector x = centred(scores(part), blocks);
    Information found{gaussian_information(y, x)};
    for (int shuffle = 0; shuffle < options_.shuffles; ++shuffle)
      found.by_chance += gaussian_information(y, shuffled(x, blocks)) / options_.shuffles;
    return found;
  }

 private:
  static bool is_constant(const Vector& column) {
    return column.maxCoeff() - column.minCoeff() <= kDependent * column.cwiseAbs().maxCoeff();
  }

  static double root_mean_square(const Vector& values) {
    return values.norm() / std::sqrt(static_cast<double>(std::max<Index>(values.size(), 1)));
  }

  static Vector weights_of(const Vector& residual) {
    const double corner = median(magnitudes(residual));
    return (residual.array().abs() > corner).select(corner / residual.array().abs(), 1.0);
  }

  Vector scores(const Vector& values) const { return normal_scores(values, quantiles_); }

  /// Rows in the order of the fit, in blocks of about ten: within one it is the same.
  Blocks blocks_of(const Fit& fit) const {
    constexpr Index kRows = 10;
    const Index n = target_.size();
    Blocks blocks{std::vector<Index>(static_cast<std::size_t>(n)), 1};
    std::iota(blocks.order.begin(), blocks.order.end(), Index{0});
    if (fit.terms.empty()) return blocks;
    blocks.count = std::max<Index>(n / kRows, 1);
    std::stable_sort(blocks.order.begin(), blocks.order.end(),
                     [&](Index a, Index b) { return fit.fitted[a] < fit.fitted[b]; });
    return blocks;
  }

  /// Without the mean of each block.
  static Vector centred(Vector values, const Blocks& blocks) {
    for (Index block = 0; block < blocks.count; ++block) {
      const std::vector<Index> rows = blocks.rows(block);
      values(rows).array() -= values(rows).mean();
    }
    return values;
  }

  /// Values exchanged within each block.
  Vector shuffled(Vector values, const Blocks& blocks) const {
    for (Index block = 0; block < blocks.count; ++block) {
      const std::vector<Index> rows = blocks.rows(block);
      for (std::size_t i = rows.size(); i-- > 1;)
        std::swap(values[rows[i]], values[rows[random_.below(i + 1)]]);
    }
    return values;
  }

  Matrix columns_;
  Vector target_, quantiles_;
  double no_residual_;
  const EntropicOptions& options_;
  Random& random_;
};

/// The value that chi-squared with one degree of freedom exceeds with a probability.
double chi_squared_above(double probability) {
  double low = 0.0, high = 2000.0;
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (low + high);
    (log_chi_squared_tail(middle, 1.0) > std::log(probability) ? low : high) = middle;
  }
  return high;
}

/// Terms, what each has of information beside the fit of the others, and what chance allows.
struct Selection {
  Fit fit;
  Vector information;  ///< of all terms; 0 for members
  double threshold = 0.0;
  int steps = 0;
};

/// Takes one term after another.
Selection forward(const Rows& rows, const EntropicOptions& options, const RunContext& context) {
  Selection chosen{rows.nothing(), Vector::Zero(rows.terms())};
  while (static_cast<int>(chosen.fit.terms.size()) < options.max_terms) {
    context.check_stop();
    chosen.information.setZero();
    if (rows.is_exact(chosen.fit)) break;
    chosen.information = rows.information(chosen.fit);
    Index best = 0;
    if (!(chosen.information.maxCoeff(&best) > 0.0)) break;
    const auto left = rows.terms() - static_cast<Index>(chosen.fit.terms.size());
    const Information found = rows.tested(chosen.fit, best);
    chosen.threshold =
        found.by_chance * chi_squared_above(options.significance / static_cast<double>(left));
    if (!(found.value > chosen.threshold)) break;
    TermSet terms = chosen.fit.terms;
    terms.insert(std::upper_bound(terms.begin(), terms.end(), best), best);
    chosen.fit = rows.fit(std::move(terms), chosen.fit.weights);
    ++chosen.steps;
  }
  return chosen;
}

/// Lets terms go that the others make superfluous.
Selection backward(const Rows& rows, Selection chosen, const EntropicOptions& options,
                   const RunContext& context) {
  while (!chosen.fit.terms.empty()) {
    const double most = chi_squared_above(options.significance /
                                          static_cast<double>(chosen.fit.terms.size()));
    std::optional<std::size_t> least;
    Information of_least;
    Fit without;
    for (std::size_t i = 0; i < chosen.fit.terms.size(); ++i) {
      context.check_stop();
      TermSet others = chosen.fit.terms;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
      Fit fit = rows.fit(std::move(others), chosen.fit.weights);
      Information found;
      if (!rows.is_exact(fit))
        found = rows.tested(fit, chosen.fit.terms[i]);
      if (found.value > most * found.by_chance || (least && found.value >= of_least.value))
        continue;
      least = i;
      of_least = found;
      without = std::move(fit);
    }
    if (!least) break;
    chosen.information[chosen.fit.terms[*least]] = of_least.value;
    chosen.threshold = std::max(chosen.threshold, most * of_least.by_chance);
    chosen.fit = std::move(without);
  }
  return chosen;
}

}  // namespace

Regression Entropic::do_fit(const LeastSquaresSystem& system, const Subproblem& problem,
                            Effort effort, const RunContext& context) const {
  Random random(context.seed);
  const auto& error = system.target_error();
  const Rows rows(
      drawn_rows(gathered_rows(system, problem.target(), problem.active(), context),
                 options().samples, random),
      error ? (*error)[problem.target()] : 0.0, options(), random);
  const Selection chosen =
      backward(rows, forward(rows, options(), context), options(), context);
  const SubsetChoice choice{.positions = chosen.fit.terms,
                            .quantity = "conditional mutual information of the term",
                            .values = chosen.information,
                            .threshold = chosen.threshold,
                            .iterations = chosen.steps};
  Regression result = regression_on(system, problem, choice, Effort::Selection, context);
  if (result.active.empty()) return result;
  const Subproblem kept = system.subproblem(problem.target(), result.active);
  ReweightingRule rule;  // that of irls
  if (effort == Effort::Selection) rule.tolerance = 1e-5;
  const auto solve = [](const Subproblem& weighted, const Vector&, const WeightFunction&) {
    return weighted.solve();
  };
  const ReweightingOutcome settled = reweight(system, kept, rule, solve, context);
  result.coefficients = settled.coefficients;
  result.residual_norm = kept.residual_norm(settled.coefficients);
  result.converged = settled.converged;
  return result;
}

Stage<Regressor> entropic(const EntropicOptions& options) { return Entropic(options); }

}  // namespace lacuna
