// SPDX-License-Identifier: MIT
// Filters that smooth records before they are written: how they are seen, and how undone.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lacuna/data/records/dataset.hpp"
#include "lacuna/diagnose/criterion/options.hpp"

namespace lacuna {

/// A filter y = h * x of evenly spaced samples, of gain 1 at rest.
struct SmoothingFilter {
  enum class Kind {
    CentredMean,  ///< equal weights; of an even number one more lies before the sample
    PastMean,     ///< the same, of the sample and those before it
    Quadratic,    ///< least-squares parabola through an odd number (Savitzky-Golay)
  };
  Kind kind = Kind::CentredMean;
  Index window = 3;  ///< samples that have a weight

  Index reach() const { return window / 2; }
};

/// The filter that white noise of some states has gone through: their spectra above half of the
/// highest frequency (of differences of fourth order, mean over Hann windows of 256 samples)
/// have the shape of its |h|^2 more likely, by Whittle's likelihood, than that of noise with
/// any short memory, exp(a + b cos w + c cos 2 w), and not less likely than both together. Both
/// by `undecided` in each state; nothing where none of up to SmoothingOptions::widest samples
/// does so, where there is more in the octave below than it passes (SmoothingOptions::below),
/// or records are shorter. Past means look like centred ones.
std::optional<SmoothingFilter> estimated_filter(const Dataset& data,
                                                const std::vector<Index>& states,
                                                double undecided,
                                                const SmoothingOptions& options = {});

/// Samples that are smoothed, by columns. Beyond its ends a column is mirrored at their values.
Matrix smoothed(const SmoothingFilter& filter, const Matrix& samples);

/// What was before it was smoothed: x_0 = y, x_j+1 = x_j + h * (y - h * x_j), which lacks
/// (1 - h) (1 - h^2)^turns and enlarges no noise (Landweber, Am. J. Math. 73 (1951)). Means of
/// an even number of samples lie half a step aside: of them the mean of two neighbours is
/// undone. The last samples of a PastMean are the last one that is given.
Matrix undone(const SmoothingFilter& filter, const Matrix& samples, int turns);

/// Samples so far apart that what undone() makes of white noise behind h has no larger
/// correlation than SmoothingOptions::in_common.
Index memory_of(const SmoothingFilter& filter, const SmoothingOptions& options = {});

/// "means over 9 samples".
std::string description_of(const SmoothingFilter& filter);

}  // namespace lacuna
