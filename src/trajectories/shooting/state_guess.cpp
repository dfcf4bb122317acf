// SPDX-License-Identifier: MIT
#include "state_guess.hpp"

#include <algorithm>
#include <cmath>

#include "core/numerics/least_squares.hpp"
#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

/// A divisor smaller than this fraction of its largest value says nothing about the quotient.
constexpr double kSmallDivisor = 1e-3;

struct LocalFit {
  double slope = 0.0;
  double squares = 0.0;  ///< of the residuals
  Index freedom = 0;     ///< samples less coefficients
};

/// The quadratic through samples first .. last in the least-squares sense, its slope at `at`.
LocalFit fit_quadratic(const Vector& time, const Eigen::Ref<const Vector>& values, Index first,
                       Index last, Index at) {
  const Index n = last - first + 1, terms = std::min<Index>(3, n);
  const double unit = time[last] - time[first];
  Matrix powers(n, terms);
  for (Index i = 0; i < n; ++i) {
    double power = 1.0;
    for (Index j = 0; j < terms; ++j, power *= (time[first + i] - time[at]) / unit)
      powers(i, j) = power;
  }
  const Vector y = values.segment(first, n);
  const Vector c = least_squares(powers, y);
  return {c[1] / unit, (y - powers * c).squaredNorm(), n - terms};
}

/// Begin and last sample of the trajectory that a sample belongs to.
std::pair<Index, Index> trajectory_of(const ShootingRecord& record, Index sample) {
  const auto next = std::upper_bound(record.begins.begin(), record.begins.end(), sample);
  return {*(next - 1), *next - 1};
}

LocalFit fit_around(const ShootingRecord& record, const Eigen::Ref<const Vector>& values,
                    Index sample, Index half_width) {
  const auto [begin, last] = trajectory_of(record, sample);
  return fit_quadratic(record.time, values, std::max(begin, sample - half_width),
                       std::min(last, sample + half_width), sample);
}

double residual_rms(const ShootingRecord& record, const Eigen::Ref<const Vector>& values,
                    Index half_width) {
  constexpr Index kCentres = 200;  // enough for a root mean square good to 5 %
  const Index stride = std::max<Index>(1, record.samples() / kCentres);
  double squares = 0.0;
  Index freedom = 0;
  for (Index i = 0; i < record.samples(); i += stride) {
    const LocalFit fit = fit_around(record, values, i, half_width);
    squares += fit.squares;
    freedom += fit.freedom;
  }
  return freedom > 0 ? std::sqrt(squares / static_cast<double>(freedom)) : 0.0;
}

/// Largest half width at which quadratics still fit to within the noise.
Index smoothing_width(const ShootingRecord& record, const Eigen::Ref<const Vector>& values,
                      double sigma) {
  Index width = 2;
  for (Index next = 3; next < record.samples() / 4; next += (next + 1) / 2) {
    if (residual_rms(record, values, next) > 1.2 * sigma) break;
    width = next;
  }
  return width;
}

/// Which states are known, and how a further one follows.
class Reconstruction {
 public:
  Reconstruction(const ParametrisedModel& model, const ShootingRecord& record)
      : model_(model.symbolic()) {
    for (const auto& row : record.rows) known_.push_back(row.has_value());
  }

  const std::vector<bool>& known() const noexcept { return known_; }
  void learn(std::size_t state) { known_[state] = true; }

  /// An equation that defines state j.
  std::optional<Index> defining(std::size_t j) const {
    for (std::size_t k = 0; k < known_.size(); ++k)
      if (known_[k] && defines(k, j)) return static_cast<Index>(k);
    return std::nullopt;
  }

 private:
  bool defines(std::size_t k, std::size_t j) const {
    bool present = false;
    for (const WeightedTerm& summand : model_.equations()[k]) {
      const auto names = summand.term.expression().variables();
      for (std::size_t i = 0; i < known_.size(); ++i)
        if (i != j && !known_[i] && names.contains(model_.states()[i].name)) return false;
      const std::string& name = model_.states()[j].name;
      if (!names.contains(name)) continue;
      if (summand.coefficient == 0.0) return false;
      present = true;
      if (differentiate(summand.term.expression(), name).variables().contains(name))
        return false;
    }
    return present;
  }

