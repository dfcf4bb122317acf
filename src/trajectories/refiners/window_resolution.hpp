// SPDX-License-Identifier: MIT
#pragma once

#include "window_search.hpp"

namespace lacuna {

/// Per state: what fourth-order steps can be relied on to resolve; less noise than this is not
/// believed in, or errors of the integration would be taken for structure.
Vector rounding_floor(const Dataset& data);

/// Where the noise cannot be distinguished from the signal it is at most what the fit leaves.
/// @return whether a sigma became less than half of what it was.
bool learn_noise(const SearchTask& task, WindowSearch& search);

/// Whether the steps have to be tested again: not in windows as long as those of the last test,
/// nor where that was passed by far.
bool asks_for_a_step_test(const WindowSearch& search);

/// Halves the steps of integration as long as that moves the path by more than a tenth of
/// sigma. @return whether the steps are finer than before.
bool refine_steps(const SearchTask& task, WindowSearch& search, const RunContext& context);

}  // namespace lacuna
