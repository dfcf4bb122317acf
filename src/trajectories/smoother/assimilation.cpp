// SPDX-License-Identifier: MIT
#include "lacuna/trajectories/smoother/assimilation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/numerics/least_squares.hpp"
#include "data/records/check_record.hpp"
#include "determined_step.hpp"
#include "lacuna/core/base/error.hpp"
#include "lacuna/data/records/marks.hpp"
#include "lacuna/data/records/noise.hpp"
#include "model/equations/formula_channel.hpp"
#include "trajectories/smoother/innovation_system.hpp"
#include "trajectories/smoother/variance_fit.hpp"
#include "unknown_past.hpp"

namespace lacuna {
namespace {

Vector spans(const Dataset& data) {
  Vector low = data.trajectories.front().states.colwise().minCoeff();
  Vector high = data.trajectories.front().states.colwise().maxCoeff();
  for (const Trajectory& record : data.trajectories) {
    low = low.cwiseMin(record.states.colwise().minCoeff().transpose());
    high = high.cwiseMax(record.states.colwise().maxCoeff().transpose());
  }
  return (high - low).cwiseMax(std::numeric_limits<double>::min());
}

double coefficient_at(const OdeModel& model, const CoefficientPlace& place) {
  return model
      .equations()[static_cast<std::size_t>(place.equation)]
                  [static_cast<std::size_t>(place.term)]
      .coefficient;
}

OdeModel with_coefficients(const OdeModel& model, const std::vector<CoefficientPlace>& places,
                           const Vector& change) {
  std::vector<Equation> equations = model.equations();
  for (std::size_t j = 0; j < places.size(); ++j)
    equations[static_cast<std::size_t>(places[j].equation)]
             [static_cast<std::size_t>(places[j].term)]
                 .coefficient += change[static_cast<Index>(j)];
  return {model.states(), model.inputs(), std::move(equations), model.time_unit()};
}

/// Takes turns at path, variances and coefficients.
class Turns {
 public:
  Turns(const Dataset& data, const AssimilationOptions& options, Assimilation start,
        const RunContext& context)
      : data_(data),
        options_(options),
        context_(context),
        variances_(resolution_of(data), start.curvature),
        state_(std::move(start)) {
    state_.least_noise = resolution_of(data);
  }

  /// @param fresh whether the variances are first guesses.
  Assimilation run(bool fresh) {
    double last = std::numeric_limits<double>::infinity();
    std::optional<Assimilation> best;
    int rises = 0;
    relinearise();
    // A guessed path may lie where the model has no slope, as the root of an empty tank.
    if (!options_.hidden.empty() && !is_linearised()) {
      state_.deviance = std::numeric_limits<double>::infinity();
      return std::move(state_);
    }
    if (!fresh) update_coefficients();
    for (int pass = 0; pass < options_.passes; ++pass) {
      context_.check_stop();
      // The noise of the measurement is known roughly from the start, the disturbances are not.
      const bool settling = fresh && pass < kSettlingPasses;
      variances_.set_white_moves(!settling);
      const std::vector<Matrix> before =
          options_.hidden.empty() ? std::vector<Matrix>() : paths();
      improve_noise_and_path();
      if (before.empty())
        relinearise();
      else
        relinearise_in_reach(before);
      update_coefficients();
      if (settling) continue;
      if (state_.deviance < last - kUnnoticedDeviance) {
        last = state_.deviance;
        best = state_;
        continue;
      }
      if (std::abs(state_.deviance - last) <= kUnnoticedDeviance || ++rises > kRises) break;
    }
    if (best && !(state_.deviance < best->deviance + kUnnoticedDeviance))
      state_ = std::move(*best);
    return options_.hidden.empty() ? std::move(state_) : verified(std::move(state_));
  }

 private:
  /// Where states are hidden a step may be far from what it promises: what counts is the
  /// deviance that is found where the steps have led.
  Assimilation verified(Assimilation found) {
    constexpr int kPasses = 3;
    state_ = std::move(found);
    relinearise();
    std::optional<Assimilation> best;
    for (int pass = 0; pass < kPasses; ++pass) {
      const InnovationSystem system(state_);
      state_.deviance = system.deviance();
      state_.used = system.used();
      if (best && std::isfinite(best->deviance) && !(state_.deviance < best->deviance)) break;
      best = state_;
      if (pass + 1 == kPasses) break;
      const std::vector<Matrix> before = paths();
      improve_noise_and_path();
      relinearise_in_reach(before);
    }
    return std::move(*best);
  }

  static constexpr int kIterations = 8;
  static constexpr int kSettlingPasses = 2;
  /// Steps that raise the deviance before the turns are given up; the linearisation need not
  /// hold for a long first step.
  static constexpr int kRises = 2;

