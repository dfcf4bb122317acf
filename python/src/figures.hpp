// SPDX-License-Identifier: MIT
#pragma once

#include <nanobind/nanobind.h>

#include "report/pages/page.hpp"

namespace lacuna::python {

/// The numbers of every picture of a page, one dictionary each: "kind" (lines, rows, orbits),
/// "name", "title" and what a figure of that kind has.
nanobind::list figures_of(const Page& page);

}  // namespace lacuna::python
