// SPDX-License-Identifier: MIT
// The recursion of the filter, one sample at a time; what it leaves behind is the caller's.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "censoring.hpp"
#include "core/numerics/small_matrix.hpp"
#include "lacuna/data/records/marks.hpp"
#include "lacuna/trajectories/sensitivities/linearised_record.hpp"
#include "lacuna/trajectories/smoother/noise_model.hpp"

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
  Vector half;         ///< per channel: half the spacing of its lattice, or 0

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
  LACUNA_INLINE void add(const Innovation& one) {
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
  LACUNA_INLINE static bool is_moderate(double x) { return x > 1e-100 && x < 1e100; }

  double sum_ = 0.0, product_ = 1.0;
};

/// Response at the end of step i to a constant rate in an equation: w0 + w1 + w2.
template <class S>
LACUNA_INLINE void constant_response(const S& shape, const LinearisedRecord& record, Index i,
                                     Index equation, double* out) {
  const Index m = shape.states();
  const double* w = record.response.data() + (i * m + equation) * 3 * m;
  for (Index p = 0; p < m; p += kLane) {
    Pack begin, middle, end;
    load_some(w + p, m - p, 1, begin);
    load_some(w + m + p, m - p, 1, middle);
    load_some(w + 2 * m + p, m - p, 1, end);
    at<kLane>(out + p).values = begin + middle + end;
  }
}

/// Spectral density of the disturbance of an equation in step i: `density`, or that of the
/// bridge where it is larger.
LACUNA_INLINE double density_in(const LinearisedRecord& record, Index i, Index equation,
                                double density) {
  return record.is_bridged(i, equation) ? std::max(density, record.bridge(equation, i))
                                        : density;
}

/// Transition F of one step. Coloured noise only decays, so that F is a block of the states and
/// a diagonal.
template <class S>
class Transition {
 public:
  LACUNA_INLINE Transition(const S& shape, const ChannelMap& map)
      : shape_(shape),
        block_(shape.square()),
        decay_(shape.column()),
        carried_(shape.column()),
        half_(shape.square()) {
    for (Index k = shape.states(); k < map.size; ++k)
      decay_[k] = map.decay[static_cast<std::size_t>(k - shape.states())];
  }

  LACUNA_INLINE void read(const LinearisedRecord& record, Index i) {
    read(record.transition.data() + i * shape_.states() * shape_.states(), shape_.states(), 1);
  }

  LACUNA_INLINE void read_transposed(const LinearisedRecord& record, Index i) {
    read(record.transition.data() + i * shape_.states() * shape_.states(), 1, shape_.states());
  }

  /// x -> F x
  LACUNA_INLINE void carry_mean(double* x) {
    multiply(shape_, block_.data(), x, shape_.states(), carried_.data());
    for (Index p = 0; p < shape_.stride(); p += kLane) {
      Pack next = at<kLane>(carried_.data() + p).values;
      if constexpr (!S::kExact)
        next += at<kLane>(decay_.data() + p).values * at<kLane>(x + p).values;
      at<kLane>(x + p).values = next;
    }
  }

  /// P -> F P F'
  LACUNA_INLINE void carry_covariance(double* p) {
    const Index m = shape_.states(), size = shape_.size(), stride = shape_.stride();
    if constexpr (!S::kExact)
      for (Index i = 0; i < size * stride; i += kLane)
        at<kLane>(half_.data() + i).values =
            at<kLane>(decay_.data() + i % stride).values * at<kLane>(p + i).values;
    product(shape_, block_.data(), p, 1, stride, size, half_.data());
    if constexpr (!S::kExact)
      for (Index j = 0; j < size; ++j)
        for (Index i = 0; i < stride; i += kLane)
          at<kLane>(p + j * stride + i).values =
              decay_[j] * at<kLane>(half_.data() + j * stride + i).values;
    product(shape_, half_.data(), block_.data(), stride, 1, m, p);
  }

