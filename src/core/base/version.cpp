// SPDX-License-Identifier: MIT
#include "lacuna/version.hpp"

namespace lacuna {

std::string_view library_version() { return kVersion; }

}  // namespace lacuna
