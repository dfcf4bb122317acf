// SPDX-License-Identifier: MIT
#include "screened_dead_times.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "delayed_inputs.hpp"
#include "identify/free_runs/averaged_records.hpp"
#include "identify/pipeline/equation_terms.hpp"
#include "identify/validation/held_blocks.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/regression/stages/basis.hpp"

namespace lacuna {
namespace {

constexpr Index kRows = 10000;  // a bound of the work: samples that are looked at

/// What the library leaves of the derivatives of means over some samples, under dead times.
class DelayedRows {
 public:
  /// @param longest time units: samples at the begin of each record that do not count.
  DelayedRows(const Dataset& data, const Pipeline& pipeline, Index half, double longest,
              const RunContext& context)
      : data_(data),
        half_(half),
        longest_(longest),
        // Derivatives are given: what it chooses for differences changes nothing.
        form_(fitted_to(pipeline.formulation, data, Vector::Zero(data.state_count()))),
        library_(equation_libraries(pipeline.basis->library(variables_of(data)), data, pipeline)
                     .library),
        context_(context) {}

  /// Samples over the width of a window: what independent noise leaves of them.
  double independent() const {
    return static_cast<double>(data_.samples()) / static_cast<double>(half_);
  }

  /// Sum over equations of n ln(residual^2), less what it is without any term.
  double left(const Vector& times) const {
    context_.check_stop();
    const LeastSquaresSystem system = form_->assemble(
        averaged(with_inputs_delayed(data_, times, longest_), half_), library_, context_);
    TermSet all(static_cast<std::size_t>(library_.size()));
    std::iota(all.begin(), all.end(), Index{0});
    double sum = 0.0;
    for (Index k = 0; k < data_.state_count(); ++k) {
      if (data_.rate_state(k)) continue;
      const Subproblem problem = system.subproblem(k, all);
      constexpr double kRounding = 1e-12;  // a fact: what is less is exact
      sum += 2.0 * independent() *
             std::log(std::max(problem.residual_norm() / problem.target_norm(), kRounding));
    }
    return sum;
  }

 private:
  const Dataset& data_;
  Index half_;
  double longest_;
  Stage<Formulation> form_;
  TermLibrary library_;
  const RunContext& context_;
};

/// Whole steps from 0 to the most, close together first.
std::vector<Index> grid_to(Index most) {
  constexpr double kRatio = 1.25;  // of neighbours; a bound of the work, refined below
  std::vector<Index> steps;
  for (Index s = 0; s <= most;
       s = std::max(s + 1, static_cast<Index>(kRatio * static_cast<double>(s))))
    steps.push_back(s);
  return steps;
}

/// One input's dead time in whole steps, beside those of the others.
class StepSearch {
 public:
  StepSearch(const DelayedRows& rows, Vector times, Index input, double step)
      : rows_(rows), times_(std::move(times)), input_(input), step_(step) {}

  double left(Index steps) {
    const auto known = left_.find(steps);
    if (known != left_.end()) return known->second;
    times_[input_] = static_cast<double>(steps) * step_;
    return left_[steps] = rows_.left(times_);
  }

  /// The best of a grid, and then of ever closer neighbours.
  Index best_to(Index most) {
    const std::vector<Index> grid = grid_to(most);
    Index best = 0;
    for (const Index steps : grid)
      if (left(steps) < left(best)) best = steps;
    for (Index apart = std::max<Index>(best / 8, 1);
         ;) {  // neighbours of the grid are 4 times that
      const Index before = best;
      for (const Index steps : {before - apart, before + apart})
        if (steps >= 0 && steps <= most && left(steps) < left(best)) best = steps;
      if (best != before) continue;
      if (apart == 1) return best;
      apart = std::max<Index>(apart / 2, 1);
    }
  }

  double gain(Index steps) { return left(0) - left(steps); }
  Index tried() const { return static_cast<Index>(left_.size()); }

 private:
  const DelayedRows& rows_;
  Vector times_;
  Index input_;
  double step_;
  std::map<Index, double> left_;
};

/// Times in whole steps, and what they gain over none.
struct Screened {
  Vector times;
  double gain = 0.0;
};

/// One input after the other until none changes. Only gains that are worth the choice count.
Screened screened(const DelayedRows& rows, Vector times, const std::vector<Index>& sought,
                  double step, Index most) {
  constexpr int kRounds = 3;  // a bound: inputs whose times go to and fro
  Screened found{std::move(times)};
  for (int round = 0; round < kRounds; ++round) {
    const Vector before = found.times;
    found.gain = 0.0;
    for (const Index j : sought) {
      StepSearch search(rows, found.times, j, step);
      const Index best = search.best_to(most);
      const double penalty =
          std::log(rows.independent()) + 2.0 * std::log(static_cast<double>(search.tried()));
      const bool worth = search.gain(best) > penalty;
      found.times[j] = worth ? static_cast<double>(best) * step : 0.0;
      if (worth) found.gain += search.gain(best) - penalty;
    }
    if (found.times == before) break;
  }
  return found;
}

}  // namespace

Vector screened_dead_times(const Dataset& given_data, const Pipeline& pipeline,
                           const DeadTimeOptions& options,
                           const std::vector<std::optional<double>>& given,
                           const RunContext& context) {
  constexpr double kRatio = 2.0;  // of one window to the next; a bound of the work
  const Dataset data = thinned(given_data, kRows);
  const double step = median_step(data);
  const auto most =
      static_cast<Index>(options.longest * longest_record(data).duration() / step);
  Screened best{Vector::Zero(data.input_count())};
  std::vector<Index> sought;
  for (Index j = 0; j < best.times.size(); ++j) {
    const auto& known = given[static_cast<std::size_t>(j)];
    best.times[j] = known.value_or(0.0);
    if (!known) sought.push_back(j);
  }
  if (most < 1 || sought.empty()) return best.times;
  const Vector start = best.times;
  const double longest = std::max(static_cast<double>(most) * step, start.maxCoeff());
  for (Index half = 1; 8 * half < longest_record(data).samples();
       half = static_cast<Index>(kRatio * static_cast<double>(half))) {
    try {
      const DelayedRows rows(data, pipeline, half, longest, context);
      Screened found = screened(rows, start, sought, step, most);
      if (found.gain > best.gain) best = std::move(found);
    } catch (const DataError&) {
      break;  // too few rows for the library
    }
  }
  return best.times;
}

}  // namespace lacuna
