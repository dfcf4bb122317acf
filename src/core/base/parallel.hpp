// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "lacuna/core/base/types.hpp"

namespace lacuna {

/// Calls work(0) ... work(count - 1), each once, on at most `threads` threads at a time; the
/// caller's is one of them. Each call must write to a place of its own, so that what comes out
/// does not depend on the number of threads.
/// @throws what the call with the smallest number threw, after all have ended; calls that had
///   not begun by then are left out.
void parallel_for(std::size_t count, int threads, FunctionRef<void(std::size_t)> work);

}  // namespace lacuna
