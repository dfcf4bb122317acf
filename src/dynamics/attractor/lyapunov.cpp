// SPDX-License-Identifier: MIT
#include "dynamics/attractor/lyapunov.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/check.hpp"
#include "core/numerics/qr.hpp"
#include "lacuna/core/numerics/interval.hpp"

namespace lacuna {
namespace {

constexpr Index kBlocks = 10;

void check(const OdeModel& model, CompiledModel& compiled, const Vector& x0,
           const LyapunovOptions& options) {
  if (compiled.inputs() > 0 || !compiled.delays().empty())
    throw ArgumentError("lyapunov_spectrum", "the model has inputs or delays",
                        "give an autonomous model");
  if (x0.size() != model.dimension())
    throw ArgumentError("lyapunov_spectrum", "the start does not have one entry per state", "");
  constexpr double kMostSteps = 9e15;  // a fact of doubles: more cannot be counted
  check_argument(x0.allFinite(), "lyapunov_spectrum", "the start is not finite");
  check_argument((options.transient + options.duration) / options.step < kMostSteps ||
                     !(options.step > 0.0),
                 "lyapunov_spectrum", "the steps are too many to be counted",
                 "use longer ones");
  if (!(options.step > 0.0) || !(options.transient >= 0.0) ||
      !(options.duration >= static_cast<double>(kBlocks) * options.step))
    throw ArgumentError("lyapunov_spectrum", "step and durations do not fit",
                        "follow the orbit for at least " + std::to_string(kBlocks) + " steps");
}

/// The state and, behind it, Q column by column.
class VariationalOrbit {
 public:
  VariationalOrbit(CompiledModel& model, const Integrator& integrator, const Vector& x0)
      : model_(model),
        m_(x0.size()),
        jacobian_(m_, m_),
        stepper_(integrator.make_stepper(m_ * (m_ + 1))),
        point_(m_ * (m_ + 1)) {
    point_.head(m_) = x0;
    directions() = Matrix::Identity(m_, m_);
  }

  /// One step; the logarithms of R's diagonal.
  Vector advance(double step) {
    const auto rhs = [this](double t, const double* x, double* rate) { slope(t, x, rate); };
    const double end = time_ + step;
    if (stepper_->advance(rhs, time_, end, point_.data()) != IntegrationStatus::Completed)
      throw ArgumentError("lyapunov_spectrum", "the orbit diverges",
                          "start on the attractor, or use a smaller step");
    const Qr qr(directions());
    directions() = qr.basis();
    const Vector logs = qr.triangle().diagonal().cwiseAbs().array().log();
    check_argument(logs.allFinite(), "lyapunov_spectrum",
                   "the directions become zero or infinite", "use a smaller step");
    return logs;
  }

 private:
  Eigen::Map<Matrix> directions() { return {point_.data() + m_, m_, m_}; }

  void slope(double t, const double* x, double* rate) {
    model_.evaluate(t, x, nullptr, nullptr, rate);
    model_.jacobian(t, x, nullptr, nullptr, jacobian_);
    Eigen::Map<Matrix>(rate + m_, m_, m_).noalias() =
        jacobian_ * Eigen::Map<const Matrix>(x + m_, m_, m_);
  }

  CompiledModel& model_;
  Index m_;
  Matrix jacobian_;
  std::unique_ptr<Stepper> stepper_;
  Vector point_;
  double time_ = 0.0;
};

/// Exponents of each block, one block per row.
Matrix block_exponents(VariationalOrbit& orbit, Index m, const LyapunovOptions& options) {
  const Index before = std::llround(options.transient / options.step);
  const Index length =
      std::llround(options.duration / options.step / static_cast<double>(kBlocks));
  for (Index i = 0; i < before; ++i) orbit.advance(options.step);
  Matrix sums = Matrix::Zero(kBlocks, m);
  for (Index b = 0; b < kBlocks; ++b)
    for (Index i = 0; i < length; ++i) sums.row(b) += orbit.advance(options.step).transpose();
  return sums / (static_cast<double>(length) * options.step);
}

}  // namespace

LyapunovSpectrum lyapunov_spectrum(const OdeModel& model, const Integrator& integrator,
                                   const Vector& x0, const LyapunovOptions& options) {
  CompiledModel compiled = model.compile();
  check(model, compiled, x0, options);
  VariationalOrbit orbit(compiled, integrator, x0);
  const Matrix blocks = block_exponents(orbit, x0.size(), options);
  const double count = static_cast<double>(kBlocks);
  LyapunovSpectrum spectrum;
  spectrum.exponents = blocks.colwise().mean().transpose();
  const Matrix off = blocks.rowwise() - spectrum.exponents.transpose();
  spectrum.half_width = student_quantile_975(count - 1.0) *
                        (off.colwise().squaredNorm() / (count * (count - 1.0))).cwiseSqrt();
  spectrum.dimension = kaplan_yorke_dimension(spectrum.exponents);
  return spectrum;
}

double kaplan_yorke_dimension(const Vector& exponents) {
  check_argument(exponents.allFinite(), "kaplan_yorke_dimension", "an exponent is not finite");
  double sum = 0.0;
  for (Index j = 0; j < exponents.size(); ++j) {
    if (sum + exponents[j] < 0.0) return static_cast<double>(j) + sum / std::abs(exponents[j]);
    sum += exponents[j];
  }
  return static_cast<double>(exponents.size());
}

}  // namespace lacuna
