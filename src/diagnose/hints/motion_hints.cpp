// SPDX-License-Identifier: MIT
#include "motion_hints.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>
#include <set>

#include "core/base/text.hpp"
#include "core/numerics/least_squares.hpp"
#include "core/numerics/symmetric_eigen.hpp"
#include "core/statistics/significance.hpp"

namespace lacuna {
namespace {

/// All values of one column, one record after the other.
Vector values_of(const Dataset& data, Matrix Trajectory::*block, Index column) {
  Vector all(data.samples());
  Index row = 0;
  for (const Trajectory& record : data.trajectories) {
    all.segment(row, record.samples()) = (record.*block).col(column);
    row += record.samples();
  }
  return all;
}

double variance(const Vector& values) {
  return (values.array() - values.mean()).square().mean();
}

double known_noise(const Channel& channel) {
  return channel.noise.kind == NoiseKind::None ? 0.0 : channel.noise.sigma;
}

/// Fraction of an input's variance that a linear function of the states has.
double fraction_of_states(const Matrix& states, const Vector& input) {
  Matrix columns = states.rowwise() - states.colwise().mean();
  for (Index k = 0; k < columns.cols(); ++k)
    if (columns.col(k).norm() > 0.0) columns.col(k).normalize();
  const Vector moved = input.array() - input.mean();
  const Vector rest = moved - columns * least_squares(columns, moved);
  return 1.0 - rest.squaredNorm() / moved.squaredNorm();
}

Matrix states_of(const Dataset& data) {
  Matrix states(data.samples(), data.state_count());
  for (Index k = 0; k < states.cols(); ++k)
    states.col(k) = values_of(data, &Trajectory::states, k);
  return states;
}

Matrix increments(const Matrix& values) {
  return values.bottomRows(values.rows() - 1) - values.topRows(values.rows() - 1);
}

/// Whether an input answers the states and not they it: from one sample to the next it moves with
/// them. What an input that jumps and then holds does to the states shows at the next sample only,
/// however fast they are. Seams of records are a few rows among all.
bool answers_states(const Matrix& states, const Vector& input, double significance) {
  const Matrix moves = increments(input);
  const double gain = fraction_of_states(increments(states), moves.col(0));
  return sigma_of_gain(static_cast<double>(moves.rows()) * gain,
                       static_cast<double>(states.cols()), 1.0) >= significance;
}

bool is_still_input(const Dataset& data, Index input) {
  const Vector u = values_of(data, &Trajectory::inputs, input);
  return variance(u) <= 1e-20 * u.squaredNorm() / static_cast<double>(u.size());
}

/// Whether the plant itself makes an input a function of the states: in an equation that has it
/// as a term the measured rates are next to nothing beside what it adds, so that the other
/// terms make up for it (u = R i + K w of an armature whose current settles at once).
bool is_settled(const OdeModel& model, const Dataset& data, const RateWindows& windows,
                const std::string& input, double feedback) {
  for (Index k = 0; k < model.dimension(); ++k) {
    const Equation& terms = model.equations()[static_cast<std::size_t>(k)];
    const auto own = std::find_if(terms.begin(), terms.end(), [&](const WeightedTerm& summand) {
      return summand.term.name() == input;
    });
    if (own == terms.end() || !data.is_measured(k)) continue;
    const Vector rates = window_rates(data, windows).col(k);
    const Vector means = term_means(model, k, data, windows).col(own - terms.begin());
    if (variance(rates) <= (1.0 - feedback) * variance(own->coefficient * means)) return true;
  }
  return false;
}

void add_input_hints(const OdeModel& model, const Dataset& data, const RateWindows& windows,
                     const HintOptions& options, std::vector<Hint>& hints) {
  const Matrix states = states_of(data);
  for (Index j = 0; j < data.input_count(); ++j) {
    const std::string& name = model.inputs()[static_cast<std::size_t>(j)].name;
    const Vector u = values_of(data, &Trajectory::inputs, j);
    if (is_still_input(data, j)) {
      hints.push_back(
          {HintKind::Excitation,
           "the input " + name +
               " does not change: what acts on it is not distinguished from a constant",
           "use a record in which " + name + " moves"});
      continue;
    }
    const double fraction = fraction_of_states(states, u);
    if (!(fraction >= options.feedback && fraction < 1.0 + 1e-9) ||
        !answers_states(states, u, options.significance) ||
        is_settled(model, data, windows, name, options.feedback))
      continue;
    hints.push_back(
        {HintKind::ClosedLoop,
         "the input " + name + " follows the states (" + format_number(100.0 * fraction, 3) +
             " % of it is a linear function of them), as feedback makes it: coefficients of " +
             name +
             " and of the states, and effects in either, are distinguished by the rest only",
         "add a known excitation to " + name + ", or move its reference faster"});
  }
}

/// Significance of the first autocorrelations of a state together: n r_k^2, summed over lags,
/// is chi squared for white noise (Box and Pierce, J. Am. Stat. Assoc. 65:1509, 1970). Records
/// in which the state never changes say nothing.
double significance_of_motion(const Dataset& data, Index state) {
  // A fact of the statistic: its distribution knows how many are summed,
  // HintOptions::significance decides.
  constexpr Index kLags = 20;
  constexpr double kRounding = 1e-14;  // a fact: what subtracting a mean leaves of a constant
  double sum = 0.0, freedom = 0.0;
  for (const Trajectory& record : data.trajectories) {
    const Index n = record.samples();
    const Vector x = record.states.col(state).array() - record.states.col(state).mean();
    if (!(x.norm() > kRounding * record.states.col(state).norm())) continue;
    for (Index lag = 1; lag <= std::min(kLags, n / 4); ++lag) {
      const double r = x.head(n - lag).dot(x.tail(n - lag)) / x.squaredNorm();
      sum += static_cast<double>(n) * r * r;
      ++freedom;
    }
  }
  return freedom > 0.0 ? sigma_of_gain(sum, freedom, 1.0) : 0.0;
}

/// Standard deviation of a state about its mean.
double size_of(const Dataset& data, Index state) {
  return std::sqrt(variance(values_of(data, &Trajectory::states, state)));
}

/// Whether a state deviates from its mean by what its noise does, or never.
bool hardly_moves(double size, double noise, const HintOptions& options) {
  return size <= options.barely_moving * noise || size == 0.0;
}

/// Standard deviation of rounding to a lattice of the least difference of two values: what a
/// state that rests between two of them shows.
double rounding_of(const Dataset& data, Index state) {
  const Vector values = values_of(data, &Trajectory::states, state);
  std::set<double> distinct;
  for (const double value : values)
    if (std::isfinite(value)) distinct.insert(value);
  double least = std::numeric_limits<double>::infinity();
  for (auto above = distinct.begin(); above != distinct.end(); ++above)
    if (above != distinct.begin()) least = std::min(least, *above - *std::prev(above));
  return std::isfinite(least) ? least / std::sqrt(12.0) : 0.0;
}

/// Whether all that was measured is white noise, or never changes: no model is distinguished
/// from another one by it. Few samples are no significant motion, however smooth they are: so
/// none of them may exceed its noise, or rounding, either.
bool is_still(const BoundRecords& records, const HintOptions& options) {
  bool any = false;
  for (std::size_t k = 0; k < records.channels.size(); ++k) {
    const Channel& channel = records.channels[k];
    if (!channel.measured) continue;
    const auto state = static_cast<Index>(k);
    if (significance_of_motion(records.data, state) >= options.significance) return false;
    const double noise = std::max(known_noise(channel), rounding_of(records.data, state));
    if (!hardly_moves(size_of(records.data, state), noise, options)) return false;
    any = true;
  }
  return any;
}

void add_state_hints(const OdeModel& model, const BoundRecords& records,
                     const HintOptions& options, std::vector<Hint>& hints) {
  double fastest = std::numeric_limits<double>::infinity();
  Index fast = 0;
  for (Index k = 0; k < model.dimension(); ++k) {
    const Channel& channel = records.channels[static_cast<std::size_t>(k)];
    if (!channel.measured) continue;
    const std::string& name = model.states()[static_cast<std::size_t>(k)].name;
    const double size = size_of(records.data, k);
    const double noise = known_noise(channel);
    if (hardly_moves(size, noise, options)) {
      hints.push_back(
          {HintKind::Excitation,
           name + " hardly moves" +
               (noise > 0.0 ? ": its standard deviation is " + format_number(size / noise, 2) +
                                  " times that of its noise"
                            : ""),
           "use a record with more motion in " + name});
      continue;
    }
    const double steps = steps_in_period(records.data, k, noise);
    if (steps < fastest) fast = k;
    fastest = std::min(fastest, steps);
  }
  if (!std::isfinite(fastest)) return;
  const std::string& name = model.states()[static_cast<std::size_t>(fast)].name;
  if (fastest < options.samples_per_period)
    hints.push_back({HintKind::Sampling,
                     "a mean period of " + name + " has " + format_number(fastest, 2) +
                         " samples: what happens between them is guessed",
                     "sample at least " + format_number(options.samples_per_period, 2) +
                         " times in a period"});
  if (static_cast<double>(longest_record(records.data).samples()) < options.periods * fastest)
    hints.push_back({HintKind::Sampling,
                     "the longest record has less than " + format_number(options.periods, 2) +
                         " mean periods of " + name,
                     "record for longer"});
}

/// Whether all that is seen is one way from a start to a rest under inputs that never change:
/// its rate is some function of the state, and of the time as well.
bool is_one_transient(const BoundRecords& records, const HintOptions& options) {
  const Dataset& data = records.data;
  if (data.input_count() == 0) return false;
  for (Index j = 0; j < data.input_count(); ++j)
    if (!is_still_input(data, j)) return false;
  double fastest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < records.channels.size(); ++k)
    if (records.channels[k].measured)
      fastest = std::min(fastest, steps_in_period(data, static_cast<Index>(k),
                                                  known_noise(records.channels[k])));
  return std::isfinite(fastest) &&
         static_cast<double>(longest_record(data).samples()) < options.periods * fastest;
}

/// Terms of an equation whose coefficients the records do not distinguish.
std::optional<Hint> alike_terms(const OdeModel& model, Index equation, Matrix terms,
                                double alike) {
  if (terms.cols() < 2 || !terms.allFinite()) return std::nullopt;
  for (Index j = 0; j < terms.cols(); ++j) {
    if (terms.col(j).norm() == 0.0) return std::nullopt;
    terms.col(j).normalize();
  }
  const SymmetricEigen found = symmetric_eigen(terms.transpose() * terms);
  if (found.values[0] > alike * alike) return std::nullopt;
  const Vector together = found.vectors.col(0).cwiseAbs();
  std::vector<std::string> names;
  for (Index j = 0; j < terms.cols(); ++j)
    if (together[j] > 0.1 * together.maxCoeff())
      names.push_back(
          model.equations()[static_cast<std::size_t>(equation)][static_cast<std::size_t>(j)]
              .term.name());
  return Hint{HintKind::NotIdentifiable,
              "in d" + model.states()[static_cast<std::size_t>(equation)].name +
                  "/dt the terms " + join(names, ", ") +
                  " go along: the records do not distinguish their coefficients",
              "hold one of them, e.g. with --tolerance, or use a record with other motion"};
}

}  // namespace

