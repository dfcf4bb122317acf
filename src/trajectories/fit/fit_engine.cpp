// SPDX-License-Identifier: MIT
#include "fit_engine.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lacuna/dynamics/integration/butcher_tableau.hpp"

namespace lacuna {
namespace {

std::vector<Expression> formulas_of(const FitRecords& records) {
  std::vector<Expression> formulas;
  for (const FitChannel& channel : records.channels) formulas.push_back(channel.formula);
  return formulas;
}

/// A point of Rates at the begin of a step.
void fill_slots(const FitEngine& engine, Index step, const double* x,
                std::vector<double>& slots) {
  std::copy_n(x, engine.states(), slots.data());
  engine.rates.fill_signals(engine.signals.stages[0].data() + step,
                            engine.signals.lengths.size(), slots.data());
}

/// Working memory of one pass along a record.
struct RunScratch {
  explicit RunScratch(const FitEngine& engine)
      : slots(static_cast<std::size_t>(engine.rates.slots())),
        slopes(engine.states(), engine.signals.scheme.tableau->stages()),
        model(engine.count()) {}
  std::vector<double> slots;
  Matrix slopes;
  Vector model;
};

/// Residuals at a sample; 0 where there is no value.
void compare(FitEngine& engine, Index sample, const Vector& x, RunScratch& scratch,
             Matrix& residuals) {
  fill_slots(engine, sample * engine.signals.scheme.substeps, x.data(), scratch.slots);
  engine.channels.values(scratch.slots.data(), scratch.model.data());
  for (Index c = 0; c < engine.count(); ++c)
    residuals(sample, c) = engine.records.valid(sample, c) > 0.0
                               ? engine.records.values(sample, c) - scratch.model[c]
                               : 0.0;
}

void correct(const Gains& gains, Index sample, const Matrix& residuals, Vector& x) {
  if (gains.size() == 0) return;
  for (Index c = 0; c < residuals.cols(); ++c)
    for (Index k = 0; k < x.size(); ++k)
      x[k] += gains(sample, c * x.size() + k) * residuals(sample, c);
}

/// Goes to the next sample by implicit steps; x is not a number where there are none.
/// @param sensitivity as of RadauFlow::advance().
void advance_implicitly(FitEngine& engine, Index sample, Vector& x,
                        Matrix* sensitivity = nullptr) {
  const std::vector<Index>& begins = engine.records.series.begins;
  const auto record =
      std::upper_bound(begins.begin(), begins.end(), sample) - begins.begin() - 1;
  const auto r = static_cast<std::size_t>(record);
  DrivingSignals& driving = engine.implicit->signals[r];
  const Index i = sample - begins[r];
  const double t0 = driving.time()[i], t1 = driving.time()[i + 1];
  std::vector<double> signals(static_cast<std::size_t>(driving.size()));
  const auto drive = [&](double t, double* slots) {
    driving.at({i, t0, t1 - t0}, (t - t0) / (t1 - t0), signals.data());
    engine.rates.fill_signals(signals.data(), 1, slots);
  };
  if (!engine.implicit->flow.advance(engine.rates, drive, t0, t1, x, sensitivity))
    x.setConstant(std::numeric_limits<double>::quiet_NaN());
}

/// Errors of implicit steps, as fractions of the states: so far below the noise that the sum of
/// squares, which profiles compare, is exact to less than a hundredth. Ten times larger ones
/// are not (1 % of noise, 800 values), ten times smaller ones take nearly twice the time.
double tolerance_of(const FitEngine& engine) {
  constexpr double kOfNoise = 1e-5, kCoarsest = 1e-7;
  double least = kCoarsest / kOfNoise;
  for (Index c = 0; c < engine.count(); ++c)
    least = std::min(
        least, engine.sigma[c] / engine.records.channels[static_cast<std::size_t>(c)].spread);
  return std::clamp(kOfNoise * least, RadauFlow::kTolerance, kCoarsest);
}

/// A path begins: what implicit steps know of another one must not decide on its steps.
void begin_path(FitEngine& engine) {
  if (engine.implicit) engine.implicit->flow.begin(tolerance_of(engine));
}

/// Goes to the next sample, keeping the states of all stages.
void advance(FitEngine& engine, Index sample, Vector& x, RunScratch& scratch,
             std::vector<Matrix>& stages) {
  if (engine.implicit) return advance_implicitly(engine, sample, x);
  const ButcherTableau& tableau = *engine.signals.scheme.tableau;
  const Index substeps = engine.signals.scheme.substeps, steps = engine.signals.lengths.size();
  for (Index step = sample * substeps; step < (sample + 1) * substeps; ++step) {
    const double h = engine.signals.lengths[step];
    for (Index a = 0; a < tableau.stages(); ++a) {
      const auto stage = static_cast<std::size_t>(a);
      Eigen::Map<Vector> moved(scratch.slots.data(), x.size());
      moved = x;
      for (Index d = 0; d < a; ++d)
        if (const double weight = tableau.a[stage][static_cast<std::size_t>(d)]; weight != 0.0)
          moved += h * weight * scratch.slopes.col(d);
      stages[stage].row(step) = moved.transpose();
      engine.rates.fill_signals(engine.signals.stages[stage].data() + step, steps,
                                scratch.slots.data());
      engine.rates.rate(scratch.slots.data(), scratch.slopes.col(a).data());
    }
    for (Index a = 0; a < tableau.stages(); ++a)
      x += h * tableau.weights[static_cast<std::size_t>(a)] * scratch.slopes.col(a);
  }
}

FitPath empty_path(const FitEngine& engine) {
  const Index n = engine.records.samples(), m = engine.states();
  return {Matrix::Zero(n, m), Matrix::Zero(n, engine.count()),
          std::vector<Matrix>(engine.signals.stages.size(),
                              Matrix::Zero(engine.signals.lengths.size(), m)),
          0.0};
}

double cost_of(const FitEngine& engine, const FitPath& path) {
  const double cost = (path.residuals * engine.sigma.cwiseInverse().asDiagonal()).squaredNorm();
  const bool finite = path.states.allFinite() && std::isfinite(cost);
  return finite ? cost : std::numeric_limits<double>::infinity();
}

/// Goes to the next sample; gives Phi of the sampling interval.
Matrix advance_with_transition(FitEngine& engine, Index sample, Vector& x, RunScratch& scratch,
                               StepMaps& maps, FitPath& path) {
  const Index m = engine.states(), substeps = engine.signals.scheme.substeps;
  Matrix whole = Matrix::Identity(m, m);
  if (engine.implicit) {
    advance_implicitly(engine, sample, x, &whole);
    return whole;
  }
  advance(engine, sample, x, scratch, path.stages);
  for (Index done = 0; done < substeps; done += StepMaps::kBlock) {
    const Index count = std::min(StepMaps::kBlock, substeps - done);
    maps.evaluate(engine.rates, engine.signals, path.stages, sample * substeps + done, count);
    for (Index i = 0; i < count; ++i) {
      const Vector entries = maps.transitions().row(i).transpose();
      whole = (Eigen::Map<const Matrix>(entries.data(), m, m) * whole).eval();
    }
  }
  return whole;
}

/// One sample taken into the covariance of a filter; gives the gain, m x c. A channel that is
/// more exact than the rounding of the covariance leaves is taken for no better than that.
Matrix take_in(const FitEngine& engine, Index sample, const Matrix& by_state,
               Matrix& covariance) {
  constexpr double kExact = 1e-10;  // of a variance: its rounding makes 1e-6 of a gain then
  Matrix gain = Matrix::Zero(engine.states(), engine.count());
  Vector noise = engine.sigma.cwiseAbs2();
  for (Index c = 0; c < engine.count(); ++c) {
    if (engine.records.valid(sample, c) == 0.0) continue;
    const Vector towards = covariance * by_state.row(c).transpose();
    const double known = by_state.row(c).dot(towards);
    noise[c] = std::max(noise[c], kExact * known);
    covariance -= towards * towards.transpose() / (known + noise[c]);
  }
  for (Index c = 0; c < engine.count(); ++c)
    if (engine.records.valid(sample, c) > 0.0)
      gain.col(c) = covariance * by_state.row(c).transpose() / noise[c];
  return gain;
}

}  // namespace

FitEngine fit_engine(const ParametrisedModel& model, FitRecords records) {
  Rates rates(model);
  Channels channels(model, formulas_of(records));
  StageSignals signals = stage_signals(records.series, rates, {&runge_kutta_4(), 1});
  Vector sigma(channels.count());
  for (Index c = 0; c < sigma.size(); ++c) {
    const FitChannel& channel = records.channels[static_cast<std::size_t>(c)];
    sigma[c] = std::max(channel.noise, 1e-3 * channel.spread);
    if (!(sigma[c] > 0.0)) sigma[c] = 1.0;
  }
  return {model,
          std::move(records),
          std::move(rates),
          std::move(channels),
          std::move(signals),
          std::move(sigma)};
}

void set_substeps(FitEngine& engine, Index substeps) {
  if (engine.signals.scheme.substeps != substeps)
    engine.signals =
        stage_signals(engine.records.series, engine.rates, {&runge_kutta_4(), substeps});
}

FitPath follow(FitEngine& engine, const FitPoint& point, const Gains& gains) {
  FitPath path = empty_path(engine);
  RunScratch scratch(engine);
  for (Index r = 0; r < engine.records.records(); ++r) {
    engine.rates.set(point.parameters.row(r).transpose());
    Vector x = point.starts.row(r).transpose();
    begin_path(engine);
    for (Index n = engine.records.first(r); n < engine.records.end(r); ++n) {
      path.states.row(n) = x.transpose();
      compare(engine, n, x, scratch, path.residuals);
      correct(gains, n, path.residuals, x);
      if (n + 1 < engine.records.end(r)) advance(engine, n, x, scratch, path.stages);
    }
  }
  path.cost = cost_of(engine, path);
  return path;
}

namespace {

/// Carries derivatives of the state from sample to sample of a record.
class SensitivityPass {
 public:
  SensitivityPass(FitEngine& engine, const FitPath& path, const Gains& gains, Index record)
      : engine_(engine),
        path_(path),
        gains_(gains),
        first_(engine.records.first(record)),
        end_(engine.records.end(record)),
        maps_(engine.rates, engine.signals.scheme) {
    begin_path(engine);
  }

