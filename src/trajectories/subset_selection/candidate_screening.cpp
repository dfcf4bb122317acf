// SPDX-License-Identifier: MIT
#include "candidate_screening.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "core/base/parallel.hpp"
#include "core/statistics/information.hpp"
#include "regression/linear/forward_order.hpp"
#include "regression/linear/gram.hpp"
#include "regression/linear/row_fold.hpp"
#include "trajectories/subset_selection/subset_problem.hpp"

namespace lacuna {
namespace {

/// Columns of a problem of all equations that is solved at once. A decision of cost, which is
/// cubic in it, and no option: results are not to depend on the machine (docs/decisions.md).
constexpr Index kMostColumns = 250;

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

/// Gram matrix of [integrals of Theta | samples] and the number of its rows.
struct IntegralRows {
  Matrix gram;
  Index rows = 0;
};

/// A window in pieces of so many samples; a rest joins the last one.
std::vector<SampleWindow> pieces_of(const SampleWindow& window, Index samples) {
  const Index count = std::max<Index>(1, window.samples / samples);
  std::vector<SampleWindow> pieces;
  for (Index p = 0; p < count; ++p) {
    const Index first = p * window.samples / count, last = (p + 1) * window.samples / count;
    pieces.push_back({window.record, window.first + first, last - first});
  }
  return pieces;
}

/// Folds a window. @return how many rows.
Index fold_window(WindowRates& rates, const PathRecord& record, const SampleWindow& window,
                  RowFold& fold) {
  rates.evaluate(record, window);
  Matrix rows(fold.columns(), window.samples);
  rows << running_integrals(rates.theta(), record, window), samples_of(record, window);
  rows.colwise() -= rows.rowwise().mean().eval();
  if (!rows.allFinite()) return 0;
  fold.add(rows);
  return window.samples - 1;
}

/// Folds some windows in pieces of so many samples. @return how many rows.
Index fold_chunk(WindowRates rates, const WindowedPath& path, const WindowChunk& chunk,
                 Index samples, RowFold& fold, const RunContext& context) {
  Index count = 0;
  for (std::size_t w = chunk.first; w < chunk.last; ++w)
    for (const SampleWindow& piece : pieces_of(path.windows[w], samples)) {
      context.check_stop();
      count += fold_window(rates, path.records[piece.record], piece, fold);
    }
  return count;
}

IntegralRows fold_integrals(const SearchTask& task, WindowSearch& search,
                            const RunContext& context) {
  const Index terms = task.equations.library.size(), m = task.equations.dimension();
  std::vector<Index> all(static_cast<std::size_t>(terms));
  std::iota(all.begin(), all.end(), Index{0});
  search.rates.choose(all, Matrix::Zero(m, terms));
  const std::vector<WindowChunk> chunks = window_chunks(search.path.windows.size(), terms + m);
  std::vector<RowFold> folds;
  for (std::size_t c = 0; c < chunks.size(); ++c) folds.emplace_back(terms + m, Folding::Gram);
  std::vector<Index> counts(chunks.size());
  parallel_for(chunks.size(), context.threads, [&](std::size_t c) {
    counts[c] =
        fold_chunk(search.rates, search.path, chunks[c], search.shortest, folds[c], context);
  });
  for (std::size_t c = 1; c < folds.size(); ++c) folds[0].merge(folds[c]);
  return {folds[0].gram(), std::accumulate(counts.begin(), counts.end(), Index{0})};
}

/// The problem of some columns and a target.
/// @param gram of all. @param sigma of the target.
SubsetProblem problem_in(const Matrix& gram, std::vector<Index> chosen, Index target,
                         double sigma) {
  const auto count = static_cast<Index>(chosen.size());
  chosen.push_back(target);
  const Matrix part = gram(chosen, chosen);
  Vector norms = part.diagonal().cwiseSqrt();
  norms[count] /= sigma;
  return subset_problem(factor_gram(part, count).triangle * norms.asDiagonal());
}

/// Members of a problem in the order in which they leave, and from where on they are worth it.
struct Elimination {
  std::vector<Index> order;
  std::size_t worth = 0;  ///< the first that is worth the penalty
};

Elimination eliminated(const SubsetProblem& problem, double penalty,
                       const RunContext& context) {
  std::vector<Index> left(static_cast<std::size_t>(problem.columns()));
  std::iota(left.begin(), left.end(), Index{0});
  Elimination result;
  for (bool cheap = true; !left.empty();) {
    context.check_stop();
    Index worst = 0;
    cheap = losses_of(fit_subset(problem, left)).minCoeff(&worst) < penalty && cheap;
    if (cheap) result.worth = result.order.size() + 1;
    result.order.push_back(left[static_cast<std::size_t>(worst)]);
    left.erase(left.begin() + worst);
  }
  return result;
}

/// The terms that may stand in an equation.
std::vector<Index> terms_of(const SearchTask& task, Index equation) {
  std::vector<Index> terms;
  for (const Coefficient& candidate : task.candidates)
    if (candidate.equation == equation) terms.push_back(candidate.term);
  return terms;
}

/// Places of the terms that the model has in an equation.
std::vector<Index> members_of(const WindowSearch& search, Index equation,
                              const std::vector<Index>& terms) {
  std::vector<Index> members;
  for (std::size_t place = 0; place < terms.size(); ++place)
    if (search.fit.coefficients(equation, terms[place]) != 0.0)
      members.push_back(static_cast<Index>(place));
  return members;
}

/// The rows of some terms and one target, which is the last column.
Matrix gram_of(const IntegralRows& rows, std::vector<Index> terms, Index target) {
  terms.push_back(target);
  return rows.gram(terms, terms);
}

/// Screens one equation.
/// @param rows white, of unit variance where the noise is known and the path right.
ScreenedCandidates screen_equation(const SearchTask& task, const WindowSearch& search,
                                   Index equation, const IntegralRows& rows,
                                   const RunContext& context) {
  // Facts of the search: of those near the penalty the right ones may be any.
  constexpr std::size_t kPlausibleOfWorth = 2, kPlausibleBeside = 4;
  const Index room = kMostColumns / task.equations.dimension();
  const Index taken = std::max<Index>(40, room);
  const double sigma = search.sigma[equation];
  const std::vector<Index> names = terms_of(task, equation);
  const auto terms = static_cast<Index>(names.size());
  const Matrix gram = gram_of(rows, names, task.equations.library.size() + equation);
  std::vector<Index> members = members_of(search, equation, names);
  // A model with so many terms says nothing of what is needed.
  if (static_cast<Index>(members.size()) > taken / 2) members.clear();
  const ForwardOrder order = forward_order_in_gram(
      gram, terms, terms, {members, taken, std::numeric_limits<double>::infinity()}, context);
  const SubsetProblem problem = problem_in(gram, order.columns, terms, sigma);
  const auto n = static_cast<double>(rows.rows);
  const double scale =
      std::max(1.0, order.left / (sigma * sigma) /
                        std::max(1.0, n - static_cast<double>(problem.columns())));
  const double penalty = task.penalty.value_or(
      parameter_penalty(n) + choice_penalty(static_cast<double>(task.candidates.size())));
  const Elimination left = eliminated(problem, scale * penalty, context);
  const std::size_t size = left.order.size();
  const std::size_t plausible =
      std::min(size, std::max(kPlausibleOfWorth * (size - left.worth) + kPlausibleBeside,
                              static_cast<std::size_t>(room)));
  ScreenedCandidates result;
  for (std::size_t i = 0; i < size; ++i) {
    const auto place = static_cast<std::size_t>(left.order[i]);
    const Coefficient column{equation, names[static_cast<std::size_t>(order.columns[place])]};
    if (i >= left.worth) result.worth.push_back(column);
    if (i + plausible >= size || place < members.size()) result.plausible.push_back(column);
  }
  std::sort(result.worth.begin(), result.worth.end());
  std::sort(result.plausible.begin(), result.plausible.end());
  return result;
}

void append(std::vector<Coefficient>& all, const std::vector<Coefficient>& more) {
  all.insert(all.end(), more.begin(), more.end());
}

}  // namespace

bool is_wide(const SearchTask& task) {
  return static_cast<Index>(task.candidates.size()) > kMostColumns;
}

ScreenedCandidates screen_candidates(const SearchTask& task, WindowSearch& search,
                                     const RunContext& context) {
  const IntegralRows rows = fold_integrals(task, search, context);
  const auto m = static_cast<std::size_t>(task.equations.dimension());
  std::vector<ScreenedCandidates> equations(m);
  parallel_for(m, context.threads, [&](std::size_t k) {
    if (!task.equations.exact[k])
      equations[k] = screen_equation(task, search, static_cast<Index>(k), rows, context);
  });
  ScreenedCandidates result;
  for (const ScreenedCandidates& equation : equations) {
    append(result.worth, equation.worth);
    append(result.plausible, equation.plausible);
  }
  return result;
}

}  // namespace lacuna
