// SPDX-License-Identifier: MIT
// Forward and backward pass of the smoother.
#include <algorithm>

#include "kalman_step.hpp"
#include "lacuna/trajectories/smoother/innovation_filter.hpp"

namespace lacuna {
namespace {

/// What is to be smoothed.
struct SmootherTask {
  const LinearisedRecord& record;
  const Matrix& measured;
  const Matrix& omitted;
  const NoiseModel& noise;
  const ChannelMap& map;
};

/// What the forward pass leaves for the way back; N rows are padded to those of the shape.
struct Forward {
  Matrix mean;        ///< N x n, before the sample
  Matrix covariance;  ///< N^2 x n, before the sample
  Matrix gain;        ///< N channels x n
  Matrix value;       ///< channels x n
  Matrix variance;    ///< channels x n; 0 where a sample is left out
  Matrix slope;       ///< channels x n; Innovation::slope
  double deviance = 0.0;
};

template <class S>
Forward room_for(const S& shape, const SmootherTask& task) {
  const Index n = task.record.samples(), channels = task.map.channels();
  return {Matrix(shape.stride(), n),
          Matrix(shape.stride() * shape.size(), n),
          Matrix(shape.stride() * channels, n),
          Matrix::Zero(channels, n),
          Matrix::Zero(channels, n),
          Matrix::Zero(channels, n),
          0.0};
}

LACUNA_INLINE void copy_packs(const double* from, Index count, double* to) {
  for (Index p = 0; p < count; p += kLane)
    at<kLane>(to + p).values = at<kLane>(from + p).values;
}

template <class S>
LACUNA_INLINE void go_forward(const S& shape, const SmootherTask& task, Forward& forward) {
  const Index n = task.record.samples(), channels = task.map.channels();
  const Index stride = shape.stride(), square = stride * shape.size();
  KalmanStep<S> step(shape, task.record, task.noise, task.map);
  DevianceSum deviance;
  for (Index i = 0; i < n; ++i) {
    copy_packs(step.mean(), stride, forward.mean.data() + i * stride);
    copy_packs(step.covariance(), square, forward.covariance.data() + i * square);
    for (Index c = 0; c < channels; ++c) {
      const Index state = task.map.state[static_cast<std::size_t>(c)];
      const Mark mark = mark_of(task.omitted, i, state);
      if (!says_something(mark)) continue;
      const Innovation seen =
          step.update(c, task.measured(i, state) - task.record.path(i, state), mark);
      copy_packs(step.gain(), stride, forward.gain.data() + (i * channels + c) * stride);
      forward.value(c, i) = seen.value;
      forward.variance(c, i) = seen.variance;
      forward.slope(c, i) = seen.slope;
      deviance.add(seen);
    }
    if (i + 1 < n) step.predict(i);
  }
  forward.deviance = deviance.value();
}

SmoothedRecord empty_result(const SmootherTask& task, double deviance) {
  const Index n = task.record.samples(), m = task.record.states();
  const Index channels = task.map.channels(), sums = m + 2 * channels;
  return {Matrix(n, m),
          Matrix::Zero(n, channels),
          Vector::Zero(sums),
          Vector::Zero(sums),
          Matrix::Zero(task.record.steps(), m),
          deviance};
}

/// The adjoint of the filter: its vector, its covariance and the sums they give.
template <class S>
class Backward {
 public:
  LACUNA_INLINE Backward(const S& shape, const SmootherTask& task, const Forward& forward)
      : shape_(shape),
        record_(task.record),
        noise_(task.noise),
        map_(task.map),
        forward_(forward),
        adjoint_(shape.column()),
        moved_(shape.column()),
        spread_(shape.column()),
        reads_(task.map.channels() * shape.stride()),
        covariance_(shape.square()),
        transition_(shape, task.map),
        result_(empty_result(task, forward.deviance)) {
    for (Index c = 0; c < map_.channels(); ++c)
      for (const Index place : {map_.state[static_cast<std::size_t>(c)], colour_of(c)})
        if (place < map_.size) reads_[c * shape.stride() + place] = 1.0;
  }

  LACUNA_INLINE SmoothedRecord run() {
    for (Index i = record_.samples() - 1; i >= 0; --i) {
      for (Index c = map_.channels() - 1; c >= 0; --c)
        if (forward_.variance(c, i) > 0.0) measure(i, c);
      keep(i);
      if (i > 0) step(i - 1);
    }
    renew(true);
    return std::move(result_);
  }

 private:
  LACUNA_INLINE Index colour_of(Index channel) const {
    return S::kExact ? map_.size : map_.colour[static_cast<std::size_t>(channel)];
  }

