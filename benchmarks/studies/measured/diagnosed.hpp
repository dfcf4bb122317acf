// SPDX-License-Identifier: MIT
// What the nominal models of the measured records lack, by the whole vocabulary.
#pragma once

#include <filesystem>
#include <string>

#include "lacuna/data/records/dataset.hpp"
#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna::benchmarks {

/// Samples [first, first + count) of a dataset with one record.
Dataset rows(const Dataset& data, Index first, Index count);

/// Root mean square error of a free simulation in mV, its start being fitted to the first 50
/// samples; "diverged".
std::string simulation_error(const OdeModel& model, const Dataset& record);

/// The Silverbox record: y by u.
Dataset oscillator_record(const std::filesystem::path& folder);

/// EMPS: names, sizes, and the force that the models leave on both records.
std::string diagnosed_positioning(const std::filesystem::path& folder);

/// Silverbox: names, sizes, and errors of free simulations.
std::string diagnosed_oscillator(const std::filesystem::path& folder);

}  // namespace lacuna::benchmarks
