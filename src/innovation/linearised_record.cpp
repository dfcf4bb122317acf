// SPDX-License-Identifier: MIT
#include "lacuna/innovation/linearised_record.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "lacuna/core/error.hpp"
#include "lacuna/numerics/lagrange.hpp"

namespace lacuna {
namespace {

/// Parts of the joint state of a step: x, Phi (m x m), responses (m x 3m).
struct Layout {
  Index m;
  Index phi() const { return m; }
  Index response() const { return m + m * m; }
  Index size() const { return m + m * m + 3 * m * m; }
};

/// The parabolas through 0, 1/2, 1 that are 1 at one of them.
std::array<double, 3> parabolas(double s) {
  return {(1.0 - s) * (1.0 - 2.0 * s), 4.0 * s * (1.0 - s), s * (2.0 * s - 1.0)};
}

/// Integrates one step of the model with its variations.
class StepIntegrator {
 public:
  StepIntegrator(const OdeModel& model, const Trajectory& record, const Matrix& path,
                 const Vector& accuracy)
      : accuracy_(accuracy),
        above_(path.cols()),
        below_(path.cols()),
        model_(model.compile()),
        time_(record.time),
        values_(record.samples(), path.cols() + record.inputs.cols()),
        layout_{path.cols()},
        inputs_(record.inputs.cols()),
        jacobian_(path.cols(), path.cols()),
        all_(values_.cols()) {
    values_ << path, record.inputs;
    delayed_.resize(static_cast<std::size_t>(model_.delays().size()));
    for (Vector* part : {&start_, &stage_, &slope_, &sum_}) part->resize(layout_.size());
  }

  /// The joint state after step `i` of the record, taken in `parts` parts.
  const Vector& step(Index i, int parts, LagrangeInterpolant& signal) {
    start_.setZero();
    start_.head(layout_.m) = values_.row(i).head(layout_.m).transpose();
    for (Index k = 0; k < layout_.m; ++k) start_[layout_.phi() + k * layout_.m + k] = 1.0;
    const double h = time_[i + 1] - time_[i];
    for (int part = 0; part < parts; ++part) runge_kutta(i, h, part, parts, signal);
    return start_;
  }

  const Matrix& values() const { return values_; }

 private:
  void runge_kutta(Index i, double h, int part, int parts, LagrangeInterpolant& signal) {
    const double length = h / parts;
    length_ = length;
    const double from = static_cast<double>(part) / parts;
    constexpr std::array<double, 4> kNode{0.0, 0.5, 0.5, 1.0}, kWeight{1.0, 2.0, 2.0, 1.0};
    sum_.setZero();
    for (std::size_t stage = 0; stage < 4; ++stage) {
      stage_ = start_;
      if (stage > 0) stage_ += kNode[stage] * length * slope_;
      rate(i, h, from + kNode[stage] / parts, signal);
      sum_ += kWeight[stage] * slope_;
    }
    start_ += length / 6.0 * sum_;
  }

  /// slope_ = d/dt stage_ at the share `s` of step i.
  void rate(Index i, double h, double s, LagrangeInterpolant& signal) {
    const double t = time_[i] + s * h;
    read_inputs(i, t, signal);
    const Index m = layout_.m;
    model_.evaluate(t, stage_.data(), inputs_.data(), delayed_.data(), slope_.data());
    differentiate_rate(t);
    const Eigen::Map<const Matrix> variations(stage_.data() + layout_.phi(), m, 4 * m);
    Eigen::Map<Matrix> slopes(slope_.data() + layout_.phi(), m, 4 * m);
    slopes = jacobian_.lazyProduct(variations);
    const std::array<double, 3> bump = parabolas(s);
    for (Index k = 0; k < m; ++k)
      for (Index q = 0; q < 3; ++q)
        slopes(k, m + 3 * k + q) += bump[static_cast<std::size_t>(q)];
  }

  /// Slopes of the rate over the reach of one part of a step, or over the accuracy where that
  /// is more: where the model jumps (dry friction, stops) the derivative at a point says
  /// nothing of what a small deviation does.
  void differentiate_rate(double t) {
    for (Index k = 0; k < layout_.m; ++k) {
      const double reach = std::max(accuracy_[k], 0.5 * std::abs(slope_[k]) * length_);
      const double here = stage_[k];
      stage_[k] = here + reach;
      model_.evaluate(t, stage_.data(), inputs_.data(), delayed_.data(), above_.data());
      stage_[k] = here - reach;
      model_.evaluate(t, stage_.data(), inputs_.data(), delayed_.data(), below_.data());
      stage_[k] = here;
      jacobian_.col(k) = (above_ - below_) / (2.0 * reach);
    }
  }

  void read_inputs(Index i, double t, LagrangeInterpolant& signal) {
    if (inputs_.size() > 0) {
      signal.select(i);
      signal.evaluate(t, all_.data());
      inputs_ = all_.tail(inputs_.size());
    }
    for (std::size_t d = 0; d < delayed_.size(); ++d) {
      const DelayedVariable& delay = model_.delays()[d];
      const double past = std::max(t - delay.delay, time_[0]);
      signal.select(signal.interval_of(past));
      signal.evaluate(past, all_.data());
      delayed_[d] = delay.slot < values_.cols() ? all_[delay.slot] : t - delay.delay;
    }
  }

