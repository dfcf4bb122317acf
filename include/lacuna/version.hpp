// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace lacuna {

/// The version of these headers, MAJOR.MINOR.PATCH (semver.org).
inline constexpr std::string_view kVersion = "0.1.0";

/// The version of the library that a program runs with, MAJOR.MINOR.PATCH: that of the headers
/// unless these belong to another installation.
std::string_view library_version();

}  // namespace lacuna