  LACUNA_INLINE void measure(Index i, Index c) {
    const Index stride = shape_.stride();
    const double* gain = forward_.gain.data() + (i * map_.channels() + c) * stride;
    const double variance = forward_.variance(c, i);
    const double pull = forward_.value(c, i) / variance - dot(shape_, gain, adjoint_.data());
    multiply(shape_, covariance_.data(), gain, shape_.size(), moved_.data());
    const double weight = 1.0 / variance + dot(shape_, gain, moved_.data());
    add_white(i, c, pull * pull, weight);
    // covariance += weight h h' - h moved' - moved h'
    const double* h = reads_.data() + c * stride;
    add(shape_, pull, h, adjoint_.data());
    add_outer(shape_, -1.0, h, moved_.data(), covariance_.data());
    for (const Index place : {map_.state[static_cast<std::size_t>(c)], colour_of(c)}) {
      if (place >= map_.size) continue;
      double* column = covariance_.data() + place * stride;
      add(shape_, weight, h, column);
      add(shape_, -1.0, moved_.data(), column);
    }
  }

  /// Of a sample at an end of its channel what it says at once of the noise; what it says by
  /// what it does to the path is little.
  LACUNA_INLINE void add_white(Index i, Index c, double found, double expected) {
    const Index sum = shape_.states() + c;
    const double slope = forward_.slope(c, i);
    const bool clipped = slope != 0.0;
    result_.found[sum] += clipped ? std::max(0.0, -slope) : found;
    result_.expected[sum] += clipped ? std::max(0.0, slope) : expected;
  }

  LACUNA_INLINE void keep(Index i) {
    const Index stride = shape_.stride();
    const double* before = forward_.covariance.data() + i * stride * shape_.size();
    multiply(shape_, before, adjoint_.data(), shape_.size(), moved_.data());
    add(shape_, 1.0, forward_.mean.data() + i * stride, moved_.data());
    for (Index k = 0; k < shape_.states(); ++k) result_.deviation(i, k) = moved_[k];
    for (Index c = 0; c < map_.channels(); ++c)
      if (const Index colour = colour_of(c); colour < map_.size)
        result_.colour(i, c) = moved_[colour];
  }

  /// Back over step i.
  LACUNA_INLINE void step(Index i) {
    const double length = record_.time[i + 1] - record_.time[i];
    for (Index p = 0; p < shape_.stride(); p += kLane)
      at<kLane>(moved_.data() + p).values = Pack{};
    for (Index k = 0; k < shape_.states(); ++k) {
      constant_response(shape_, record_, i, k, moved_.data());
      const double pull = dot(shape_, moved_.data(), adjoint_.data());
      const double density =
          density_in(record_, i, k, noise_.disturbance[k] * noise_.disturbance[k]) / length;
      result_.disturbance(i, k) = density * pull;
      if (record_.is_bridged(i, k)) continue;
      result_.found[k] += pull * pull / length;
      multiply(shape_, covariance_.data(), moved_.data(), shape_.states(), spread_.data());
      result_.expected[k] += dot(shape_, moved_.data(), spread_.data()) / length;
    }
    renew(false);
    transition_.read_transposed(record_, i);
    transition_.carry_mean(adjoint_.data());
    transition_.carry_covariance(covariance_.data());
    transition_.make_symmetric(i, covariance_.data());
  }

  /// What is new of the coloured noises in a step, or at the first sample, where they begin
  /// stationary: all of their variance.
  LACUNA_INLINE void renew(bool first) {
    for (Index c = 0; c < map_.channels(); ++c) {
      const Index colour = colour_of(c), m = shape_.states();
      if (colour >= map_.size) continue;
      const Index sum = m + map_.channels() + c;
      const double decay = first ? 0.0 : map_.decay[static_cast<std::size_t>(colour - m)];
      const double renewed = 1.0 - decay * decay;  // fraction of its variance
      result_.found[sum] += renewed * adjoint_[colour] * adjoint_[colour];
      result_.expected[sum] += renewed * covariance_[colour * (shape_.stride() + 1)];
    }
  }

  const S& shape_;
  const LinearisedRecord& record_;
  const NoiseModel& noise_;
  const ChannelMap& map_;
  const Forward& forward_;
  typename S::Column adjoint_, moved_, spread_;
  Numbers<Eigen::Dynamic> reads_;  ///< h of each channel: it measures h' x
  typename S::Square covariance_;
  Transition<S> transition_;
  SmoothedRecord result_;
};

template <class S>
LACUNA_INLINE SmoothedRecord smoothed(const S& shape, const SmootherTask& task) {
  Forward forward = room_for(shape, task);
  go_forward(shape, task, forward);
  return Backward<S>(shape, task, forward).run();
}

template <class S>
SmoothedRecord smoothed_generic(const S& shape, const SmootherTask& task) {
  return smoothed(shape, task);
}

#ifdef LACUNA_KERNEL_DISPATCH
template <class S>
[[gnu::target("avx2,fma")]] SmoothedRecord smoothed_avx2(const S& shape,
                                                         const SmootherTask& task) {
  return smoothed(shape, task);
}
#endif

}  // namespace

SmoothedRecord smooth(const LinearisedRecord& record, const Matrix& measured,
                      const Matrix& omitted, const NoiseModel& noise) {
  const ChannelMap map(record, noise);
  const SmootherTask task{record, measured, omitted, noise, map};
  return with_shape(map.size, record.states(), [&](const auto& shape) {
#ifdef LACUNA_KERNEL_DISPATCH
    if (has_avx2()) return smoothed_avx2(shape, task);
#endif
    return smoothed_generic(shape, task);
  });
}

}  // namespace lacuna