  /// Where the model is unstable the skew part of P, which is rounding, must not grow: it is
  /// taken out now and then.
  LACUNA_INLINE void make_symmetric(Index i, double* p) const {
    // A fact of cost.
    constexpr Index kNowAndThen = 8;
    if (i % kNowAndThen != 0) return;
    const Index stride = shape_.stride();
    for (Index j = 0; j < shape_.size(); ++j)
      for (Index k = 0; k < j; ++k) {
        const double mean = 0.5 * (p[j * stride + k] + p[k * stride + j]);
        p[j * stride + k] = p[k * stride + j] = mean;
      }
  }

 private:
  /// @param across, down steps from one element to the next in a row and in a column.
  LACUNA_INLINE void read(const double* phi, Index across, Index down) {
    const Index m = shape_.states();
    for (Index k = 0; k < m; ++k)
      for (Index p = 0; p < m; p += kLane) {
        Pack rows;
        load_some(phi + k * across + p * down, m - p, down, rows);
        at<kLane>(block_.data() + k * shape_.stride() + p).values = rows;
      }
  }

  const S& shape_;
  typename S::Square block_;  ///< of the states; the rest is 0
  typename S::Column decay_;  ///< of the coloured noise; 0 for the states
  typename S::Column carried_;
  typename S::Square half_;
};

/// Mean and covariance (N x N) of the deviation, carried along a record.
template <class S>
class KalmanStep {
 public:
  LACUNA_INLINE KalmanStep(const S& shape, const LinearisedRecord& record,
                           const NoiseModel& noise, const ChannelMap& map)
      : shape_(shape),
        record_(record),
        map_(map),
        variances_(record, noise, map),
        mean_(shape.column()),
        gain_(shape.column()),
        row_(shape.column()),
        covariance_(shape.square()),
        transition_(shape, map) {
    for (Index k = 0; k < map.size; ++k)
      covariance_[k * shape.stride() + k] = variances_.start[k];
  }

  /// Takes in what was measured (minus the path) on one channel as the mark of the sample
  /// shows, which is no outlier and not missing. The gain is left in gain().
  LACUNA_INLINE Innovation update(Index channel, double measured, Mark mark = Mark::Value) {
    const Innovation whole = expect(channel, measured);
    const double half = variances_.half[channel];
    const Innovation seen = is_clipped(mark) ? censored(whole, mark)
                            : half > 0.0     ? rounded(whole, half)
                                             : whole;
    for (Index p = 0; p < shape_.stride(); p += kLane) {
      const Pack gain = at<kLane>(row_.data() + p).values / seen.variance;
      at<kLane>(gain_.data() + p).values = gain;
      at<kLane>(mean_.data() + p).values += gain * seen.value;
    }
    add_outer(shape_, -1.0, gain_.data(), row_.data(), covariance_.data());
    return seen;
  }

  /// Goes over step i of the record.
  LACUNA_INLINE void predict(Index i) {
    transition_.read(record_, i);
    transition_.carry_mean(mean_.data());
    const double* defect = record_.defect.data() + i * shape_.states();
    for (Index p = 0; p < shape_.states(); p += kLane) {
      Pack more;
      load_some(defect + p, shape_.states() - p, 1, more);
      at<kLane>(mean_.data() + p).values += more;
    }
    transition_.carry_covariance(covariance_.data());
    transition_.make_symmetric(i, covariance_.data());
    add_disturbance(i);
  }

  LACUNA_INLINE const double* mean() const { return mean_.data(); }
  /// Columns of shape.stride() rows.
  LACUNA_INLINE const double* covariance() const { return covariance_.data(); }
  LACUNA_INLINE const double* gain() const { return gain_.data(); }

