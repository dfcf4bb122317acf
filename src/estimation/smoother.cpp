// SPDX-License-Identifier: MIT
// The backward pass of the smoother.
#include <algorithm>
#include <vector>

#include "kalman_step.hpp"
#include "lacuna/estimation/innovation_filter.hpp"

namespace lacuna {
namespace {

/// What the forward pass leaves for the way back.
struct Forward {
  Matrix mean;        ///< N x n, before the sample
  Matrix covariance;  ///< N^2 x n, before the sample
  Matrix gain;        ///< N channels x n
  Matrix value;       ///< channels x n
  Matrix variance;    ///< channels x n; 0 where a sample is left out
  Matrix slope;       ///< channels x n; Innovation::slope
  double deviance = 0.0;
};

template <int Size>
Forward go_forward(const LinearisedRecord& record, const Matrix& measured,
                   const Matrix& omitted, const NoiseModel& noise, const ChannelMap& map) {
  const Index n = record.samples();
  const Index size = map.size;
  Forward forward{Matrix(size, n),
                  Matrix(size * size, n),
                  Matrix(size * map.channels(), n),
                  Matrix::Zero(map.channels(), n),
                  Matrix::Zero(map.channels(), n),
                  Matrix::Zero(map.channels(), n),
                  0.0};
  KalmanStep<Size> step(record, noise, map);
  DevianceSum deviance;
  for (Index i = 0; i < n; ++i) {
    forward.mean.col(i) = step.mean();
    forward.covariance.col(i) = step.covariance().reshaped();
    for (Index c = 0; c < map.channels(); ++c) {
      const Index state = map.state[static_cast<std::size_t>(c)];
      const Mark mark = mark_of(omitted, i, state);
      if (!says_something(mark)) continue;
      const Innovation seen = step.update(c, measured(i, state) - record.path(i, state), mark);
      forward.gain.col(i).segment(c * size, size) = step.gain();
      forward.value(c, i) = seen.value;
      forward.variance(c, i) = seen.variance;
      forward.slope(c, i) = seen.slope;
      deviance.add(seen);
    }
    if (i + 1 < n) step.predict(i);
  }
  forward.deviance = deviance.value();
  return forward;
}

/// The adjoint of the filter: its vector, its covariance and the sums they give.
template <int Size>
class Backward {
 public:
  Backward(const LinearisedRecord& record, const NoiseModel& noise, const ChannelMap& map,
           const Forward& forward)
      : record_(record),
        noise_(noise),
        map_(map),
        forward_(forward),
        m_(record.states()),
        adjoint_(Column<Size>::Zero(map.size)),
        moved_(Column<Size>::Zero(map.size)),
        covariance_(Square<Size>::Zero(map.size, map.size)),
        transition_(map, m_) {
    for (Index c = 0; c < map.channels(); ++c) {
      reads_.push_back(Column<Size>::Zero(map.size));
      reads_.back()[map.state[static_cast<std::size_t>(c)]] = 1.0;
      const Index colour = map.colour[static_cast<std::size_t>(c)];
      if (colour < map.size) reads_.back()[colour] = 1.0;
    }
    const Index sums = m_ + 2 * map.channels();
    result_ = {Matrix(record.samples(), m_),
               Matrix::Zero(record.samples(), map.channels()),
               Vector::Zero(sums),
               Vector::Zero(sums),
               Matrix::Zero(record.steps(), m_),
               forward.deviance};
  }