  /// What a step cannot be predicted better than: noise and disturbances. Where a state is not
  /// measured, a thousandth of its range.
  Vector accuracy() const {
    Vector result = spans(data_) * 1e-3;
    // A free input has no column: it is as accurate as its path asks for, to begin with as 1.
    for (Index k = 0; k < result.size(); ++k) {
      for (const LinearisedRecord& record : state_.records) {
        const auto& path = record.path.col(k);
        result[k] = std::max(result[k], 1e-3 * (path.maxCoeff() - path.minCoeff()));
      }
      if (result[k] <= std::numeric_limits<double>::min()) result[k] = 1.0;
    }
    const double root = std::sqrt(mean_step(data_.trajectories.front()));
    for (Index k = 0; k < result.size(); ++k)
      if (const auto& sd = state_.noise.measurement[static_cast<std::size_t>(k)])
        result[k] = std::hypot(*sd, root * state_.noise.disturbance[k]);
    return result;
  }

  void relinearise() {
    for (std::size_t r = 0; r < data_.trajectories.size(); ++r) {
      LinearisedRecord& record = state_.records[r];
      const Matrix bridge = std::move(record.bridge);
      record = linearise(state_.model, data_.trajectories[r], record.path, accuracy());
      if (record.bridge.size() == 0)
        record.bridge = bridge;
      else if (bridge.size() > 0)
        record.bridge = record.bridge.cwiseMax(bridge);
      bridge_unknown_past(record);
    }
    correct_channels();
  }

  /// Steps that need what was before the record, where no effect has bridged them.
  void bridge_unknown_past(LinearisedRecord& record) const {
    const Matrix past = unknown_past(state_.model, record);
    if (past.size() == 0) return;
    if (record.bridge.size() == 0) record.bridge = Matrix::Zero(past.rows(), past.cols());
    record.bridge = (record.bridge.array() > 0.0).select(record.bridge, past).eval();
  }

  void correct_channels() {
    for (std::size_t r = 0; r < state_.records.size(); ++r)
      state_.measured[r] =
          without_channel_terms(data_.trajectories[r].states, state_.records[r],
                                state_.model.variables(), state_.channel_terms);
  }

  void improve_noise_and_path() {
    SmoothedNoise best = variances_.run({state_.records, state_.measured, state_.omitted},
                                        state_.noise, kIterations);
    state_.noise = std::move(best.noise);
    state_.curvature = variances_.curvature();
    for (std::size_t r = 0; r < state_.records.size(); ++r)
      state_.records[r].path += best.records[r].deviation;
  }

  /// The path where the model has rates: between the one before and the one that was found.
  void relinearise_in_reach(const std::vector<Matrix>& before) {
    constexpr int kHalvings = 6;
    relinearise();
    for (int halving = 0; halving < kHalvings && !is_linearised(); ++halving) {
      for (std::size_t r = 0; r < state_.records.size(); ++r)
        state_.records[r].path = 0.5 * (state_.records[r].path + before[r]);
      relinearise();
    }
  }

  bool is_linearised() const {
    return std::all_of(state_.records.begin(), state_.records.end(), [](const auto& record) {
      return record.defect.allFinite() && record.transition.allFinite();
    });
  }

  std::vector<Matrix> paths() const {
    std::vector<Matrix> paths;
    for (const LinearisedRecord& record : state_.records) paths.push_back(record.path);
    return paths;
  }

  void update_coefficients() {
    const InnovationSystem system(state_);
    state_.deviance = system.deviance();
    state_.used = system.used();
    const Matrix columns = system.fitted_columns();
    if (columns.cols() == 0) return;
    Matrix normal = columns.transpose() * columns;
    Vector right = columns.transpose() * system.innovations();
    add_priors(state_, options_.priors, normal, right);
    const Vector change = solved(normal, right);
    if (!change.allFinite()) return;
    state_.deviance -= change.dot(right);
    const auto free = static_cast<Index>(state_.free.size());
    shift_defects(change.head(free));
    state_.model = with_coefficients(state_.model, state_.free, change);
    for (std::size_t j = 0; j < state_.channel_terms.size(); ++j)
      state_.channel_terms[j].coefficient += change[free + static_cast<Index>(j)];
    correct_channels();
  }

