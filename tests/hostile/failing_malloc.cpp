// SPDX-License-Identifier: MIT
// Preloaded into a program: large allocations fail from the k-th on, or only the k-th.
//   FAIL_AT=k      number, from 1, of the first that fails; none: none fails
//   FAIL_ONCE=1    only that one fails
//   FAIL_COUNT=1   their number goes to standard error at the end
// Large is from 4 kB on: what matrices, tables and files need. (Where not even an exception or
// a message finds memory no program can say so.)
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstdlib>

extern "C" {

void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);

static std::atomic<long> large_allocations{0};

static bool fails(std::size_t size) {
  constexpr std::size_t kLarge = 4096;
  if (size < kLarge) return false;
  static const char* const at = std::getenv("FAIL_AT");
  static const bool once = std::getenv("FAIL_ONCE") != nullptr;
  const long number = ++large_allocations;
  if (at == nullptr) return false;
  const bool now = once ? number == std::atol(at) : number >= std::atol(at);
  if (now) errno = ENOMEM;
  return now;
}

void* malloc(std::size_t size) { return fails(size) ? nullptr : __libc_malloc(size); }

void* calloc(std::size_t count, std::size_t size) {
  return fails(count * size) ? nullptr : __libc_calloc(count, size);
}

void* realloc(void* old, std::size_t size) {
  return fails(size) ? nullptr : __libc_realloc(old, size);
}

__attribute__((destructor)) static void show_count() {
  if (std::getenv("FAIL_COUNT") == nullptr) return;
  char text[64];
  const int length = std::snprintf(text, sizeof text, "LARGE %ld\n", large_allocations.load());
  if (write(STDERR_FILENO, text, static_cast<std::size_t>(length)) < 0) _exit(1);
}

}  // extern "C"