  SmoothedRecord run() {
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
  void measure(Index i, Index c) {
    const Eigen::Map<const Column<Size>> gain(forward_.gain.col(i).data() + c * map_.size,
                                              map_.size);
    const double variance = forward_.variance(c, i);
    const double pull = forward_.value(c, i) / variance - gain.dot(adjoint_);
    moved_ = covariance_.lazyProduct(gain);
    const double weight = 1.0 / variance + gain.dot(moved_);
    add_white(i, c, pull * pull, weight);
    // covariance += weight h h' - h moved' - moved h'
    const Column<Size>& h = reads_[static_cast<std::size_t>(c)];
    adjoint_ += pull * h;
    for (Index j = 0; j < map_.size; ++j)
      covariance_.col(j) += (weight * h[j] - moved_[j]) * h - h[j] * moved_;
  }

  /// Of a sample at an end of its channel what it says at once of the noise; what it says by
  /// what it does to the path is little.
  void add_white(Index i, Index c, double found, double expected) {
    const double slope = forward_.slope(c, i);
    const bool clipped = slope != 0.0;
    result_.found[m_ + c] += clipped ? std::max(0.0, -slope) : found;
    result_.expected[m_ + c] += clipped ? std::max(0.0, slope) : expected;
  }

  void keep(Index i) {
    const Eigen::Map<const Square<Size>> before(forward_.covariance.col(i).data(), map_.size,
                                                map_.size);
    const Eigen::Map<const Column<Size>> mean(forward_.mean.col(i).data(), map_.size);
    moved_ = before.lazyProduct(adjoint_) + mean;
    result_.deviation.row(i) = moved_.head(m_).transpose();
    for (Index c = 0; c < map_.channels(); ++c) {
      const Index colour = map_.colour[static_cast<std::size_t>(c)];
      if (colour < map_.size) result_.colour(i, c) = moved_[colour];
    }
  }

  /// Back over step i.
  void step(Index i) {
    const double length = record_.time[i + 1] - record_.time[i];
    moved_.setZero();
    for (Index k = 0; k < m_; ++k) {
      constant_response(record_, i, k, moved_.data());
      const double pull = moved_.dot(adjoint_);
      const double density =
          density_in(record_, i, k, noise_.disturbance[k] * noise_.disturbance[k]) / length;
      result_.disturbance(i, k) = density * pull;
      if (record_.is_bridged(i, k)) continue;
      result_.found[k] += pull * pull / length;
      spread_ = moved_[0] * covariance_.col(0);
      for (Index j = 1; j < m_; ++j) spread_ += moved_[j] * covariance_.col(j);
      result_.expected[k] += moved_.dot(spread_) / length;
    }
    renew(false);
    transition_.read_transposed(record_, i);
    transition_.carry_mean(adjoint_);
    transition_.carry_covariance(covariance_);
    transition_.make_symmetric(i, covariance_);
  }

  /// What is new of the coloured noises in a step, or at the first sample, where they begin
  /// stationary: all of their variance.
  void renew(bool first) {
    for (Index c = 0; c < map_.channels(); ++c) {
      const Index colour = map_.colour[static_cast<std::size_t>(c)];
      if (colour >= map_.size) continue;
      const Index sum = m_ + map_.channels() + c;
      const double decay = first ? 0.0 : map_.decay[static_cast<std::size_t>(colour - m_)];
      const double renewed = 1.0 - decay * decay;  // share of its variance
      result_.found[sum] += renewed * adjoint_[colour] * adjoint_[colour];
      result_.expected[sum] += renewed * covariance_(colour, colour);
    }
  }

  const LinearisedRecord& record_;
  const NoiseModel& noise_;
  const ChannelMap& map_;
  const Forward& forward_;
  Index m_;
  Column<Size> adjoint_, moved_, spread_;
  Square<Size> covariance_;
  Transition<Size> transition_;
  std::vector<Column<Size>> reads_;  ///< h of each channel: it measures h' x
  SmoothedRecord result_;
};

}  // namespace

SmoothedRecord smooth(const LinearisedRecord& record, const Matrix& measured,
                      const Matrix& omitted, const NoiseModel& noise) {
  const ChannelMap map(record, noise);
  return with_size(map.size, [&](auto size) {
    const Forward forward = go_forward<size()>(record, measured, omitted, noise, map);
    return Backward<size()>(record, noise, map, forward).run();
  });
}

}  // namespace lacuna
