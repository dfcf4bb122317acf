// SPDX-License-Identifier: MIT
#include "trajectories/smoother/variance_fit.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace lacuna {
namespace {

/// Deviance that no test would notice.
constexpr double kUnnoticed = 0.02;

const Matrix kNone;

using Kind = NoiseEntry::Kind;

double& deviation_of(NoiseModel& noise, const NoiseEntry& entry) {
  if (entry.kind == Kind::Disturbance) return noise.disturbance[entry.state];
  const auto k = static_cast<std::size_t>(entry.state);
  return entry.kind == Kind::White ? *noise.measurement[k] : noise.coloured[k]->deviation;
}

/// Places of entries in the smoother's sums: states, then white and coloured channels.
std::vector<Index> places_in_sums(const NoiseModel& noise,
                                  const std::vector<NoiseEntry>& entries) {
  std::vector<Index> channel(static_cast<std::size_t>(noise.states()));
  Index next = 0;
  for (std::size_t k = 0; k < channel.size(); ++k)
    if (noise.measurement[k]) channel[k] = next++;
  std::vector<Index> places;
  for (const NoiseEntry& entry : entries) {
    const Index own = channel[static_cast<std::size_t>(entry.state)];
    places.push_back(entry.kind == Kind::Disturbance ? entry.state
                     : entry.kind == Kind::White     ? noise.states() + own
                                                     : noise.states() + next + own);
  }
  return places;
}

}  // namespace

void VarianceFit::set_white_moves(bool moves) { white_moves_ = moves; }

std::vector<NoiseEntry> VarianceFit::entries_of(const NoiseModel& noise) const {
  std::vector<NoiseEntry> entries;
  for (Index k = 0; k < noise.states(); ++k)
    if (noise.disturbance[k] > 0.0) entries.push_back({Kind::Disturbance, k});
  for (Index k = 0; k < noise.states(); ++k) {
    const auto state = static_cast<std::size_t>(k);
    if (!noise.measurement[state]) continue;
    if (white_moves_) entries.push_back({Kind::White, k});
    if (noise.coloured[state]) entries.push_back({Kind::Coloured, k});
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
  const std::vector<Index> places = places_in_sums(result.noise, known_.entries);
  const auto count = static_cast<Index>(places.size());
  result.gradient.resize(count);
  result.weight.resize(count);
  for (Index e = 0; e < count; ++e) {
    const NoiseEntry& entry = known_.entries[static_cast<std::size_t>(e)];
    const Index sum = places[static_cast<std::size_t>(e)];
    const double s = deviation_of(result.noise, entry);
    result.gradient[e] = 2.0 * s * s * (expected[sum] - found[sum]);
    const bool at_floor = entry.kind == Kind::White && s <= floor_[entry.state];
    if (at_floor) result.gradient[e] = std::min(result.gradient[e], 0.0);
    result.weight[e] = s * s * expected[sum];
  }
  return result;
}

NoiseModel VarianceFit::moved(const NoiseModel& noise, const Vector& step) const {
  NoiseModel next = noise;
  for (std::size_t e = 0; e < known_.entries.size(); ++e) {
    const NoiseEntry& entry = known_.entries[e];
    double& s = deviation_of(next, entry);
    s *= std::exp(step[static_cast<Index>(e)]);
    if (entry.kind == Kind::White) s = std::max(s, floor_[entry.state]);
  }
  return next;
}

/// The update of Broyden, Fletcher, Goldfarb and Shanno; false where there is nothing to learn.
bool VarianceFit::learn(const Vector& step, const Vector& change) {
  const double inner = step.dot(change);
  if (!(inner > 1e-10 * step.norm() * change.norm())) return false;
  const Matrix identity = Matrix::Identity(step.size(), step.size());
  const Matrix left = identity - step * change.transpose() / inner;
  known_.inverse = left * known_.inverse * left.transpose() + step * step.transpose() / inner;
  return true;
}

/// The curvature at the start. The step to the fixed point found/expected has one that is too
/// large; where what is known would make even shorter steps, it does not hold here.
void VarianceFit::begin_with(const SmoothedNoise& start) {
  const Vector careful = (4.0 * start.weight.array().max(1e-6)).inverse();
  if (known_.inverse.rows() != careful.size()) known_.inverse = careful.asDiagonal();
  for (Index e = 0; e < careful.size(); ++e) {
    if (known_.inverse(e, e) >= careful[e]) continue;
    known_.inverse.row(e).setZero();
    known_.inverse.col(e).setZero();
    known_.inverse(e, e) = careful[e];
  }
}

SmoothedNoise VarianceFit::run(const LinearisedData& data, const NoiseModel& start,
                               int iterations) {
  constexpr double kLongestStep = 1.5;  // of a step in a logarithm: a factor of 4.5
  constexpr double kSameStep = 0.01;    // a fact of the search: it would find the same again
  if (std::vector<NoiseEntry> entries = entries_of(start); entries != known_.entries)
    known_ = {std::move(entries), Matrix()};
  SmoothedNoise best = at(data, start);
  const auto count = static_cast<Index>(known_.entries.size());
  begin_with(best);
  int runs = 1;
  std::optional<Vector> refused;  ///< the last step from here, that did not help
  for (int iteration = 0; iteration < iterations && count > 0; ++iteration) {
    Vector step = -known_.inverse * best.gradient;
    if (!step.allFinite() || -0.5 * step.dot(best.gradient) < kUnnoticed) break;
    // Where the filter matches moments the gradient vanishes beside the least deviance, and what
    // is learnt leads there again.
    if (refused && (step - *refused).norm() <= kSameStep * refused->norm()) break;
    refused = step;
    const double longest = step.cwiseAbs().maxCoeff();
    if (longest > kLongestStep) step *= kLongestStep / longest;
    SmoothedNoise next = at(data, moved(best.noise, step));
    ++runs;
    const bool better = next.deviance < best.deviance;
    const bool learnt = learn(step, next.gradient - best.gradient);
    if (better) {
      best = std::move(next);
      refused.reset();
    } else if (!learnt) {
      known_.inverse *= 0.25;
    }
  }
  best.runs = runs;
  return best;
}

}  // namespace lacuna
