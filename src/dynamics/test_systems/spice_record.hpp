// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "lacuna/data/records/dataset.hpp"

namespace lacuna {

/// Reads what ngspice writes in its text form ("raw" file with `filetype=ascii`): time [s] and
/// voltages, each named v(name), as a record with the states in the file's order.
/// @throws DataError naming the file and what does not fit.
Dataset read_spice_output(const std::filesystem::path& path);

/// The record on the uniform grid t = 0, h, 2h, ... with n samples, time in units of `unit` s
/// after `begin` s, by polynomials through six of ngspice's own, unevenly spaced samples.
/// @throws DataError when the record ends before.
/// @throws ArgumentError when there are no such samples; DataError as check_dataset() and when
///   the record ends before.
Dataset resampled(const Dataset& record, double begin, double unit, double h, Index n);

}  // namespace lacuna