  /// From sample n behind its correction to the next one.
  void carry(Index n, Matrix& s) {
    if (engine_.implicit) {
      Vector x = path_.states.row(n).transpose();
      correct(gains_, n, path_.residuals, x);
      return advance_implicitly(engine_, n, x, &s);
    }
    const Index m = engine_.states(), substeps = engine_.signals.scheme.substeps;
    const Index steps = (end_ - 1 - first_) * substeps;
    for (Index i = 0; i < substeps; ++i) {
      const Index step = (n - first_) * substeps + i, row = step % StepMaps::kBlock;
      if (row == 0)
        maps_.evaluate(engine_.rates, engine_.signals, path_.stages, first_ * substeps + step,
                       std::min(StepMaps::kBlock, steps - step));
      const Vector entries = maps_.transitions().row(row).transpose();
      s = (Eigen::Map<const Matrix>(entries.data(), m, m) * s).eval();
      for (Index j = 0; j < engine_.parameters(); ++j)
        for (Index k = 0; k < m; ++k) s(k, m + j) += maps_.responses()(row, j * m + k);
    }
  }

 private:
  FitEngine& engine_;
  const FitPath& path_;
  const Gains& gains_;
  Index first_, end_;
  StepMaps maps_;
};

}  // namespace

void sensitivities(FitEngine& engine, const FitPoint& point, const FitPath& path,
                   const Gains& gains, Index record,
                   FunctionRef<void(Index, const Matrix&, const Vector&)> visit) {
  const Index m = engine.states(), p = engine.parameters(), count = engine.count();
  const Index first = engine.records.first(record), end = engine.records.end(record);
  engine.rates.set(point.parameters.row(record).transpose());
  RunScratch scratch(engine);
  SensitivityPass pass(engine, path, gains, record);
  Matrix s = Matrix::Zero(m, m + p), rows(count, m + p), by_state(count, m),
         by_parameter(count, p);
  s.leftCols(m).setIdentity();
  for (Index n = first; n < end; ++n) {
    const Vector x = path.states.row(n).transpose();
    fill_slots(engine, n * engine.signals.scheme.substeps, x.data(), scratch.slots);
    engine.channels.derivatives(scratch.slots.data(), by_state, by_parameter);
    rows.noalias() = by_state * s;
    rows.rightCols(p) += by_parameter;
    for (Index c = 0; c < count; ++c) {
      if (engine.records.valid(n, c) == 0.0) rows.row(c).setZero();
      if (gains.size() > 0) {
        const Vector gain = gains.row(n).segment(c * m, m).transpose();
        s.noalias() -= gain * rows.row(c);
      }
    }
    const Vector scale = engine.sigma.cwiseInverse();
    rows = scale.asDiagonal() * rows;
    const Vector residual = scale.cwiseProduct(path.residuals.row(n).transpose());
    visit(n, rows, residual);
    if (n + 1 < end) pass.carry(n, s);
  }
}

namespace {

/// Whether the finest explicit steps are unstable somewhere along a path.
bool is_stiff(FitEngine& engine, const FitPoint& point, const FitPath& path) {
  const Index m = engine.states(), substeps = engine.signals.scheme.substeps;
  const std::vector<MatrixPlace>& places = engine.rates.jacobian_places();
  Matrix slots(1, engine.rates.slots()), entries(1, static_cast<Index>(places.size()));
  Matrix columns(1, static_cast<Index>(engine.rates.column_places().size()));
  std::vector<double> slot(static_cast<std::size_t>(engine.rates.slots()));
  for (Index r = 0; r < engine.records.records(); ++r) {
    engine.rates.set(point.parameters.row(r).transpose());
    for (Index n = engine.records.first(r); n + 1 < engine.records.end(r); ++n) {
      const Vector x = path.states.row(n).transpose();
      if (!x.allFinite()) return true;
      fill_slots(engine, n * substeps, x.data(), slot);
      slots = Eigen::Map<const Matrix>(slot.data(), 1, slots.cols());
      engine.rates.derivatives(slots, entries, columns);
      Matrix jacobian = Matrix::Zero(m, m);
      for (std::size_t i = 0; i < places.size(); ++i)
        jacobian(places[i].row, places[i].column) += entries(0, static_cast<Index>(i));
      const double h = static_cast<double>(substeps) * engine.signals.lengths[n * substeps];
      if (is_beyond_explicit_steps(jacobian, h / static_cast<double>(kMostSubsteps)))
        return true;
    }
  }
  return false;
}

}  // namespace

void choose_method(FitEngine& engine, const FitPoint& point) {
  if (engine.implicit || !is_stiff(engine, point, follow(engine, point, {}))) return;
  engine.implicit.emplace();
  for (const DrivingSamples& samples : driving_samples(engine.records.series, engine.rates))
    engine.implicit->signals.emplace_back(samples);
  const FitPath path = follow(engine, point, {});
  if (!std::isfinite(path.cost) || !is_stiff(engine, point, path)) engine.implicit.reset();
}

Gains filter_gains(FitEngine& engine, const FitPoint& point, const Disturbances& disturbances,
                   FitPath& path) {
  const Index m = engine.states(), count = engine.count();
  path = empty_path(engine);
  Gains gains = Gains::Zero(engine.records.samples(), m * count);
  RunScratch scratch(engine);
  StepMaps maps(engine.rates, engine.signals.scheme);
  Matrix by_state(count, m), by_parameter(count, engine.parameters());
  const Vector density =
      (disturbances.fraction * disturbances.scale).array().square() / engine.records.time_scale;
  for (Index r = 0; r < engine.records.records(); ++r) {
    engine.rates.set(point.parameters.row(r).transpose());
    Vector x = point.starts.row(r).transpose();
    begin_path(engine);
    Matrix covariance = Matrix::Zero(m, m);
    for (Index n = engine.records.first(r); n < engine.records.end(r); ++n) {
      path.states.row(n) = x.transpose();
      compare(engine, n, x, scratch, path.residuals);
      engine.channels.derivatives(scratch.slots.data(), by_state, by_parameter);
      const Matrix gain = take_in(engine, n, by_state, covariance);
      gains.row(n) = Eigen::Map<const Vector>(gain.data(), gain.size()).transpose();
      correct(gains, n, path.residuals, x);
      if (n + 1 == engine.records.end(r)) break;
      const Matrix phi = advance_with_transition(engine, n, x, scratch, maps, path);
      const double h = engine.records.series.time[n + 1] - engine.records.series.time[n];
      covariance = (phi * covariance * phi.transpose()).eval();
      covariance.diagonal() += h * density;
    }
  }
  path.cost = cost_of(engine, path);
  return gains;
}

Matrix prediction_errors(FitEngine& engine, const FitPoint& point, const Gains& gains,
                         Index ahead, Vector& compared) {
  FitPath filtered = follow(engine, point, gains), free = empty_path(engine);
  Matrix errors = Matrix::Zero(engine.records.samples(), engine.count());
  compared = Vector::Zero(engine.count());
  RunScratch scratch(engine);
  for (Index r = 0; r < engine.records.records(); ++r) {
    engine.rates.set(point.parameters.row(r).transpose());
    const Index end = engine.records.end(r);
    for (Index from = engine.records.first(r); from + ahead < end; from += ahead) {
      Vector x = filtered.states.row(from).transpose();
      correct(gains, from, filtered.residuals, x);
      begin_path(engine);
      for (Index n = from; n < from + ahead; ++n) advance(engine, n, x, scratch, free.stages);
      compare(engine, from + ahead, x, scratch, errors);
      compared += engine.records.valid.row(from + ahead).transpose();
    }
  }
  return errors;
}

}  // namespace lacuna
