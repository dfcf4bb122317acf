// SPDX-License-Identifier: MIT
// Records that were smoothed before they were written.
#pragma once

#include <optional>
#include <string>

#include "lacuna/diagnose/criterion/options.hpp"
#include "lacuna/diagnose/hypotheses/problem.hpp"
#include "smoothing_filter.hpp"

namespace lacuna {

/// How records were smoothed: all states by one filter, and all inputs or none.
struct Smoothing {
  SmoothingFilter filter;
  bool of_inputs = false;
};

/// How records were smoothed, as the noise of their states shows (estimated_filter()). It does
/// not show whether means are over the samples before or over those about each one, and whether
/// inputs went the same way: means about each one, of states, unless with another one most of
/// what disturbs the model goes, its coefficients fitted. Nothing where samples are missing, at
/// an end of their channel or not evenly spaced, or where too few samples would be left
/// (SmoothingOptions::least_left).
std::optional<Smoothing> smoothing_of(const Problem& problem);

/// Records as they were before they were smoothed, which bends what is fast. Samples that share
/// noise with others, and the ends, where the filter had no samples, are marked as missing.
/// Records that are not evenly sampled stay as they are.
Dataset preprocessed(const Smoothing& smoothing, Dataset data,
                     const SmoothingOptions& options = {});

/// The same of bound records, with the noise that they have then.
BoundRecords preprocessed(const Smoothing& smoothing, BoundRecords records,
                          const SmoothingOptions& options = {});

/// "the states were smoothed by means over 9 samples, ...": for people.
std::string note_on(const Smoothing& smoothing);

}  // namespace lacuna