double steps_in_period(const Dataset& data, Index state, double sigma) {
  double differences = 0.0, count = 0.0;
  for (const Trajectory& record : data.trajectories) {
    const Index n = record.samples() - 1;
    const auto values = record.states.col(state);
    differences += (values.tail(n) - values.head(n)).squaredNorm();
    count += static_cast<double>(n);
  }
  const double noise = sigma * sigma;
  const double power = variance(values_of(data, &Trajectory::states, state)) - noise;
  const double change = differences / count - 2.0 * noise;
  if (!(power > 0.0) || !(change > 0.0)) return std::numeric_limits<double>::infinity();
  return std::numbers::pi / std::asin(std::min(1.0, 0.5 * std::sqrt(change / power)));
}

std::optional<Hint> stillness(const BoundRecords& records, const HintOptions& options) {
  if (!is_still(records, options)) return std::nullopt;
  return Hint{HintKind::Excitation,
              "nothing moves: what was measured is white noise, and neither effects nor "
              "coefficients can be determined by it",
              "use a record with motion", Withheld::Claims};
}

std::vector<Hint> motion_hints(const OdeModel& model, const BoundRecords& records,
                               const RateWindows& windows, const HintOptions& options) {
  if (auto still = stillness(records, options)) return {std::move(*still)};
  std::vector<Hint> hints;
  add_input_hints(model, records.data, windows, options, hints);
  add_state_hints(model, records, options, hints);
  if (is_one_transient(records, options))
    hints.push_back({HintKind::Excitation,
                     "all there is to see is one way to a rest under inputs that never change: "
                     "whatever is missing may be a function of any state, or of time",
                     "use a record in which the inputs move", Withheld::Names});
  for (Index k = 0; k < model.dimension(); ++k)
    if (auto hint = alike_terms(model, k, term_means(model, k, records.data, windows),
                                options.alike_terms))
      hints.push_back(std::move(*hint));
  return hints;
}

}  // namespace lacuna
