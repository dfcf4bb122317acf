// SPDX-License-Identifier: MIT
#include "candidate_screening.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "lacuna/linear/forward_order.hpp"
#include "lacuna/linear/row_fold.hpp"
#include "lacuna/selection/subset_problem.hpp"

namespace lacuna {
namespace {

/// Integrals over the window from its begin to each sample, by Simpson's rule.
/// @param theta L x nodes. @return L x samples.
Matrix running_integrals(const Matrix& theta, const PathRecord& record,
                         const SampleWindow& window) {
  const Index stride = record.stride(), begin = window.first * stride;
  Matrix integrals = Matrix::Zero(theta.rows(), window.samples);
  for (Index i = 0; i + 1 < window.samples; ++i) {
    auto next = integrals.col(i + 1);
    next = integrals.col(i);
    for (Index node = i * stride; node < (i + 1) * stride; node += 2) {
      const double h = record.time[begin + node + 2] - record.time[begin + node];
      next += h / 6.0 * (theta.col(node) + 4.0 * theta.col(node + 1) + theta.col(node + 2));
    }
  }
  return integrals;
}

/// The samples of a window, m x samples; those without weight are where the path is.
Matrix samples_of(const PathRecord& record, const SampleWindow& window) {
  Matrix samples(record.weights.cols(), window.samples);
  for (Index i = 0; i < window.samples; ++i)
    for (Index k = 0; k < samples.rows(); ++k) {
      const Index sample = window.first + i;
      samples(k, i) = record.weights(sample, k) > 0.0
                          ? record.samples.states(sample, k)
                          : record.slots(sample * record.stride(), k);
    }
  return samples;
}

/// Triangle of [integrals of Theta | samples] and the number of its rows.
struct IntegralRows {
  Matrix triangle;
  Index rows = 0;
};

IntegralRows fold_integrals(const SearchTask& task, WindowSearch& search,
                            const RunContext& context) {
  const Index terms = task.equations.library.size(), m = task.equations.dimension();
  std::vector<Index> all(static_cast<std::size_t>(terms));
  std::iota(all.begin(), all.end(), Index{0});
  search.rates.choose(all, Matrix::Zero(m, terms));
  RowFold fold(terms + m);
  IntegralRows result;
  for (const SampleWindow& window : search.path.windows) {
    context.check_stop();
    const PathRecord& record = search.path.records[window.record];
    search.rates.evaluate(record, window);
    Matrix rows(terms + m, window.samples);
    rows << running_integrals(search.rates.theta(), record, window), samples_of(record, window);
    rows.colwise() -= rows.rowwise().mean().eval();
    if (!rows.allFinite()) continue;
    fold.add(rows);
    result.rows += window.samples - 1;
  }
  result.triangle = *fold.finish();
  return result;
}

/// The triangle of some columns and a target.
SubsetProblem problem_in(const Matrix& columns, const std::vector<Index>& chosen,
                         const Vector& target) {
  const auto count = static_cast<Index>(chosen.size());
  Matrix part(columns.rows(), count + 1);
  part << columns(Eigen::all, chosen), target;
  const Matrix folded = Eigen::HouseholderQR<Matrix>(part).matrixQR();
  const Index height = std::min(folded.rows(), count + 1);
  return subset_problem(folded.topRows(height).triangularView<Eigen::Upper>());
}

/// Members of a problem in the order in which they leave, and from where on they are worth it.
struct Elimination {
  std::vector<Index> order;
  std::size_t worth = 0;  ///< the first that is worth the price
};

Elimination eliminated(const SubsetProblem& problem, double price, const RunContext& context) {
  std::vector<Index> left(static_cast<std::size_t>(problem.columns()));
  std::iota(left.begin(), left.end(), Index{0});
  Elimination result;
  for (bool cheap = true; !left.empty();) {
    context.check_stop();
    Index worst = 0;
    cheap = losses_of(fit_subset(problem, left)).minCoeff(&worst) < price && cheap;
    if (cheap) result.worth = result.order.size() + 1;
    result.order.push_back(left[static_cast<std::size_t>(worst)]);
    left.erase(left.begin() + worst);
  }
  return result;
}

/// The columns that the model has in an equation.
std::vector<Index> members_of(const WindowSearch& search, Index equation) {
  std::vector<Index> members;
  for (Index l = 0; l < search.fit.coefficients.cols(); ++l)
    if (search.fit.coefficients(equation, l) != 0.0) members.push_back(l);
  return members;
}

/// Screens one equation.
/// @param rows white, of unit variance where the noise is known and the path right.
void screen_equation(const SearchTask& task, const WindowSearch& search, Index equation,
                     const IntegralRows& rows, Screening& result, const RunContext& context) {
  constexpr Index kTaken = 40;
  constexpr std::size_t kTimes = 2, kMore = 4;
  const Index terms = task.equations.library.size();
  const auto columns = rows.triangle.leftCols(terms);
  const Vector target = rows.triangle.col(terms + equation).topRows(rows.triangle.rows()) /
                        search.sigma[equation];
  std::vector<Index> members = members_of(search, equation);
  // A model with so many terms says nothing of what is needed.
  if (static_cast<Index>(members.size()) > kTaken / 2) members.clear();
  const double all = std::numeric_limits<double>::infinity();
  const ForwardOrder order = forward_order(columns, target, {members, kTaken, all}, context);
  const SubsetProblem problem = problem_in(columns, order.columns, target);
  const auto n = static_cast<double>(rows.rows);
  const double scale =
      std::max(1.0, order.left / std::max(1.0, n - static_cast<double>(problem.columns())));
  const double price =
      task.price.value_or(std::log(n) + std::log(static_cast<double>(task.candidates.size())));
  const Elimination left = eliminated(problem, scale * price, context);
  const std::size_t size = left.order.size(), worth = size - left.worth;
  const std::size_t plausible = std::min(size, kTimes * worth + kMore);
  for (std::size_t i = 0; i < size; ++i) {
    const auto place = static_cast<std::size_t>(left.order[i]);
    const Coefficient column{equation, order.columns[place]};
    if (i >= left.worth) result.worth.push_back(column);
    if (i + plausible >= size || place < members.size()) result.plausible.push_back(column);
  }
}

}  // namespace

bool is_wide(const SearchTask& task) {
  constexpr std::size_t kMost = 250;
  return task.candidates.size() > kMost;
}

Screening screen_candidates(const SearchTask& task, WindowSearch& search,
                            const RunContext& context) {
  const IntegralRows rows = fold_integrals(task, search, context);
  Screening result;
  for (Index k = 0; k < task.equations.dimension(); ++k)
    if (!task.equations.exact[static_cast<std::size_t>(k)])
      screen_equation(task, search, k, rows, result, context);
  std::sort(result.worth.begin(), result.worth.end());
  std::sort(result.plausible.begin(), result.plausible.end());
  return result;
}

}  // namespace lacuna
