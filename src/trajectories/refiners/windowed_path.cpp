// SPDX-License-Identifier: MIT
#include "windowed_path.hpp"

#include <algorithm>
#include <cmath>

namespace lacuna {
namespace {

/// Weighted deviation of a sample from the path.
double deviation(const PathRecord& record, Index sample, Index state) {
  return record.weights(sample, state) *
         (record.samples.states(sample, state) - record.slots(sample * record.stride(), state));
}

/// Calls visit(record, sample, state) for all samples in windows.
template <typename Records, typename Visit>
void for_each_sample(Records& records, const WindowedPath& path, Visit visit) {
  for (const SampleWindow& window : path.windows)
    for (Index i = window.first; i < window.first + window.samples; ++i)
      for (Index k = 0; k < path.dimension(); ++k) visit(records[window.record], i, k);
}

}  // namespace

std::vector<SampleWindow> windows_of(const std::vector<PathRecord>& records, Index samples,
                                     Index most) {
  Index all = 0;
  for (const PathRecord& record : records) all += record.samples.samples();
  const Index every = (all + most - 1) / most;
  std::vector<SampleWindow> windows;
  Index behind = 0;  // windows since the last one that was taken, counted through all records
  for (std::size_t r = 0; r < records.size(); ++r) {
    const Index n = records[r].samples.samples();
    const Index count = std::max<Index>(1, n / samples);
    for (Index w = 0; w < count; ++w) {
      if (behind++ % every == 0)
        windows.push_back({r, w * n / count, (w + 1) * n / count - w * n / count});
    }
  }
  return windows;
}

std::vector<WindowChunk> window_chunks(std::size_t windows, Index columns) {
  constexpr Index kMostChunks = 16, kMostEntries = Index{1} << 24;  // 128 MiB in all
  const Index chunks_of_size =
      std::clamp<Index>(kMostEntries / (columns * columns), 1, kMostChunks);
  const std::size_t count = std::min(windows, static_cast<std::size_t>(chunks_of_size));
  std::vector<WindowChunk> chunks;
  for (std::size_t c = 0; c < count; ++c)
    chunks.push_back({c * windows / count, (c + 1) * windows / count});
  return chunks;
}

Vector misfits_of(const WindowedPath& path) {
  Vector sums = Vector::Zero(path.dimension());
  for_each_sample(path.records, path, [&](const PathRecord& record, Index i, Index k) {
    sums[k] += std::pow(deviation(record, i, k), 2);
  });
  return sums;
}

Vector counts_of(const WindowedPath& path) {
  Vector counts = Vector::Zero(path.dimension());
  for_each_sample(path.records, path, [&](const PathRecord& record, Index i, Index k) {
    counts[k] += record.weights(i, k) > 0.0 ? 1.0 : 0.0;
  });
  return counts;
}

void rescale(WindowedPath& path, const Vector& factors) {
  for (PathRecord& record : path.records)
    record.weights.array().rowwise() /= factors.transpose().array();
}

void mask_beyond(WindowedPath& path, double limit) {
  for_each_sample(path.records, path, [&](PathRecord& record, Index i, Index k) {
    if (std::abs(deviation(record, i, k)) > limit) record.weights(i, k) = 0.0;
  });
}

}  // namespace lacuna