 private:
  /// What is new in a value; the covariance of state and measurement is left in row_.
  LACUNA_INLINE Innovation expect(Index channel, double measured) {
    const Index state = map_.state[static_cast<std::size_t>(channel)];
    const Index colour = map_.colour[static_cast<std::size_t>(channel)];
    const bool coloured = !S::kExact && colour < map_.size;
    const double* own = covariance_.data() + state * shape_.stride();
    double expected = mean_[state];
    double variance = own[state] + variances_.white[channel];
    if (coloured) {
      const double* noise = covariance_.data() + colour * shape_.stride();
      for (Index p = 0; p < shape_.stride(); p += kLane)
        at<kLane>(row_.data() + p).values =
            at<kLane>(own + p).values + at<kLane>(noise + p).values;
      expected += mean_[colour];
      variance = row_[state] + row_[colour] + variances_.white[channel];
    } else {
      for (Index p = 0; p < shape_.stride(); p += kLane)
        at<kLane>(row_.data() + p).values = at<kLane>(own + p).values;
    }
    const double value = measured - expected;
    return {value, variance, value * value / variance, variance};
  }

  /// The measurement that moves mean and variance as the knowledge does that the value lies
  /// beyond the end of the channel: with z in deviations, a value of lambda/delta deviations
  /// and a variance of 1/delta of the whole.
  static Innovation censored(const Innovation& at_end, Mark mark) {
    constexpr double kLeastFraction = 1e-12;  // of the variance: the model is far beyond
    const double side = mark == Mark::AtTop ? 1.0 : -1.0;
    const double deviation = std::sqrt(at_end.variance);
    const double z = -side * at_end.value / deviation;
    const Truncation known(z);
    const double slope = known.shift * z / at_end.variance;
    if (known.fraction < kLeastFraction)
      return {0.0, std::numeric_limits<double>::infinity(), known.deviance, 1.0, slope};
    return {side * known.shift / known.fraction * deviation, at_end.variance / known.fraction,
            known.deviance, 1.0, slope};
  }

  /// The same of the knowledge that the value lay so near to what was written, `half` the
  /// spacing of its lattice. The deviance is that of a density, by which lattices and none
  /// compare.
  static Innovation rounded(const Innovation& written, double half) {
    constexpr double kLeastFraction = 1e-12;  // fraction of the variance: nothing new is known
    const double deviation = std::sqrt(written.variance);
    const Truncation known((written.value - half) / deviation,
                           (written.value + half) / deviation);
    const double deviance = known.deviance + 2.0 * std::log(2.0 * half) - std::log(2.0 * M_PI);
    if (known.fraction < kLeastFraction)
      return {0.0, std::numeric_limits<double>::infinity(), deviance, 1.0, 0.0};
    return {known.shift / known.fraction * deviation, written.variance / known.fraction,
            deviance, 1.0, 0.0};
  }

  LACUNA_INLINE void add_disturbance(Index i) {
    const Index m = shape_.states();
    const double step = record_.time[i + 1] - record_.time[i];
    for (Index k = 0; k < m; ++k) {
      const double density = density_in(record_, i, k, variances_.disturbance[k]) / step;
      if (density == 0.0) continue;
      response_to(i, k);
      add_outer(shape_, density, row_.data(), row_.data(), covariance_.data());
    }
    for (Index k = m; k < map_.size; ++k) {
      const double decay = map_.decay[static_cast<std::size_t>(k - m)];
      covariance_[k * shape_.stride() + k] += variances_.colour[k - m] * (1.0 - decay * decay);
    }
  }

  LACUNA_INLINE void response_to(Index i, Index equation) {
    for (Index p = 0; p < shape_.stride(); p += kLane)
      at<kLane>(row_.data() + p).values = Pack{};
    constant_response(shape_, record_, i, equation, row_.data());
  }

  const S& shape_;
  const LinearisedRecord& record_;
  const ChannelMap& map_;
  Variances variances_;
  typename S::Column mean_, gain_, row_;
  typename S::Square covariance_;
  Transition<S> transition_;
};

}  // namespace lacuna
