// SPDX-License-Identifier: MIT
#include "fit_engine.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "dynamics/integration/butcher_tableau.hpp"
#include "fit_steps.hpp"

namespace lacuna {
namespace {

std::vector<Expression> formulas_of(const FitRecords& records) {
  std::vector<Expression> formulas;
  for (const FitChannel& channel : records.channels) formulas.push_back(channel.formula);
  return formulas;
}

/// -2 log-likelihood of a channel with a law, less what depends on the measured values alone.
double loss_of(const FitEngine& engine, const FitPath& path, Index channel) {
  const ChannelNoise& law = *engine.laws[static_cast<std::size_t>(channel)];
  double loss = 0.0;
  for (Index n = 0; n < path.residuals.rows(); ++n) {
    if (engine.records.valid(n, channel) == 0.0) continue;
    const double value = engine.records.values(n, channel);
    loss += law.score(value, value - path.residuals(n, channel)).loss - law.offset(value);
  }
  return loss;
}

double cost_of(const FitEngine& engine, const FitPath& path) {
  double cost = 0.0;
  for (Index c = 0; c < engine.count(); ++c) {
    if (engine.laws[static_cast<std::size_t>(c)]) {
      cost += loss_of(engine, path, c);
    } else if (engine.records.deviations.size() == 0) {
      cost += (path.residuals.col(c) / engine.sigma[c]).squaredNorm();
    } else {
      for (Index n = 0; n < path.residuals.rows(); ++n)
        cost += std::pow(path.residuals(n, c) / deviation_of(engine, n, c), 2);
    }
  }
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
Matrix take_in(const FitEngine& engine, Index sample, const Matrix& residuals,
               const Matrix& by_state, Matrix& covariance) {
  constexpr double kExact = 1e-10;  // of a variance: its rounding makes 1e-6 of a gain then
  Matrix gain = Matrix::Zero(engine.states(), engine.count());
  Vector noise = engine.sigma.cwiseAbs2();
  for (Index c = 0; c < engine.count(); ++c) {
    if (!is_value(engine, sample, c)) continue;
    noise[c] = std::pow(deviation_of(engine, sample, c), 2);
    if (const auto& law = engine.laws[static_cast<std::size_t>(c)])
      noise[c] = std::pow(
          law->deviation(engine.records.values(sample, c) - residuals(sample, c)), 2);
    const Vector towards = covariance * by_state.row(c).transpose();
    const double known = by_state.row(c).dot(towards);
    noise[c] = std::max(noise[c], kExact * known);
    covariance -= towards * towards.transpose() / (known + noise[c]);
  }
  for (Index c = 0; c < engine.count(); ++c)
    if (is_value(engine, sample, c))
      gain.col(c) = covariance * by_state.row(c).transpose() / noise[c];
  return gain;
}

}  // namespace

void take_implicit_steps(FitEngine& engine) {
  engine.implicit.emplace();
  for (const DrivingSamples& samples : driving_samples(engine.records.series, engine.rates))
    engine.implicit->signals.emplace_back(samples);
}

FitEngine fit_engine(const ParametrisedModel& model, FitRecords records) {
  Rates rates(model, Outside::AsAtTheEdge);
  const std::vector<Expression> formulas = formulas_of(records);
  Channels channels(model, formulas, Outside::AsAtTheEdge);
  StageSignals signals = stage_signals(records.series, rates, {&runge_kutta_4(), 1});
  Vector sigma(channels.count());
  for (Index c = 0; c < sigma.size(); ++c) {
    const FitChannel& channel = records.channels[static_cast<std::size_t>(c)];
    sigma[c] = std::max(channel.noise, 1e-3 * channel.spread);
    if (!(sigma[c] > 0.0)) sigma[c] = 1.0;
  }
  FitEngine engine{model,
                   std::move(records),
                   std::move(rates),
                   std::move(channels),
                   FitDomain(model, formulas),
                   std::move(signals),
                   std::move(sigma)};
  for (Index c = 0; c < engine.count(); ++c) {
    const auto& law = engine.records.channels[static_cast<std::size_t>(c)].law;
    const Vector values =
        engine.records.values.col(c).cwiseProduct(engine.records.valid.col(c));
    engine.laws.push_back(law ? std::optional(ChannelNoise(*law, engine.sigma[c], values))
                              : std::nullopt);
  }
  if (!model.symbolic().events().empty()) engine.events.emplace(model);
  if (engine.events && engine.events->has_guards()) take_implicit_steps(engine);
  return engine;
}

double deviation_of(const FitEngine& engine, Index sample, Index channel) {
  const Matrix& known = engine.records.deviations;
  const double own = known.size() > 0 ? known(sample, channel) : 0.0;
  return own > 0.0 ? own : engine.sigma[channel];
}

bool is_value(const FitEngine& engine, Index sample, Index channel) {
  if (engine.records.valid(sample, channel) == 0.0) return false;
  const auto& law = engine.laws[static_cast<std::size_t>(channel)];
  return !law || law->censoring(engine.records.values(sample, channel)) == Censoring::None;
}

Matrix whitened(const FitEngine& engine, const FitPath& path) {
  Matrix all = path.residuals;
  for (Index c = 0; c < engine.count(); ++c)
    for (Index n = 0; n < all.rows(); ++n) {
      const auto& law = engine.laws[static_cast<std::size_t>(c)];
      const double value = engine.records.values(n, c);
      if (!law)
        all(n, c) /= deviation_of(engine, n, c);
      else if (engine.records.valid(n, c) > 0.0)
        all(n, c) = law->pearson(value, value - path.residuals(n, c));
    }
  return all;
}

void set_substeps(FitEngine& engine, Index substeps) {
  if (engine.signals.scheme.substeps != substeps)
    engine.signals =
        stage_signals(engine.records.series, engine.rates, {&runge_kutta_4(), substeps});
}

void follow_record(FitEngine& engine, const FitPoint& point, const Gains& gains, Index record,
                   FitPath& path) {
  RunScratch scratch(engine);
  engine.rates.set(point.parameters.row(record).transpose());
  Vector x = point.starts.row(record).transpose();
  begin_path(engine);
  const Index end = engine.records.end(record);
  for (Index n = engine.records.first(record); n < end; ++n) {
    arrive(engine, n, x, path);
    if (gains.size() == 0) end_outside(engine, n, x, scratch, path);
    path.states.row(n) = x.transpose();
    compare(engine, n, x, scratch, path.residuals);
    correct(gains, n, path.residuals, x);
    if (n + 1 < end) advance(engine, n, x, scratch, path.stages);
  }
}

FitPath follow(FitEngine& engine, const FitPoint& point, const Gains& gains) {
  FitPath path = empty_path(engine);
  for (Index r = 0; r < engine.records.records(); ++r)
    follow_record(engine, point, gains, r, path);
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

namespace {

/// What rows of a channel are multiplied by, and its residual, at a sample.
NoiseScore scale_of(const FitEngine& engine, Index n, Index c, double residual,
                    Whitening whitening) {
  const auto& law = engine.laws[static_cast<std::size_t>(c)];
  const double sigma = deviation_of(engine, n, c);
  if (!law) return {0.0, 1.0 / sigma, residual / sigma};
  if (engine.records.valid(n, c) == 0.0) return {};
  const double value = engine.records.values(n, c), y = value - residual;
  if (whitening == Whitening::Likelihood) return law->score(value, y);
  if (!is_value(engine, n, c)) return {};
  return {0.0, law->pearson_weight(y), law->pearson(value, y)};
}

}  // namespace

void sensitivities(FitEngine& engine, const FitPoint& point, const FitPath& path,
                   const Gains& gains, Index record,
                   FunctionRef<void(Index, const Matrix&, const Vector&)> visit,
                   Whitening whitening) {
  const Index m = engine.states(), p = engine.parameters(), count = engine.count();
  const Index first = engine.records.first(record), end = engine.records.end(record);
  engine.rates.set(point.parameters.row(record).transpose());
  RunScratch scratch(engine);
  SensitivityPass pass(engine, path, gains, record);
  Matrix s = Matrix::Zero(m, m + p), rows(count, m + p), by_state(count, m),
         by_parameter(count, p);
  const std::vector<bool>& fixed = engine.records.fixed;
  for (Index k = 0; k < m; ++k)
    if (fixed.empty() || !fixed[static_cast<std::size_t>(k)]) s(k, k) = 1.0;
  for (Index n = first; n < end; ++n) {
    if (path.arrivals.rows() > 0) {
      Vector arriving = path.arrivals.row(n).transpose();
      jump(engine, n, arriving, &s);
    }
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
    Vector residual(count);
    for (Index c = 0; c < count; ++c) {
      const NoiseScore scale = scale_of(engine, n, c, path.residuals(n, c), whitening);
      rows.row(c) *= scale.weight;
      residual[c] = scale.residual;
    }
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
  if (engine.implicit) return;
  const FitPath before = follow(engine, point, {});
  if (!is_stiff(engine, point, before)) return;
  take_implicit_steps(engine);
  const FitPath path = follow(engine, point, {});
  if (!std::isfinite(path.cost) || !(before.left_domain || is_stiff(engine, point, path)))
    engine.implicit.reset();
}

bool leave_implicit_steps(FitEngine& engine, const FitPoint& point) {
  if (!engine.implicit || (engine.events && engine.events->has_guards())) return false;
  engine.implicit.reset();
  set_substeps(engine, kMostSubsteps);
  const FitPath path = follow(engine, point, {});
  const bool leaves = std::isfinite(path.cost) && !is_stiff(engine, point, path);
  if (leaves)
    set_substeps(engine, 1);
  else
    take_implicit_steps(engine);
  return leaves;
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
      Matrix jumped = Matrix::Identity(m, m);
      Vector arriving = x;
      jump(engine, n, arriving, &jumped);
      covariance = (jumped * covariance * jumped.transpose()).eval();
      arrive(engine, n, x, path);
      path.states.row(n) = x.transpose();
      compare(engine, n, x, scratch, path.residuals);
      engine.channels.derivatives(scratch.slots.data(), by_state, by_parameter);
      const Matrix gain = take_in(engine, n, path.residuals, by_state, covariance);
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
      for (Index n = from; n < from + ahead; ++n) {
        advance(engine, n, x, scratch, free.stages);
        jump(engine, n + 1, x, nullptr);
      }
      compare(engine, from + ahead, x, scratch, errors);
      compared += engine.records.valid.row(from + ahead).transpose();
    }
  }
  return errors;
}

}  // namespace lacuna
