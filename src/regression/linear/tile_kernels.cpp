// SPDX-License-Identifier: MIT
#include "regression/linear/tile_kernels.hpp"

#include <cmath>

#include "core/numerics/lanes.hpp"

// The kernels are written once for vectors of W doubles. On x86-64 they are compiled for three
// instruction sets and chosen when the program runs; elsewhere the compiler's default is used.

namespace lacuna {
namespace {

constexpr int kBlock = static_cast<int>(Scratch::kColumnPadding);

struct TileView {
  double* data;
  Index stride;
  Index rows;  // a multiple of Scratch::kRowPadding
  Index columns;
};

// N x 3 inner products of columns; where the last three columns on both sides are the same,
// those above the diagonal.
template <int W, int N, bool Diagonal>
LACUNA_INLINE void gram_block(const TileView& tile, const double* left, const double* right,
                              double* gram, Index gram_stride) {
  using V = typename Lanes<W>::Type;
  const auto wanted = [](int i, int j) { return !Diagonal || i <= N - kBlock + j; };
  V products[kBlock][N] = {};
  for (Index row = 0; row < tile.rows; row += W) {
    V a[N];
    for (int i = 0; i < N; ++i) {
      a[i] = at<W>(left + i * tile.stride + row).values;
      keep_in_register(a[i]);
    }
    for (int j = 0; j < kBlock; ++j) {
      V b = at<W>(right + j * tile.stride + row).values;
      keep_in_register(b);
      for (int i = 0; i < N; ++i)
        if (wanted(i, j)) products[j][i] += a[i] * b;
    }
  }
  for (int j = 0; j < kBlock; ++j) {
    for (int i = 0; i < N; ++i)
      if (wanted(i, j)) gram[j * gram_stride + i] += sum(products[j][i]);
  }
}

// Wide machines have registers for 6 x 3 products, which take fewer loads each than 3 x 3.
template <int W>
LACUNA_INLINE void gram_kernel(const TileView& tile, double* gram) {
  constexpr int kWide = W >= 8 ? 2 * kBlock : kBlock;
  for (Index j = 0; j < tile.columns; j += kBlock) {
    const double* right = tile.data + j * tile.stride;
    double* column = gram + j * tile.columns;
    const auto left = [&](Index i) { return tile.data + i * tile.stride; };
    Index i = 0;
    for (; i + kWide <= j; i += kWide)
      gram_block<W, kWide, false>(tile, left(i), right, column + i, tile.columns);
    if (i + kWide == j + kBlock)
      gram_block<W, kWide, true>(tile, left(i), right, column + i, tile.columns);
    else
      gram_block<W, kBlock, true>(tile, left(i), right, column + i, tile.columns);
  }
}

// A Householder reflection I - v v' / scale with v = [head; column of the tile].
struct Reflection {
  const double* column;
  double head;
  double scale;
  Index row;
};

// Applies a reflection to N columns: T_k -= w_k v with w_k = (head R_jk + v'T_k) / scale.
template <int W, int N>
LACUNA_INLINE void reflect(const TileView& tile, const Reflection& reflection, double* columns,
                           double* triangle, Index height) {
  using V = typename Lanes<W>::Type;
  V even[N] = {};
  V odd[N] = {};
  for (Index row = 0; row < tile.rows; row += 2 * W) {
    const V first = at<W>(reflection.column + row).values;
    const V second = at<W>(reflection.column + row + W).values;
    for (int k = 0; k < N; ++k) {
      const double* column = columns + k * tile.stride + row;
      even[k] += at<W>(column).values * first;
      odd[k] += at<W>(column + W).values * second;
    }
  }
  double weights[N];
  for (int k = 0; k < N; ++k) {
    double& entry = triangle[k * height + reflection.row];
    weights[k] = (reflection.head * entry + sum(even[k]) + sum(odd[k])) / reflection.scale;
    entry -= weights[k] * reflection.head;
  }
  for (Index row = 0; row < tile.rows; row += W) {
    const V direction = at<W>(reflection.column + row).values;
    for (int k = 0; k < N; ++k)
      at<W>(columns + k * tile.stride + row).values -= direction * weights[k];
  }
}

template <int W>
LACUNA_INLINE void reflect_rest(const TileView& tile, const Reflection& reflection,
                                double* triangle) {
  Index k = reflection.row + 1;
  for (; k + 4 <= tile.columns; k += 4) {
    reflect<W, 4>(tile, reflection, tile.data + k * tile.stride, triangle + k * tile.columns,
                  tile.columns);
  }
  for (; k < tile.columns; ++k) {
    reflect<W, 1>(tile, reflection, tile.data + k * tile.stride, triangle + k * tile.columns,
                  tile.columns);
  }
}

template <int W>
LACUNA_INLINE double squared_norm(const double* column, Index rows) {
  using V = typename Lanes<W>::Type;
  V total = {};
  for (Index row = 0; row < rows; row += W) {
    const V value = at<W>(column + row).values;
    total += value * value;
  }
  return sum(total);
}

template <int W>
LACUNA_INLINE void triangle_kernel(const TileView& tile, double* triangle) {
  for (Index j = 0; j < tile.columns; ++j) {
    const double* column = tile.data + j * tile.stride;
    const double tail = squared_norm<W>(column, tile.rows);
    if (tail == 0.0) continue;
    double& pivot = triangle[j * tile.columns + j];
    const double length = std::sqrt(pivot * pivot + tail);
    const double image = pivot > 0.0 ? -length : length;
    const double head = pivot - image;
    reflect_rest<W>(tile, {column, head, -image * head, j}, triangle);
    pivot = image;
  }
}

// N terms times their coefficients are taken off M targets; two vectors of rows share what is
// read of the coefficients.
template <int W, int N, int M>
LACUNA_INLINE void deflate(const TileView& tile, const double* terms, const double* h,
                           Index height, double* targets) {
  using V = typename Lanes<W>::Type;
  for (Index row = 0; row < tile.rows; row += 2 * W) {
    V even[M], odd[M];
    for (int k = 0; k < M; ++k) {
      even[k] = at<W>(targets + k * tile.stride + row).values;
      odd[k] = at<W>(targets + k * tile.stride + row + W).values;
    }
    for (int j = 0; j < N; ++j) {
      V first = at<W>(terms + j * tile.stride + row).values;
      V second = at<W>(terms + j * tile.stride + row + W).values;
      keep_in_register(first);
      keep_in_register(second);
      for (int k = 0; k < M; ++k) {
        V coefficient = h[k * height + j] - V{};
        keep_in_register(coefficient);
        even[k] -= first * coefficient;
        odd[k] -= second * coefficient;
      }
    }
    for (int k = 0; k < M; ++k) {
      at<W>(targets + k * tile.stride + row).values = even[k];
      at<W>(targets + k * tile.stride + row + W).values = odd[k];
    }
  }
}

template <int W, int M>
LACUNA_INLINE void deflate_all(const TileView& tile, const double* h, Index terms,
                               double* targets) {
  constexpr int kTogether = 8;
  Index j = 0;
  for (; j + kTogether <= terms; j += kTogether)
    deflate<W, kTogether, M>(tile, tile.data + j * tile.stride, h + j, terms, targets);
  for (; j < terms; ++j)
    deflate<W, 1, M>(tile, tile.data + j * tile.stride, h + j, terms, targets);
}

template <int W>
LACUNA_INLINE void deflation_kernel(const TileView& tile, const double* h, Index terms) {
  Index k = terms;
  for (; k + kBlock <= tile.columns; k += kBlock, h += kBlock * terms)
    deflate_all<W, kBlock>(tile, h, terms, tile.data + k * tile.stride);
  for (; k < tile.columns; ++k, h += terms)
    deflate_all<W, 1>(tile, h, terms, tile.data + k * tile.stride);
}

struct Kernels {
  void (*gram)(const TileView&, double* gram);
  void (*triangle)(const TileView&, double* triangle);
  void (*deflation)(const TileView&, const double* h, Index terms);
};

void gram_generic(const TileView& tile, double* gram) { gram_kernel<2>(tile, gram); }
void triangle_generic(const TileView& tile, double* r) { triangle_kernel<2>(tile, r); }
void deflation_generic(const TileView& tile, const double* h, Index terms) {
  deflation_kernel<2>(tile, h, terms);
}

#ifdef LACUNA_KERNEL_DISPATCH
[[gnu::target("avx2,fma")]] void gram_avx2(const TileView& tile, double* gram) {
  gram_kernel<4>(tile, gram);
}
[[gnu::target("avx2,fma")]] void triangle_avx2(const TileView& tile, double* r) {
  triangle_kernel<4>(tile, r);
}
[[gnu::target("avx2,fma")]] void deflation_avx2(const TileView& tile, const double* h,
                                                Index terms) {
  deflation_kernel<4>(tile, h, terms);
}
[[gnu::target("avx512f")]] void gram_avx512(const TileView& tile, double* gram) {
  gram_kernel<8>(tile, gram);
}
[[gnu::target("avx512f")]] void triangle_avx512(const TileView& tile, double* r) {
  triangle_kernel<8>(tile, r);
}
[[gnu::target("avx512f")]] void deflation_avx512(const TileView& tile, const double* h,
                                                 Index terms) {
  deflation_kernel<8>(tile, h, terms);
}
#endif

Kernels kernels(InstructionSet set) {
#ifdef LACUNA_KERNEL_DISPATCH
  if (set == InstructionSet::Avx512) return {gram_avx512, triangle_avx512, deflation_avx512};
  if (set == InstructionSet::Avx2) return {gram_avx2, triangle_avx2, deflation_avx2};
#endif
  static_cast<void>(set);
  return {gram_generic, triangle_generic, deflation_generic};
}

InstructionSet detect_instruction_set() {
#ifdef LACUNA_KERNEL_DISPATCH
  if (__builtin_cpu_supports("avx512f")) return InstructionSet::Avx512;
  if (has_avx2()) return InstructionSet::Avx2;
#endif
  return InstructionSet::Generic;
}

}  // namespace

InstructionSet best_instruction_set() {
  static const InstructionSet best = detect_instruction_set();
  return best;
}

std::string_view name_of(InstructionSet set) {
  if (set == InstructionSet::Avx512) return "avx512";
  return set == InstructionSet::Avx2 ? "avx2" : "generic";
}

void add_gram(const Scratch& tile, Index rows, Matrix& gram, InstructionSet set) {
  // The view could be written through; this kernel only reads.
  kernels(set).gram({const_cast<double*>(tile.data()), tile.stride(),
                     Scratch::padded_rows(rows), tile.padded_columns()},
                    gram.data());
}

void fold_triangle(Scratch& tile, Index rows, Matrix& triangle, InstructionSet set) {
  kernels(set).triangle(
      {tile.data(), tile.stride(), Scratch::padded_rows(rows), tile.columns()},
      triangle.data());
}

void deflate_targets(Scratch& tile, Index rows, const Matrix& h, InstructionSet set) {
  kernels(set).deflation(
      {tile.data(), tile.stride(), Scratch::padded_rows(rows), tile.columns()}, h.data(),
      h.rows());
}

}  // namespace lacuna
