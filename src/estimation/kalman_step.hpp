// SPDX-License-Identifier: MIT
// The recursion of the filter, one sample at a time; what it leaves behind is the caller's.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "censoring.hpp"
#include "lacuna/data/marks.hpp"
#include "lacuna/estimation/noise_model.hpp"
#include "lacuna/flow/fixed_size.hpp"
#include "lacuna/flow/linearised_record.hpp"

namespace lacuna {

/// Which states are measured and where their coloured noise sits.
struct ChannelMap {
  Index size = 0;  ///< N
  std::vector<Index> state;
  std::vector<Index> colour;  ///< N where there is none
  std::vector<double> decay;  ///< of colour states, in one mean step

  ChannelMap(const LinearisedRecord& record, const NoiseModel& noise);
  Index channels() const { return static_cast<Index>(state.size()); }
};

/// Variances of a noise model in the order of a channel map.
struct Variances {
  Vector white;        ///< per channel
  Vector colour;       ///< per colour state
  Vector disturbance;  ///< spectral density per equation
  Vector start;        ///< N: of the deviation before the first sample

  Variances(const LinearisedRecord& record, const NoiseModel& noise, const ChannelMap& map);
};

/// One scalar measurement as the filter saw it.
struct Innovation {
  double value = 0.0;     ///< nu
  double variance = 0.0;  ///< S; infinite where it says nothing
  double deviance = 0.0;  ///< what it adds to -2 log likelihood, beside log(scale)
  double scale = 1.0;
  /// d deviance / d variance of the white noise where the sample is at an end of its channel.
  double slope = 0.0;
};

/// Sum of what innovations add to -2 log likelihood. The logarithm is that of their product: of
/// each one alone it would cost as much as a small matrix.
class DevianceSum {
 public:
  void add(const Innovation& one) {
    sum_ += one.deviance;
    if (!is_moderate(product_ * one.scale)) {
      sum_ += std::log(product_);
      product_ = 1.0;
    }
    if (is_moderate(one.scale))
      product_ *= one.scale;
    else
      sum_ += std::log(one.scale);
  }

  double value() const { return sum_ + std::log(product_); }

 private:
  static bool is_moderate(double x) { return x > 1e-100 && x < 1e100; }

  double sum_ = 0.0, product_ = 1.0;
};

/// Response at the end of step i to a constant rate in an equation: w0 + w1 + w2.
inline void constant_response(const LinearisedRecord& record, Index i, Index equation,
                              double* out) {
  const Index m = record.states();
  const double* w = record.response.col(i).data() + 3 * m * equation;
  for (Index j = 0; j < m; ++j) out[j] = w[j] + w[m + j] + w[2 * m + j];
}

/// Spectral density of the disturbance of an equation in step i: `density`, or that of the
/// bridge where it is larger.
inline double density_in(const LinearisedRecord& record, Index i, Index equation,
                         double density) {
  return record.is_bridged(i, equation) ? std::max(density, record.bridge(equation, i))
                                        : density;
}

/// Transition F of one step. Coloured noise only decays, so that F is a block of the states and
/// a diagonal.
template <int Size>
class Transition {
 public:
  Transition(const ChannelMap& map, Index states)
      : states_(states),
        block_(Square<Size>::Zero(map.size, map.size)),
        decay_(Column<Size>::Zero(map.size)),
        carried_(map.size),
        half_(map.size, map.size) {
    for (Index k = states; k < map.size; ++k)
      decay_[k] = map.decay[static_cast<std::size_t>(k - states)];
  }

  void read(const LinearisedRecord& record, Index i) {
    const double* phi = record.transition.col(i).data();
    for (Index k = 0; k < states_; ++k)
      for (Index j = 0; j < states_; ++j) block_(j, k) = *phi++;
  }

  void read_transposed(const LinearisedRecord& record, Index i) {
    const double* phi = record.transition.col(i).data();
    for (Index k = 0; k < states_; ++k)
      for (Index j = 0; j < states_; ++j) block_(k, j) = *phi++;
  }

  /// x -> F x
  void carry_mean(Column<Size>& x) {
    carried_ = decay_.cwiseProduct(x);
    for (Index k = 0; k < states_; ++k) carried_ += x[k] * block_.col(k);
    x = carried_;
  }

  /// P -> F P F'
  void carry_covariance(Square<Size>& p) {
    const Index size = p.cols();
    for (Index j = 0; j < size; ++j) {
      carried_ = decay_.cwiseProduct(p.col(j));
      for (Index k = 0; k < states_; ++k) carried_ += p(k, j) * block_.col(k);
      half_.col(j) = carried_;
    }
    for (Index j = 0; j < states_; ++j) {
      carried_ = block_(j, 0) * half_.col(0);
      for (Index k = 1; k < states_; ++k) carried_ += block_(j, k) * half_.col(k);
      p.col(j) = carried_;
    }
    for (Index j = states_; j < size; ++j) p.col(j) = decay_[j] * half_.col(j);
  }