  /// The step of least squares; leaves the covariance behind.
  Vector solved(const Matrix& normal, const Vector& right) {
    if (options_.held_among > 0) {
      DeterminedStep step =
          determined_step(normal, right, sizes_of(state_, options_.held_among), options_.units);
      state_.covariance = std::move(step.covariance);
      state_.held = Matrix::Zero(right.size(), options_.unseen.cols() + step.held.cols());
      state_.held.topLeftCorner(options_.unseen.rows(), options_.unseen.cols()) =
          options_.unseen;
      state_.held.rightCols(step.held.cols()) = step.held;
      state_.units = options_.units;
      return std::move(step.change);
    }
    const Vector scale = normal.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    const Matrix scaled = scale.asDiagonal() * normal * scale.asDiagonal();
    const Matrix inverse =
        solve_symmetric(scaled, Matrix::Identity(right.size(), right.size()));
    state_.covariance = scale.asDiagonal() * inverse * scale.asDiagonal();
    return scale.asDiagonal() * solve_symmetric(scaled, scale.asDiagonal() * right);
  }

  /// What new coefficients predict beyond the path, to first order, so that the records need
  /// not be linearised again for them.
  void shift_defects(const Vector& change) {
    for (LinearisedRecord& record : state_.records)
      for (Index k = 0; k < state_.noise.states(); ++k) shift_defect(record, k, change);
  }

  void shift_defect(LinearisedRecord& record, Index equation, const Vector& change) const {
    const Index m = state_.noise.states();
    const Equation& terms = state_.model.equations()[static_cast<std::size_t>(equation)];
    std::vector<Expression> formulas;
    std::vector<double> changes;
    for (std::size_t j = 0; j < state_.free.size(); ++j) {
      if (state_.free[j].equation != equation) continue;
      formulas.push_back(
          terms[static_cast<std::size_t>(state_.free[j].term)].term.expression());
      changes.push_back(change[static_cast<Index>(j)]);
    }
    if (formulas.empty()) return;
    const Vector rate =
        evaluate_on(record, state_.model.variables(), formulas) *
        Eigen::Map<const Vector>(changes.data(), static_cast<Index>(changes.size()));
    for (Index i = 0; i < record.steps(); ++i) {
      const Eigen::Map<const Matrix> w(record.response.col(i).data() + 3 * m * equation, m, 3);
      record.defect.col(i) += w.lazyProduct(rate.segment<3>(record.grid.begin(i)));
    }
  }

