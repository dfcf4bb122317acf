// SPDX-License-Identifier: MIT
#include "memory_limit.hpp"

#include <unistd.h>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace lacuna::cli {
namespace {

// Sanitizers reserve terabytes of addresses.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kBounded = false;
#elif defined(__has_feature)
constexpr bool kBounded = !__has_feature(address_sanitizer) && !__has_feature(thread_sanitizer);
#else
constexpr bool kBounded = true;
#endif

}  // namespace

std::uint64_t default_memory() {
  const auto pages = static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES));
  return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)) / 4 * 3;
}

void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int kLargest = 32 << 20;  // a fact of glibc: its largest threshold, in bytes
  mallopt(M_MMAP_THRESHOLD, kLargest);
  mallopt(M_TRIM_THRESHOLD, 8 * kLargest);
#endif
}

MemoryLimit::MemoryLimit(std::uint64_t bytes) {
  rlimit limit{};
  if (!kBounded || getrlimit(RLIMIT_DATA, &limit) != 0 || limit.rlim_cur <= bytes) return;
  before_ = limit;
  limit.rlim_cur = bytes;
  if (setrlimit(RLIMIT_DATA, &limit) != 0) before_.reset();
}

MemoryLimit::~MemoryLimit() {
  if (before_) setrlimit(RLIMIT_DATA, &*before_);
}

}  // namespace lacuna::cli