  /// Where the model is unstable the skew part of P, which is rounding, must not grow: it is
  /// taken out now and then.
  void make_symmetric(Index i, Square<Size>& p) {
    constexpr Index kNowAndThen = 8;
    if (i % kNowAndThen != 0) return;
    half_ = p.transpose();
    p = 0.5 * (p + half_);
  }

 private:
  Index states_;
  Square<Size> block_;  ///< of the states; the rest is 0
  Column<Size> decay_;  ///< of the coloured noise; 0 for the states
  Column<Size> carried_;
  Square<Size> half_;
};

/// Mean and covariance (N x N) of the deviation, carried along a record.
template <int Size>
class KalmanStep {
 public:
  KalmanStep(const LinearisedRecord& record, const NoiseModel& noise, const ChannelMap& map)
      : record_(record),
        map_(map),
        variances_(record, noise, map),
        mean_(Column<Size>::Zero(map.size)),
        defect_(Column<Size>::Zero(map.size)),
        gain_(Column<Size>::Zero(map.size)),
        row_(Column<Size>::Zero(map.size)),
        covariance_(variances_.start.asDiagonal()),
        transition_(map, record.states()) {}

  /// Takes in what was measured (minus the path) on one channel as the mark of the sample says,
  /// which is no outlier and not missing. The gain is left in gain().
  Innovation update(Index channel, double measured, Mark mark = Mark::Value) {
    const Innovation whole = expect(channel, measured);
    const Innovation seen = is_clipped(mark) ? censored(whole, mark) : whole;
    gain_ = row_ / seen.variance;
    mean_ += gain_ * seen.value;
    covariance_.noalias() -= gain_.lazyProduct(row_.transpose());
    return seen;
  }

  /// Goes over step i of the record.
  void predict(Index i) {
    transition_.read(record_, i);
    transition_.carry_mean(mean_);
    defect_.head(record_.states()) = record_.defect.col(i);
    mean_ += defect_;
    transition_.carry_covariance(covariance_);
    transition_.make_symmetric(i, covariance_);
    add_disturbance(i);
  }

  const Column<Size>& mean() const { return mean_; }
  const Square<Size>& covariance() const { return covariance_; }
  const Column<Size>& gain() const { return gain_; }

 private:
  /// What is new in a value; the covariance of state and measurement is left in row_.
  Innovation expect(Index channel, double measured) {
    const Index state = map_.state[static_cast<std::size_t>(channel)];
    const Index colour = map_.colour[static_cast<std::size_t>(channel)];
    row_ = covariance_.col(state);
    double expected = mean_[state];
    if (colour < map_.size) {
      row_ += covariance_.col(colour);
      expected += mean_[colour];
    }
    const double variance =
        row_[state] + (colour < map_.size ? row_[colour] : 0.0) + variances_.white[channel];
    const double value = measured - expected;
    return {value, variance, value * value / variance, variance};
  }

  /// The measurement that moves mean and variance as the knowledge does that the value lies
  /// beyond the end of the channel: with z in deviations, a value of lambda/delta deviations
  /// and a variance of 1/delta of the whole.
  static Innovation censored(const Innovation& at_end, Mark mark) {
    constexpr double kNothing = 1e-12;  // share of the variance: the model is far beyond
    const double side = mark == Mark::AtTop ? 1.0 : -1.0;
    const double deviation = std::sqrt(at_end.variance);
    const double z = -side * at_end.value / deviation;
    const Truncation known(z);
    const double slope = known.shift * z / at_end.variance;
    if (known.share < kNothing)
      return {0.0, std::numeric_limits<double>::infinity(), known.deviance, 1.0, slope};
    return {side * known.shift / known.share * deviation, at_end.variance / known.share,
            known.deviance, 1.0, slope};
  }

  void add_disturbance(Index i) {
    const double step = record_.time[i + 1] - record_.time[i];
    row_.setZero();
    for (Index k = 0; k < record_.states(); ++k) {
      const double density = density_in(record_, i, k, variances_.disturbance[k]) / step;
      if (density == 0.0) continue;
      constant_response(record_, i, k, row_.data());
      for (Index j = 0; j < record_.states(); ++j)
        covariance_.col(j) += (density * row_[j]) * row_;
    }
    const Index m = record_.states();
    for (Index k = m; k < map_.size; ++k) {
      const double decay = map_.decay[static_cast<std::size_t>(k - m)];
      covariance_(k, k) += variances_.colour[k - m] * (1.0 - decay * decay);
    }
  }

  const LinearisedRecord& record_;
  const ChannelMap& map_;
  Variances variances_;
  Column<Size> mean_, defect_, gain_, row_;
  Square<Size> covariance_;
  Transition<Size> transition_;
};

}  // namespace lacuna
