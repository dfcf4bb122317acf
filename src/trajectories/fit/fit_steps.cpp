// SPDX-License-Identifier: MIT
#include "fit_steps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dynamics/integration/butcher_tableau.hpp"

namespace lacuna {
namespace {

/// Errors of implicit steps, as fractions of the states: so far below the noise that the sum of
/// squares, which profiles compare, is exact to less than a hundredth. Ten times larger ones
/// are not (1 % of noise, 800 values), ten times smaller ones take nearly twice the time.
double tolerance_of(const FitEngine& engine) {
  constexpr double kOfNoise = 1e-5, kCoarsest = 1e-7;
  double least = kCoarsest / kOfNoise;
  for (Index c = 0; c < engine.count(); ++c) {
    const auto place = static_cast<std::size_t>(c);
    least = std::min(least, engine.sigma[c] / engine.records.channels[place].spread);
    if (const auto& law = engine.laws[place]; law && has_fraction(law->law().form))
      least = std::min(least, *law->sized().fraction);
  }
  return engine.implicit->relaxed * std::clamp(kOfNoise * least, RadauFlow::kTolerance, kCoarsest);
}

}  // namespace

FitPath empty_path(const FitEngine& engine) {
  const Index n = engine.records.samples(), m = engine.states();
  return {Matrix::Zero(n, m), engine.events ? Matrix(Matrix::Zero(n, m)) : Matrix(),
          Matrix::Zero(n, engine.count()),
          std::vector<Matrix>(engine.signals.stages.size(),
                              Matrix::Zero(engine.signals.lengths.size(), m)),
          0.0};
}

void fill_slots(const FitEngine& engine, Index step, const double* x,
                std::vector<double>& slots) {
  std::copy_n(x, engine.states(), slots.data());
  engine.rates.fill_signals(engine.signals.stages[0].data() + step,
                            engine.signals.lengths.size(), slots.data());
}

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

void advance_implicitly(FitEngine& engine, Index sample, Vector& x,
                        Matrix* sensitivity) {
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
  RadauFlow& flow = engine.implicit->flow;
  const bool arrives = engine.events && engine.events->has_guards()
                           ? advance_through_events(*engine.events, flow, engine.rates, drive,
                                                    {t0, t1}, x, sensitivity)
                           : flow.advance(engine.rates, drive, t0, t1, x, sensitivity);
  if (!arrives) x.setConstant(std::numeric_limits<double>::quiet_NaN());
}

void jump(FitEngine& engine, Index sample, Vector& x, Matrix* s) {
  if (!engine.events || engine.records.events.empty()) return;
  const auto& here = engine.records.events[static_cast<std::size_t>(sample)];
  if (here.empty()) return;
  std::vector<double> slots(static_cast<std::size_t>(engine.rates.slots()));
  fill_slots(engine, sample * engine.signals.scheme.substeps, x.data(), slots);
  for (const std::size_t event : here) engine.events->apply(event, slots.data(), s);
  std::copy_n(slots.begin(), x.size(), x.begin());
}

void arrive(FitEngine& engine, Index sample, Vector& x, FitPath& path) {
  if (path.arrivals.rows() > 0) path.arrivals.row(sample) = x.transpose();
  jump(engine, sample, x, nullptr);
}

void end_outside(FitEngine& engine, Index sample, Vector& x, RunScratch& scratch,
                 FitPath& path) {
  if (engine.domain.is_everything()) return;
  fill_slots(engine, sample * engine.signals.scheme.substeps, x.data(), scratch.slots);
  if (engine.domain.holds(scratch.slots.data(), engine.implicit ? tolerance_of(engine) : 0.0))
    return;
  x.setConstant(std::numeric_limits<double>::quiet_NaN());
  path.left_domain = true;
}

void begin_path(FitEngine& engine) {
  engine.domain.begin();
  if (engine.implicit) engine.implicit->flow.begin(tolerance_of(engine));
}

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

}  // namespace lacuna
