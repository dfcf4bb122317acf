// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace lacuna {

/// Style of report pages (CSS) besides that of their pictures.
std::string page_style();

/// Script of report pages: series on and off, values under the pointer, orbits turned by
/// dragging.
std::string page_script();

}  // namespace lacuna
