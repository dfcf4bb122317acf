// SPDX-License-Identifier: MIT
#include "lacuna/innovation/variance_fit.hpp"

#include <algorithm>
#include <cmath>

namespace lacuna {
namespace {

/// Deviance that no test would notice.
constexpr double kUnnoticed = 0.02;

const Matrix kNone;

double& deviation_of(NoiseModel& noise, int kind, Index state) {
  if (kind == 0) return noise.disturbance[state];
  const auto k = static_cast<std::size_t>(state);
  return kind == 1 ? *noise.measurement[k] : noise.coloured[k]->deviation;
}

}  // namespace

void VarianceFit::set_white_moves(bool moves) {
  if (moves == white_moves_) return;
  white_moves_ = moves;
  inverse_curvature_.resize(0, 0);
}

std::vector<VarianceFit::Entry> VarianceFit::entries_of(const NoiseModel& noise) const {
  std::vector<Entry> entries;
  const Index m = noise.states(), channels = noise.measured();
  for (Index k = 0; k < m; ++k)
    if (noise.disturbance[k] > 0.0) entries.push_back({Entry::Kind::Disturbance, k, k});
  Index channel = 0;
  for (Index k = 0; k < m; ++k) {
    const auto state = static_cast<std::size_t>(k);
    if (!noise.measurement[state]) continue;
    if (white_moves_) entries.push_back({Entry::Kind::White, k, m + channel});
    if (noise.coloured[state])
      entries.push_back({Entry::Kind::Coloured, k, m + channels + channel});
    ++channel;
  }
  return entries;
}

SmoothedNoise VarianceFit::at(const LinearisedData& data, NoiseModel noise) const {
  SmoothedNoise result{std::move(noise), 0.0, {}, {}, {}};
  Vector found, expected;
  for (std::size_t r = 0; r < data.records.size(); ++r) {
    result.records.push_back(smooth(data.records[r], data.measured[r],
                                    data.omitted.empty() ? kNone : data.omitted[r],
                                    result.noise));
    const SmoothedRecord& smoothed = result.records.back();
    result.deviance += smoothed.deviance;
    found = r == 0 ? smoothed.found : Vector(found + smoothed.found);
    expected = r == 0 ? smoothed.expected : Vector(expected + smoothed.expected);
  }
  const auto count = static_cast<Index>(entries_.size());
  result.gradient.resize(count);
  result.weight.resize(count);
  for (Index e = 0; e < count; ++e) {
    const Entry& entry = entries_[static_cast<std::size_t>(e)];
    const double s = deviation_of(result.noise, static_cast<int>(entry.kind), entry.state);
    result.gradient[e] = 2.0 * s * s * (expected[entry.sum] - found[entry.sum]);
    const bool at_floor = entry.kind == Entry::Kind::White && s <= floor_[entry.state];
    if (at_floor) result.gradient[e] = std::min(result.gradient[e], 0.0);
    result.weight[e] = s * s * expected[entry.sum];
  }
  return result;
}

NoiseModel VarianceFit::moved(const NoiseModel& noise, const Vector& step) const {
  NoiseModel next = noise;
  for (std::size_t e = 0; e < entries_.size(); ++e) {
    const Entry& entry = entries_[e];
    double& s = deviation_of(next, static_cast<int>(entry.kind), entry.state);
    s *= std::exp(step[static_cast<Index>(e)]);
    if (entry.kind == Entry::Kind::White) s = std::max(s, floor_[entry.state]);
  }
  return next;
}

/// The update of Broyden, Fletcher, Goldfarb and Shanno; false where there is nothing to learn.
bool VarianceFit::learn(const Vector& step, const Vector& change) {
  const double inner = step.dot(change);
  if (!(inner > 1e-10 * step.norm() * change.norm())) return false;
  const Matrix identity = Matrix::Identity(step.size(), step.size());
  const Matrix left = identity - step * change.transpose() / inner;
  inverse_curvature_ =
      left * inverse_curvature_ * left.transpose() + step * step.transpose() / inner;
  return true;
}

SmoothedNoise VarianceFit::run(const LinearisedData& data, const NoiseModel& start,
                               int iterations) {
  constexpr double kLongest = 1.5;  // of a step in a logarithm: a factor of 4.5
  entries_ = entries_of(start);
  SmoothedNoise best = at(data, start);
  const auto count = static_cast<Index>(entries_.size());
  for (int iteration = 0; iteration < iterations && count > 0; ++iteration) {
    // The fixed point found/expected is the step with this curvature, which is too large.
    if (inverse_curvature_.rows() != count)
      inverse_curvature_ =
          (4.0 * best.weight.array().max(1e-6)).inverse().matrix().asDiagonal();
    Vector step = -inverse_curvature_ * best.gradient;
    if (!step.allFinite() || -0.5 * step.dot(best.gradient) < kUnnoticed) break;
    const double longest = step.cwiseAbs().maxCoeff();
    if (longest > kLongest) step *= kLongest / longest;
    SmoothedNoise next = at(data, moved(best.noise, step));
    const bool better = next.deviance < best.deviance;
    const bool learnt = learn(step, next.gradient - best.gradient);
    if (better)
      best = std::move(next);
    else if (!learnt)
      inverse_curvature_ *= 0.25;
  }
  return best;
}

}  // namespace lacuna
