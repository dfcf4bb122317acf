// SPDX-License-Identifier: MIT
// Laws that may be what the nominal model of the coupled electric drives lacks.
#pragma once

#include <filesystem>
#include <string>

namespace lacuna::benchmarks {

/// Free runs of the drives with dry friction, with the cross term that a diagnosis names, and
/// with both, each fitted to the training records.
std::string compared_drives(const std::filesystem::path& folder);

}  // namespace lacuna::benchmarks
