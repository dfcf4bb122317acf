// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "reference_path.hpp"

namespace lacuna {

/// Consecutive samples of a record.
struct SampleWindow {
  std::size_t record = 0;
  Index first = 0, samples = 0;
};

/// Records with their paths, and the windows in which they are fitted.
struct WindowedPath {
  std::vector<PathRecord> records;
  std::vector<SampleWindow> windows;

  Index dimension() const { return records.front().weights.cols(); }
  Index substeps() const { return records.front().substeps; }
};

/// More samples than this do not change which terms are found.
inline constexpr Index kMostSamples = 40000;

/// Divides every record into windows of so many samples; a rest joins the last one. Windows
/// evenly spread stand for records of more than `most` samples in all.
std::vector<SampleWindow> windows_of(const std::vector<PathRecord>& records, Index samples,
                                     Index most = kMostSamples);

/// Windows first .. last - 1, which one thread works on.
struct WindowChunk {
  std::size_t first = 0, last = 0;
};

/// Divides windows into at most 16 chunks, or fewer where each of them has a square matrix of
/// so many columns. Does not depend on threads, so that sums over chunks do not.
std::vector<WindowChunk> window_chunks(std::size_t windows, Index columns = 1);

/// Sums of squared weighted residuals of the path, and how many there are, per state.
Vector misfits_of(const WindowedPath& path);
Vector counts_of(const WindowedPath& path);

/// Gives every state another sigma.
void rescale(WindowedPath& path, const Vector& factors);

/// Leaves out samples that are more than `limit` sigma off the path.
void mask_beyond(WindowedPath& path, double limit);

}  // namespace lacuna
