// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "lacuna/data/records/dataset.hpp"

namespace lacuna {

/// Where a record is made of several, one behind the other: the first samples of the second one,
/// of the third, ...
///
/// No motion changes all that is measured at once: a state goes on as it went, and an impact
/// changes speeds but no position. With r(i) = (x(i+1) - x(i)) / dt, from sample i to the next is
/// a seam where for every measured state r(i) is farther outside of what is between r(i-1) and
/// r(i+1) than elsewhere and than r changes in any other step, for one of them by more than three
/// times (a decision, docs/decisions/numbers.md) what it is elsewhere, and none comes back within
/// the longest run of outliers. Where an
/// input changes in that step or in one beside it, a plant that is faster than the samples does
/// the same if only one of its states is measured: then nothing is said.
std::vector<Index> seams(const Dataset& data, const Trajectory& record);

}  // namespace lacuna