  const Dataset& data_;
  const AssimilationOptions& options_;
  const RunContext& context_;
  VarianceFit variances_;
  Assimilation state_;
};

/// Whether an equation holds exactly: an identity, or the formula of a channel.
bool is_exact(const OdeModel& model, Index equation) {
  return is_formula_channel(model.states()[static_cast<std::size_t>(equation)]) ||
         identity_of(model, equation).has_value();
}

/// Whether nothing disturbs an equation to begin with. One without terms that stands for a
/// state which nobody measured says what that state is: a constant.
bool is_undisturbed(const OdeModel& model, const Dataset& data, Index equation) {
  return is_exact(model, equation) ||
         (!data.is_measured(equation) &&
          model.equations()[static_cast<std::size_t>(equation)].empty());
}

/// Noise that the samples show: against their neighbours, or as values on a lattice.
Vector visible_noise(const Dataset& data) {
  Vector noise = estimate_noise(data);
  const std::vector<StateNoise> analysed = analyse_noise(data);
  for (Index k = 0; k < noise.size(); ++k)
    if (const StateNoise& state = analysed[static_cast<std::size_t>(k)];
        state.kind == NoiseKind::Quantised)
      noise[k] = state.sigma;
  return noise;
}

/// Variances to begin with: noise as the differences of the record show it, disturbances as if
/// the model explained half of each rate.
NoiseModel first_noise(const OdeModel& model, const Dataset& data, const Vector& seen,
                       const AssimilationOptions& options) {
  const Vector white = resolution_of(data).cwiseMax(seen);
  const Trajectory& record = data.trajectories.front();
  const double step = mean_step(record);
  NoiseModel noise;
  noise.coloured = options.coloured;
  noise.coloured.resize(static_cast<std::size_t>(model.dimension()));
  noise.disturbance = Vector::Zero(model.dimension());
  for (Index k = 0; k < model.dimension(); ++k) {
    const auto measured = data.is_measured(k) ? std::optional(white[k]) : std::nullopt;
    noise.measurement.push_back(measured);
    const bool disturbed = options.disturbed.empty()
                               ? !is_undisturbed(model, data, k)
                               : options.disturbed[static_cast<std::size_t>(k)];
    const Vector change = record.states.col(k).tail(record.samples() - 1) -
                          record.states.col(k).head(record.samples() - 1);
    double moved = 0.1 * std::sqrt(change.squaredNorm() / static_cast<double>(change.size()));
    // A channel that never moves says nothing of what disturbs it, which is not nothing.
    if (moved == 0.0 && measured) moved = *measured;
    if (disturbed) noise.disturbance[k] = moved / std::sqrt(step);
  }
  return noise;
}

}  // namespace

Vector resolution_of(const Dataset& data) {
  check_states(data, "resolution_of");
  check_argument(data.samples() > 0, "resolution_of", "there is no sample");
  // Text with six digits, the least that is in use, leaves steps of 1e-6 of the span; of a
  // channel that never moves, of its value.
  Vector sizes = spans(data);
  const Vector values = data.trajectories.front().states.row(0).cwiseAbs().transpose();
  for (Index k = 0; k < sizes.size(); ++k)
    if (sizes[k] <= std::numeric_limits<double>::min())
      sizes[k] = values[k] > 0.0 ? values[k] : 1.0;
  return 1e-7 * sizes;
}

std::vector<CoefficientPlace> free_coefficients(const OdeModel& model) {
  std::vector<CoefficientPlace> places;
  for (Index k = 0; k < model.dimension(); ++k) {
    if (is_exact(model, k)) continue;
    const Equation& equation = model.equations()[static_cast<std::size_t>(k)];
    for (std::size_t j = 0; j < equation.size(); ++j)
      if (!equation[j].fixed) places.push_back({k, static_cast<Index>(j)});
  }
  return places;
}

Vector sizes_of(const Assimilation& fit, std::size_t count) {
  Vector size = Vector::Zero(static_cast<Index>(fit.free.size() + fit.channel_terms.size()));
  for (std::size_t j = 0; j < count && j < fit.free.size(); ++j)
    size[static_cast<Index>(j)] = coefficient_at(fit.model, fit.free[j]);
  return size;
}

void add_priors(const Assimilation& fit, const std::vector<CoefficientPrior>& priors,
                Matrix& normal, Vector& right) {
  for (const CoefficientPrior& prior : priors)
    for (std::size_t j = 0; j < fit.free.size(); ++j) {
      if (!(fit.free[j] == prior.place)) continue;
      const auto row = static_cast<Index>(j);
      const double weight = 1.0 / (prior.deviation * prior.deviation);
      normal(row, row) += weight;
      right[row] += weight * (prior.mean - coefficient_at(fit.model, prior.place));
    }
}

Matrix without_channel_terms(Matrix measured, const LinearisedRecord& record,
                             const Variables& variables,
                             const std::vector<ChannelTerm>& terms) {
  for (const ChannelTerm& term : terms)
    measured.col(term.state) -=
        term.coefficient * evaluate_on(record, variables, term.form)(record.sample_rows());
  return measured;
}

std::optional<Assimilation> with_seen_noise(const Assimilation& fit) {
  constexpr double kMuchLess = 0.3;
  Assimilation start = fit;
  bool raised = false;
  for (Index k = 0; k < fit.seen_noise.size(); ++k) {
    auto& white = start.noise.measurement[static_cast<std::size_t>(k)];
    if (!white || *white >= kMuchLess * fit.seen_noise[k]) continue;
    white = fit.seen_noise[k];
    raised = true;
  }
  return raised ? std::optional(std::move(start)) : std::nullopt;
}

Assimilation settled(Assimilation found, const Dataset& data,
                     const AssimilationOptions& options, const RunContext& context) {
  const auto start = with_seen_noise(found);
  if (!start) return found;
  Assimilation other = assimilate_from(found.model, data, *start, options, context);
  return other.deviance < found.deviance ? other : found;
}

Assimilation assimilate(const OdeModel& model, const Dataset& data,
                        const std::vector<Matrix>& omitted, const AssimilationOptions& options,
                        const RunContext& context) {
  check_dataset(data);
  Assimilation start{model};
  start.omitted = omitted;
  start.seen_noise = visible_noise(data);
  start.noise = first_noise(model, data, start.seen_noise, options);
  for (std::size_t r = 0; r < data.trajectories.size(); ++r) {
    const Matrix& states = data.trajectories[r].states;
    start.records.emplace_back();
    start.records.back().path = omitted.empty() ? states : filled(states, omitted[r]);
    start.measured.push_back(states);
  }
  start.free = options.free;
  return settled(Turns(data, options, std::move(start), context).run(true), data, options,
                 context);
}

Assimilation assimilate_from(const OdeModel& model, const Dataset& data,
                             const Assimilation& start, const AssimilationOptions& options,
                             const RunContext& context) {
  Assimilation begin = start;
  begin.model = model;
  begin.free = options.free;
  begin.measured.clear();
  for (const Trajectory& record : data.trajectories) begin.measured.push_back(record.states);
  return Turns(data, options, std::move(begin), context).run(false);
}

}  // namespace lacuna
