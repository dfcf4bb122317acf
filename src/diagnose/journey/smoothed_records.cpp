// SPDX-License-Identifier: MIT
#include "smoothed_records.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "lacuna/data/records/marks.hpp"
#include "lacuna/trajectories/smoother/assimilation.hpp"
#include "lacuna/trajectories/smoother/disturbance_test.hpp"
#include "trajectories/smoother/hidden_states.hpp"

namespace lacuna {
namespace {

using Kind = SmoothingFilter::Kind;

bool are_whole(const BoundRecords& records) {
  const auto is_even = [](const Trajectory& record) {
    return uniform_step(record).has_value();
  };
  const auto is_whole = [](const Channel& channel) {
    return !channel.measured || channel.missing + channel.at_top + channel.at_bottom == 0.0;
  };
  const std::vector<Trajectory>& all = records.data.trajectories;
  return std::all_of(all.begin(), all.end(), is_even) &&
         std::all_of(records.channels.begin(), records.channels.end(), is_whole);
}

std::vector<Index> measured_states(const BoundRecords& records) {
  std::vector<Index> states;
  for (std::size_t k = 0; k < records.channels.size(); ++k)
    if (records.channels[k].measured) states.push_back(static_cast<Index>(k));
  return states;
}

/// Samples that are left of records that were smoothed.
Index samples_left(const SmoothingFilter& filter, const Dataset& data,
                   const SmoothingOptions& options) {
  const auto records = static_cast<Index>(data.trajectories.size());
  return (data.samples() - 2 * filter.reach() * records) / memory_of(filter, options);
}

/// The model, its coefficients fitted in few passes, on what was before.
Assimilation fit_before(const Smoothing& smoothing, const Problem& problem) {
  // A fact: filters are half a window apart, or as far as a column is from its mean; what later
  // passes change of the coefficients is less by far.
  constexpr int kPasses = 3;
  const BoundRecords sharp =
      preprocessed(smoothing, problem.records, problem.options.decision.smoothing);
  AssimilationOptions options;
  options.hidden = hidden_states(problem.nominal, sharp.data);
  options.passes = kPasses;
  options.free = free_coefficients(problem.nominal);
  options.priors = problem.options.tolerances;
  return assimilate(problem.nominal, sharp, options, problem.context);
}

/// What leaves the same noise; without inputs nothing determines it.
std::vector<Smoothing> alike(const SmoothingFilter& seen, bool has_inputs) {
  std::vector<Smoothing> others;
  if (!has_inputs) return others;
  others.push_back({seen, true});
  if (seen.kind == Kind::CentredMean) others.push_back({{Kind::PastMean, seen.window}});
  return others;
}

}  // namespace

std::optional<Smoothing> smoothing_of(const Problem& problem) {
  const DecisionOptions& decision = problem.options.decision;
  if (!are_whole(problem.records)) return std::nullopt;
  const SmoothingOptions& options = decision.smoothing;
  const Dataset& data = problem.records.data;
  const auto seen =
      estimated_filter(data, measured_states(problem.records), decision.undecided, options);
  if (!seen || samples_left(*seen, data, options) < options.least_left) return std::nullopt;
  Smoothing best{*seen};
  const std::vector<Smoothing> others = alike(*seen, !problem.nominal.inputs().empty());
  if (others.empty()) return best;
  const Assimilation plain = fit_before(best, problem);
  double most = decision.major;
  for (const Smoothing& other : others) {
    const Assimilation fit = fit_before(other, problem);
    if (!(fit.deviance < plain.deviance - decision.undecided)) continue;
    const double fraction = fraction_closed(plain, fit);
    if (fraction <= most) continue;
    most = fraction;
    best = other;
  }
  return best;
}

Dataset preprocessed(const Smoothing& smoothing, Dataset data,
                     const SmoothingOptions& options) {
  const SmoothingFilter& filter = smoothing.filter;
  const Index reach = filter.reach(), memory = memory_of(filter, options);
  for (Trajectory& record : data.trajectories) {
    if (!uniform_step(record)) continue;
    const Matrix states = filled(std::move(record.states), record.marks);
    record.states = undone(filter, states, options.turns);
    if (smoothing.of_inputs) record.inputs = undone(filter, record.inputs, options.turns);
    for (Index i = 0; i < record.samples(); ++i)
      if (i < reach || i >= record.samples() - reach || (i - reach) % memory != 0)
        for (Index k = 0; k < record.states.cols(); ++k) set_mark(record, i, k, Mark::Missing);
  }
  return data;
}

BoundRecords preprocessed(const Smoothing& smoothing, BoundRecords records,
                          const SmoothingOptions& options) {
  records.data = preprocessed(smoothing, std::move(records.data), options);
  for (std::size_t r = 0; r < records.outliers.size(); ++r) {
    const Matrix& marks = records.data.trajectories[r].marks;
    Matrix& outliers = records.outliers[r];
    if (outliers.size() == 0) outliers = Matrix::Zero(marks.rows(), marks.cols());
    outliers = (marks.array() == number_of(Mark::Missing)).select(marks, outliers);
  }
  return with_noise_anew(std::move(records));
}

std::string note_on(const Smoothing& smoothing) {
  return std::string(smoothing.of_inputs ? "all columns" : "the states") +
         " were smoothed by " + description_of(smoothing.filter) +
         ", as their noise shows; the model is compared with what they were before, and "
         "samples as they were measured would determine more";
}

}  // namespace lacuna
