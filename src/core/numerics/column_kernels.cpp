// SPDX-License-Identifier: MIT
#include "core/numerics/column_kernels.hpp"

#include "core/numerics/lanes.hpp"

namespace lacuna {
namespace {

/// Whether what was made of values times 0 is 0: of others it is no number.
template <class V>
LACUNA_INLINE bool all_were_finite(const V& zeros) {
  return sum(zeros) == 0.0;
}

/// Calls visit(row, value) for each vector of values; two sums, as one waits for itself.
template <int W, class Visit>
LACUNA_INLINE bool finite_kernel(const double* values, Index count, const Visit& visit) {
  using V = typename Lanes<W>::Type;
  V even = {}, odd = {};
  Index row = 0;
  for (; row + 2 * W <= count; row += 2 * W) {
    const V first = at<W>(values + row).values;
    const V second = at<W>(values + row + W).values;
    visit(row, first);
    visit(row + W, second);
    even += first * 0.0;
    odd += second * 0.0;
  }
  double rest = 0.0;
  for (; row < count; ++row) {
    visit.one(row, values[row]);
    rest += values[row] * 0.0;
  }
  return all_were_finite(even + odd) && rest == 0.0;
}

struct Look {
  template <class V>
  LACUNA_INLINE void operator()(Index, const V&) const {}
  LACUNA_INLINE void one(Index, double) const {}
};

template <int W>
struct Copy {
  double* to;
  const double* ahead;

  LACUNA_INLINE void operator()(Index row, const typename Lanes<W>::Type& value) const {
    at<W>(to + row).values = value;
    if (row * Index{sizeof(double)} % kCacheLine == 0) __builtin_prefetch(ahead + row);
  }
  LACUNA_INLINE void one(Index row, double value) const { to[row] = value; }
};

template <int W>
LACUNA_INLINE void multiply_kernel(const double* a, const double* b, Index count, double* out) {
  Index row = 0;
  for (; row + W <= count; row += W)
    at<W>(out + row).values = at<W>(a + row).values * at<W>(b + row).values;
  for (; row < count; ++row) out[row] = a[row] * b[row];
}

template <int W>
LACUNA_INLINE void difference_kernel(double* x, Index count) {
  Index row = 0;
  for (; row + W <= count; row += W)
    at<W>(x + row).values = at<W>(x + row + 1).values - at<W>(x + row).values;
  for (; row < count; ++row) x[row] = x[row + 1] - x[row];
}

struct Kernels {
  bool (*look)(const double*, Index);
  bool (*copy)(const double*, Index, double*);
  void (*multiply)(const double*, const double*, Index, double*);
  void (*difference)(double*, Index);
};

bool look_generic(const double* v, Index n) { return finite_kernel<2>(v, n, Look{}); }
bool copy_generic(const double* v, Index n, double* to) {
  return finite_kernel<2>(v, n, Copy<2>{to, v + n});
}
void multiply_generic(const double* a, const double* b, Index n, double* out) {
  multiply_kernel<2>(a, b, n, out);
}
void difference_generic(double* x, Index n) { difference_kernel<2>(x, n); }

#ifdef LACUNA_KERNEL_DISPATCH
[[gnu::target("avx2")]] bool look_avx2(const double* v, Index n) {
  return finite_kernel<4>(v, n, Look{});
}
[[gnu::target("avx2")]] bool copy_avx2(const double* v, Index n, double* to) {
  return finite_kernel<4>(v, n, Copy<4>{to, v + n});
}
[[gnu::target("avx2")]] void multiply_avx2(const double* a, const double* b, Index n,
                                           double* out) {
  multiply_kernel<4>(a, b, n, out);
}
[[gnu::target("avx2")]] void difference_avx2(double* x, Index n) { difference_kernel<4>(x, n); }
[[gnu::target("avx512f")]] bool look_avx512(const double* v, Index n) {
  return finite_kernel<8>(v, n, Look{});
}
[[gnu::target("avx512f")]] bool copy_avx512(const double* v, Index n, double* to) {
  return finite_kernel<8>(v, n, Copy<8>{to, v + n});
}
[[gnu::target("avx512f")]] void multiply_avx512(const double* a, const double* b, Index n,
                                                double* out) {
  multiply_kernel<8>(a, b, n, out);
}
[[gnu::target("avx512f")]] void difference_avx512(double* x, Index n) {
  difference_kernel<8>(x, n);
}
#endif

Kernels best_kernels() {
#ifdef LACUNA_KERNEL_DISPATCH
  if (__builtin_cpu_supports("avx512f"))
    return {look_avx512, copy_avx512, multiply_avx512, difference_avx512};
  if (has_avx2()) return {look_avx2, copy_avx2, multiply_avx2, difference_avx2};
#endif
  return {look_generic, copy_generic, multiply_generic, difference_generic};
}

const Kernels& kernels() {
  static const Kernels best = best_kernels();
  return best;
}

}  // namespace

bool is_finite(const double* values, Index count) { return kernels().look(values, count); }

bool copy_finite(const double* from, Index count, double* to) {
  return kernels().copy(from, count, to);
}

void multiply(const double* a, const double* b, Index count, double* out) {
  kernels().multiply(a, b, count, out);
}

void difference(double* x, Index count) { kernels().difference(x, count); }

}  // namespace lacuna
