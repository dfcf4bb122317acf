// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>

namespace lacuna::benchmarks {

/// Calls work(0), ..., work(count - 1) on all cores, each once, in no particular order; what
/// one throws first is thrown here after the others have ended.
void for_all(std::size_t count, const std::function<void(std::size_t)>& work);

/// Cores of this machine, 1 where that is not known.
unsigned cores();

/// CPU time that this thread has had, seconds; it does not depend on what else the machine
/// does.
double thread_seconds();

}  // namespace lacuna::benchmarks
