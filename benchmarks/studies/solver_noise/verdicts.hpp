// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace lacuna::benchmarks {

/// What `identify` says of models of all flows, from records of all makings: those that have
/// exactly the true terms, and those of flows whose terms the library lacks. For floors of the
/// verdict (ValidationOptions::resolution) at half, one and double.
void write_verdicts(const std::filesystem::path& folder);

}  // namespace lacuna::benchmarks
