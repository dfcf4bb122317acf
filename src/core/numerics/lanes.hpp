// SPDX-License-Identifier: MIT
// Vectors of W doubles for kernels that are written once and compiled for several instruction
// sets: the kernel is a template of LACUNA_INLINE functions, its entries have a target each.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "lacuna/core/base/types.hpp"

#if defined(__x86_64__) && defined(__GNUC__)
#define LACUNA_KERNEL_DISPATCH 1
#endif
#define LACUNA_INLINE [[gnu::always_inline]] inline

namespace lacuna {

template <int W>
struct Lanes {
  typedef double Type __attribute__((vector_size(sizeof(double) * W)));
};

/// W numbers anywhere in memory. A packed structure: the alignment of a typedef is lost where
/// clang instantiates a template with it.
template <int W>
struct [[gnu::packed, gnu::may_alias]] InMemory {
  typename Lanes<W>::Type values;
};

/// The W numbers at an address. Vectors are passed by reference: by value they would have one
/// calling convention for each instruction set.
template <int W>
LACUNA_INLINE const InMemory<W>& at(const double* address) {
  return *reinterpret_cast<const InMemory<W>*>(address);
}

template <int W>
LACUNA_INLINE InMemory<W>& at(double* address) {
  return *reinterpret_cast<InMemory<W>*>(address);
}

/// Keeps a vector in a register: GCC 12 loads it again for each of its uses, which takes half
/// of the speed of a kernel of products. (clang does not, and refuses the wide ones here.)
template <class V>
LACUNA_INLINE void keep_in_register([[maybe_unused]] V& value) {
#if defined(LACUNA_KERNEL_DISPATCH) && !defined(__clang__)
  asm("" : "+v"(value));
#endif
}

/// The sum of the lanes, by halves: the machine does not wait for each of them.
template <class V>
LACUNA_INLINE double sum(const V& value) {
  constexpr unsigned kLanes = sizeof(V) / sizeof(double);
  if constexpr (kLanes == 8) {
    return sum(__builtin_shufflevector(value, value, 0, 1, 2, 3) +
               __builtin_shufflevector(value, value, 4, 5, 6, 7));
  } else if constexpr (kLanes == 4) {
    return sum(__builtin_shufflevector(value, value, 0, 1) +
               __builtin_shufflevector(value, value, 2, 3));
  } else {
    return value[0] + value[1];
  }
}

/// A fact of the machines: doubles in a register of AVX2.
inline constexpr Index kLane = 4;
using Pack = Lanes<kLane>::Type;

/// Numbers in memory, 0 at first; Count: how many, or Eigen::Dynamic.
template <int Count>
class Numbers {
 public:
  LACUNA_INLINE explicit Numbers(Index) {}
  LACUNA_INLINE double* data() { return values_.data(); }
  LACUNA_INLINE const double* data() const { return values_.data(); }
  LACUNA_INLINE double& operator[](Index i) { return data()[i]; }
  LACUNA_INLINE double operator[](Index i) const { return data()[i]; }

 private:
  alignas(32) std::array<double, static_cast<std::size_t>(Count)> values_ = {};
};

template <>
class Numbers<Eigen::Dynamic> {
 public:
  explicit Numbers(Index count) : values_(static_cast<std::size_t>(count)) {}
  LACUNA_INLINE double* data() { return values_.data(); }
  LACUNA_INLINE const double* data() const { return values_.data(); }
  LACUNA_INLINE double& operator[](Index i) { return data()[i]; }
  LACUNA_INLINE double operator[](Index i) const { return data()[i]; }

 private:
  std::vector<double> values_;
};

/// A fact of the machines: bytes that come from memory together.
inline constexpr Index kCacheLine = 64;

/// Whether the machine has AVX2 and fused multiplication and addition.
inline bool has_avx2() {
#ifdef LACUNA_KERNEL_DISPATCH
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#else
  return false;
#endif
}

}  // namespace lacuna
