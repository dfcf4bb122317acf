// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/data/records/dataset.hpp"

namespace lacuna {

/// The records with the samples marked as missing that show the last value once more while the
/// state moves on: a link that drops out, a channel that is read more often than it is renewed.
///
/// A sample that is as the one before it is one of these where
/// - the noise of the channel hardly lets a value come twice: with noise of deviation s on a
///   lattice of spacing q two samples of one state are equal with p = q / (2 sqrt(pi) s), and
///   by chance fewer than a twentieth of the runs of r repeats that there are come about
///   (n p^r of n samples); or
/// - all changes are whole multiples of a number of samples apart.
/// What rests without noise repeats itself too and is not marked.
Dataset with_repeats_marked(Dataset data);

}  // namespace lacuna
