// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace lacuna {

/// What to do about a file that cannot be opened for reading: "did you mean 'data/run.csv'?"
/// where it is not there and its folder has a file of a near name (nearest_name()), else
/// `otherwise`. A folder that cannot be listed has no near names.
std::string remedy_of_missing(const std::filesystem::path& path, const std::string& otherwise);

}  // namespace lacuna
