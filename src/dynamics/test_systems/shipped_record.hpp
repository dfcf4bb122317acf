// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "lacuna/data/records/dataset.hpp"

namespace lacuna {

/// The record data/tl072_record.csv.gz, made anew: the system `tl072` for 1000 tau at h = 0.1
/// tau (n = 10 000) on its attractor, 1 mV Gaussian noise (seed 20230220) on each channel, then
/// a 16-bit converter over +-10 V. Time in tau = 0.1 ms, states in V.
///
/// The orbit is rounded to 2^-24 V (60 nV) at every sample. Chaos would else amplify the last
/// bit of one compiler's arithmetic to another record; so it is the same everywhere. The
/// rounding is 1/17 000 of the noise.
Dataset tl072_record();

/// What the file says of itself in its comment lines.
std::string tl072_record_comment();

}  // namespace lacuna
