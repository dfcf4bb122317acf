// SPDX-License-Identifier: MIT
#include "kalman_step.hpp"

#include <algorithm>
#include <cmath>

namespace lacuna {

ChannelMap::ChannelMap(const LinearisedRecord& record, const NoiseModel& noise) {
  const Index m = record.states();
  const double step = (record.time[record.samples() - 1] - record.time[0]) /
                      static_cast<double>(record.steps());
  size = m;
  for (Index k = 0; k < m; ++k) {
    const auto& coloured = noise.coloured[static_cast<std::size_t>(k)];
    if (!noise.measurement[static_cast<std::size_t>(k)]) continue;
    state.push_back(k);
    colour.push_back(coloured ? size++ : -1);
    if (coloured) decay.push_back(std::exp(-step / coloured->time));
  }
  for (Index& place : colour)
    if (place < 0) place = size;
}

KalmanStep::KalmanStep(const LinearisedRecord& record, const NoiseModel& noise,
                       const ChannelMap& map)
    : record_(record),
      map_(map),
      m_(record.states()),
      white_(map.channels()),
      colour_(map.size - m_),
      disturbance_(noise.disturbance.array().square()),
      mean_(Vector::Zero(map.size)),
      next_(map.size),
      gain_(map.size),
      row_(map.size),
      covariance_(Matrix::Zero(map.size, map.size)),
      half_(map.size, map.size),
      transition_(Matrix::Zero(map.size, map.size)) {
  for (Index c = 0; c < map.channels(); ++c) {
    const auto k = static_cast<std::size_t>(map.state[static_cast<std::size_t>(c)]);
    white_[c] = *noise.measurement[k] * *noise.measurement[k];
    const Index place = map.colour[static_cast<std::size_t>(c)];
    if (place < map.size)
      colour_[place - m_] = noise.coloured[k]->deviation * noise.coloured[k]->deviation;
  }
  // Before the first sample a state may be anywhere in the span of the record.
  for (Index k = 0; k < m_; ++k) {
    const double span = record.path.col(k).maxCoeff() - record.path.col(k).minCoeff();
    covariance_(k, k) = span > 0.0 ? span * span : 1.0;
  }
  for (Index k = m_; k < map.size; ++k) {
    covariance_(k, k) = colour_[k - m_];
    transition_(k, k) = map.decay[static_cast<std::size_t>(k - m_)];
  }
}

Innovation KalmanStep::update(Index channel, double measured) {
  const Index state = map_.state[static_cast<std::size_t>(channel)];
  const Index colour = map_.colour[static_cast<std::size_t>(channel)];
  row_ = covariance_.col(state);
  double expected = mean_[state];
  if (colour < map_.size) {
    row_ += covariance_.col(colour);
    expected += mean_[colour];
  }
  const double variance =
      row_[state] + (colour < map_.size ? row_[colour] : 0.0) + white_[channel];
  const double value = measured - expected;
  gain_ = row_ / variance;
  mean_ += gain_ * value;
  covariance_ -= gain_.lazyProduct(row_.transpose());
  return {value, variance};
}

void KalmanStep::predict(Index i) {
  const Eigen::Map<const Matrix> phi(record_.transition.col(i).data(), m_, m_);
  transition_.topLeftCorner(m_, m_) = phi;
  next_ = transition_.lazyProduct(mean_);
  next_.head(m_) += record_.defect.col(i);
  mean_.swap(next_);
  half_ = transition_.lazyProduct(covariance_);
  covariance_ = half_.lazyProduct(transition_.transpose());
  // Rounding must not grow where the model is unstable: the covariance stays symmetric.
  half_ = covariance_.transpose();
  covariance_ = 0.5 * (covariance_ + half_);
  add_disturbance(i);
}

void KalmanStep::add_disturbance(Index i) {
  const double step = record_.time[i + 1] - record_.time[i];
  for (Index k = 0; k < m_; ++k) {
    const double density = density_in(record_, i, k, disturbance_[k]);
    if (density == 0.0) continue;
    constant_response(record_, i, k, gain_.data());
    const auto moved = gain_.head(m_);
    covariance_.topLeftCorner(m_, m_) +=
        (density / step) * moved.lazyProduct(moved.transpose());
  }
  for (Index k = m_; k < map_.size; ++k) {
    const double decay = map_.decay[static_cast<std::size_t>(k - m_)];
    covariance_(k, k) += colour_[k - m_] * (1.0 - decay * decay);
  }
}

double density_in(const LinearisedRecord& record, Index i, Index equation, double density) {
  return record.is_bridged(i, equation) ? std::max(density, record.bridge(equation, i))
                                        : density;
}

void constant_response(const LinearisedRecord& record, Index i, Index equation, double* out) {
  const Index m = record.states();
  const double* w = record.response.col(i).data() + 3 * m * equation;
  for (Index j = 0; j < m; ++j) out[j] = w[j] + w[m + j] + w[2 * m + j];
}

}  // namespace lacuna