  const OdeModel& model_;
  std::vector<bool> known_;
};

/// f and df/dx at all samples.
struct SampledRates {
  Matrix f, jacobian;
};

SampledRates sample_rates(const Matrix& states, Rates& rates, const StageSignals& signals) {
  Matrix slots(states.rows(), rates.slots());
  slots.leftCols(rates.dimension()) = states;
  rates.fill_signals(signals.stages[0], slots);
  SampledRates result{
      Matrix(states.rows(), rates.dimension()),
      Matrix(states.rows(), static_cast<Index>(rates.jacobian_places().size()))};
  Matrix partials(states.rows(), static_cast<Index>(rates.column_places().size()));
  rates.rate(slots, result.f);
  rates.derivatives(slots, result.jacobian, partials);
  return result;
}

Vector jacobian_entry(Rates& rates, const SampledRates& sampled, Index k, Index j) {
  for (std::size_t i = 0; i < rates.jacobian_places().size(); ++i)
    if (rates.jacobian_places()[i].row == k && rates.jacobian_places()[i].column == j)
      return sampled.jacobian.col(static_cast<Index>(i));
  return Vector::Zero(sampled.f.rows());
}

/// Quotients; where the divisor is small, the one before.
Vector quotients(const Vector& numerator, const Vector& divisor) {
  const double smallest = kSmallDivisor * divisor.cwiseAbs().maxCoeff();
  Vector result(numerator.size());
  double last = 0.0;
  for (Index i = 0; i < result.size(); ++i) {
    const double q = numerator[i] / divisor[i];
    if (std::abs(divisor[i]) > smallest && std::isfinite(q)) last = q;
    result[i] = last;
  }
  return result;
}

}  // namespace

Vector smooth_derivative(const ShootingRecord& record, const Eigen::Ref<const Vector>& values,
                         double sigma) {
  const Index width = smoothing_width(record, values, sigma);
  Vector slopes(record.samples());
  for (Index i = 0; i < slopes.size(); ++i)
    slopes[i] = fit_around(record, values, i, width).slope;
  return slopes;
}

Matrix guess_states(const ParametrisedModel& model, const ShootingRecord& record, Rates& rates,
                    const StageSignals& signals, const Vector& sigma) {
  Matrix states = Matrix::Zero(record.samples(), rates.dimension());
  for (std::size_t q = 0; q < record.measured.size(); ++q)
    states.col(record.measured[q]) = record.values.col(static_cast<Index>(q));
  Reconstruction plan(model, record);
  const auto unknown = [&] {
    return std::count(plan.known().begin(), plan.known().end(), false);
  };
  for (auto left = unknown(); left > 0; left = unknown()) {
    for (std::size_t j = 0; j < plan.known().size(); ++j) {
      const std::optional<Index> k = plan.known()[j] ? std::nullopt : plan.defining(j);
      if (!k) continue;
      const SampledRates sampled = sample_rates(states, rates, signals);
      const auto row = record.rows[static_cast<std::size_t>(*k)];
      const Vector slope = smooth_derivative(record, states.col(*k), row ? sigma[*row] : 0.0);
      const auto state = static_cast<Index>(j);
      states.col(state) =
          quotients(slope - sampled.f.col(*k), jacobian_entry(rates, sampled, *k, state));
      plan.learn(j);
    }
    if (unknown() < left) continue;
    const auto lost = std::find(plan.known().begin(), plan.known().end(), false);
    const auto number = static_cast<std::size_t>(lost - plan.known().begin());
    throw DataError("record",
                    "state '" + model.symbolic().states()[number].name +
                        "' was not measured and no equation defines it",
                    "measure it, or write an equation of a measured state linear in it");
  }
  return states;
}

}  // namespace lacuna