  const Vector& accuracy_;
  double length_ = 0.0;
  Vector above_, below_;
  CompiledModel model_;
  const Vector& time_;
  Matrix values_;
  Layout layout_;
  Vector inputs_, start_, stage_, slope_, sum_;
  Matrix jacobian_;
  Vector all_;
  std::vector<double> delayed_;
};

/// Whether halving the parts changes no step by more than a tenth of the accuracy; a sample
/// of the steps tells.
bool accurate(StepIntegrator& integrator, LagrangeInterpolant& signal, Index steps, int parts,
              const Vector& accuracy) {
  constexpr Index kTried = 400;
  const Index stride = std::max<Index>(1, steps / kTried);
  for (Index i = 0; i < steps; i += stride) {
    const Vector coarse = integrator.step(i, parts, signal).head(accuracy.size());
    const Vector fine = integrator.step(i, 2 * parts, signal).head(accuracy.size());
    if (!((coarse - fine).cwiseAbs().array() <= 0.1 * accuracy.array()).all()) return false;
  }
  return true;
}

int choose_parts(StepIntegrator& integrator, LagrangeInterpolant& signal, Index steps,
                 const Vector& accuracy) {
  constexpr int kMost = 32;
  int parts = 1;
  while (parts < kMost && !accurate(integrator, signal, steps, parts, accuracy)) parts *= 2;
  return parts;
}

/// Variables at samples and midpoints, then t.
Matrix fine_grid(const Vector& time, const Matrix& values, LagrangeInterpolant& signal) {
  const Index n = time.size();
  const Index width = values.cols();
  Matrix slots(2 * n - 1, width + 1);
  Vector middle(width);
  for (Index i = 0; i < n; ++i) {
    slots.row(2 * i) << values.row(i), time[i];
    if (i + 1 == n) break;
    const double t = 0.5 * (time[i] + time[i + 1]);
    signal.select(i);
    signal.evaluate(t, middle.data());
    slots.row(2 * i + 1) << middle.transpose(), t;
  }
  return slots;
}

void check(const OdeModel& model, const Trajectory& record, const Matrix& path) {
  if (path.rows() != record.samples() || path.cols() != model.dimension() ||
      record.inputs.cols() != static_cast<Index>(model.inputs().size()))
    throw ArgumentError("linearise", "path and record do not fit the model",
                        "give one column for each state and input");
  if (record.samples() < 4)
    throw ArgumentError("linearise", "the record has fewer than four samples",
                        "give a longer record");
}

}  // namespace

LinearisedRecord linearise(const OdeModel& model, const Trajectory& record, const Matrix& path,
                           const Vector& accuracy) {
  check(model, record, path);
  const Index m = path.cols();
  const Index steps = record.samples() - 1;
  StepIntegrator integrator(model, record, path, accuracy);
  LagrangeInterpolant signal(record.time, integrator.values(), LagrangeWindow::centred(4));
  const int parts = choose_parts(integrator, signal, steps, accuracy);
  LinearisedRecord result{record.time,
                          path,
                          fine_grid(record.time, integrator.values(), signal),
                          Matrix(m * m, steps),
                          Matrix(3 * m * m, steps),
                          Matrix(m, steps)};
  for (Index i = 0; i < steps; ++i) {
    const Vector& end = integrator.step(i, parts, signal);
    result.defect.col(i) = end.head(m) - path.row(i + 1).transpose();
    result.transition.col(i) = end.segment(m, m * m);
    result.response.col(i) = end.tail(3 * m * m);
  }
  return result;
}

LinearisedRecord part_of(const LinearisedRecord& record, Index first, Index count) {
  LinearisedRecord part{record.time.segment(first, count),
                        record.path.middleRows(first, count),
                        record.slots.middleRows(2 * first, 2 * count - 1),
                        record.transition.middleCols(first, count - 1),
                        record.response.middleCols(first, count - 1),
                        record.defect.middleCols(first, count - 1)};
  if (record.bridge.size() > 0) part.bridge = record.bridge.middleCols(first, count - 1);
  return part;
}

LinearisedRecord grid_of(const Trajectory& record, const Matrix& path) {
  Matrix values(record.samples(), path.cols() + record.inputs.cols());
  values << path, record.inputs;
  LagrangeInterpolant signal(record.time, values, LagrangeWindow::centred(4));
  return {record.time, path, fine_grid(record.time, values, signal), {}, {}, {}};
}

Matrix with_delays(const LinearisedRecord& record, const std::vector<DelayedVariable>& delays) {
  const Index width = record.slots.cols();
  Matrix result(record.slots.rows(), width + static_cast<Index>(delays.size()));
  result.leftCols(width) = record.slots;
  const Matrix values = record.slots(Eigen::seq(0, Eigen::last, 2), Eigen::all);
  LagrangeInterpolant signal(record.time, values, LagrangeWindow::centred(4));
  Vector past(width);
  for (std::size_t d = 0; d < delays.size(); ++d)
    for (Index i = 0; i < result.rows(); ++i) {
      const double t = std::max(record.slots(i, width - 1) - delays[d].delay, record.time[0]);
      signal.select(signal.interval_of(t));
      signal.evaluate(t, past.data());
      result(i, width + static_cast<Index>(d)) = past[delays[d].slot];
    }
  return result;
}

}  // namespace lacuna
