// SPDX-License-Identifier: MIT
#pragma once

#include <sys/resource.h>

#include <cstdint>
#include <optional>

namespace lacuna::cli {

/// The least that anything can be done with.
inline constexpr std::uint64_t kLeastMemory = std::uint64_t{16} << 20U;

/// Bytes that a run may take unless set otherwise: three quarters of the machine's memory.
std::uint64_t default_memory();

/// Keeps memory that is freed for what asks for it next: fits ask for the same large matrices
/// over and over, and each that the system gives anew it fills with zeros first.
void keep_freed_memory();

/// Bounds the memory of the process (RLIMIT_DATA) for as long as it lives, so that an input
/// that expands without end gives std::bad_alloc and not a machine that swaps. A bound that is
/// lower already stays. Builds with sanitizers, which reserve more than any machine has, are
/// not bounded.
class MemoryLimit {
 public:
  explicit MemoryLimit(std::uint64_t bytes);
  ~MemoryLimit();
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;

 private:
  std::optional<rlimit> before_;
};

}  // namespace lacuna::cli
