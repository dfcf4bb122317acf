// SPDX-License-Identifier: MIT
// Numbers that are not finite make numbers that are not finite.
#pragma once

#include <string>
#include <vector>

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// The range of an axis of a picture, and how values lie on it.
struct Scale {
  double low = 0.0, high = 1.0;
  bool logarithmic = false;

  /// Where a value lies, 0 at `low` and 1 at `high`; NaN where it has no place (a logarithm of
  /// what is not positive).
  double part(double value) const;
};

/// A mark on an axis.
struct Tick {
  double value = 0.0;
  std::string label;
};

/// A scale that holds all finite values (all positive ones on a logarithmic axis), a little
/// wider than they are; one that has a width where they are all the same or there is none.
Scale scale_of(const std::vector<const Vector*>& values, bool logarithmic = false);

/// Round values in the range: multiples of 1, 2 or 5 times a power of ten, about `count` of
/// them; on a logarithmic axis powers of ten, every n-th where there are many.
/// @throws ArgumentError when the scale has no range.
std::vector<Tick> ticks_of(const Scale& scale, int count);

/// Samples that show a curve as well as all of them do where `columns` pixels are side by side:
/// of every column the first, the last, the least and the largest value, in their order. NaN
/// splits a curve: one stays for each run of them. Where x goes back and forth (an orbit)
/// every k-th sample stands, no more than four for each column.
/// @throws ArgumentError when x and y differ in number, or there is no column.
std::vector<Index> shown_samples(const Vector& x, const Vector& y, const Scale& scale,
                                 Index columns);

}  // namespace lacuna
