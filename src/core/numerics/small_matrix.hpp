// SPDX-License-Identifier: MIT
// Vectors and square matrices of a few rows for the recursions of filter and smoother. Columns
// are padded to a multiple of four rows, which are 0 and stay 0, so that all is done in lanes.
#pragma once

#include <Eigen/Core>

#include "core/numerics/lanes.hpp"

namespace lacuna {

constexpr Index padded_to_lanes(Index rows) { return (rows + kLane - 1) / kLane * kLane; }

/// How large things are: `states` of a model, and what only decays behind them.
/// @tparam Size number of columns, padded ones too, or Eigen::Dynamic.
/// @tparam Exact whether all columns are states.
template <int Size, bool Exact>
class Shape {
 public:
  static constexpr bool kFixed = Size != Eigen::Dynamic;
  static constexpr bool kExact = Exact;
  static constexpr int kStride = kFixed ? static_cast<int>(padded_to_lanes(Size)) : 0;
  using Column = Numbers<kFixed ? kStride : Eigen::Dynamic>;
  using Square = Numbers<kFixed ? kStride * Size : Eigen::Dynamic>;

  Shape(Index size, Index states) : size_(size), states_(states) {}

  LACUNA_INLINE Index size() const { return kFixed ? Size : size_; }
  LACUNA_INLINE Index stride() const { return kFixed ? kStride : padded_to_lanes(size_); }
  LACUNA_INLINE Index states() const { return Exact ? Size : states_; }
  Column column() const { return Column(stride()); }
  Square square() const { return Square(stride() * size()); }

 private:
  Index size_, states_;
};

/// Calls `work(shape)` with the shape of `size` columns of which `states` are states.
template <class Work>
decltype(auto) with_shape(Index size, Index states, Work&& work) {
  if (size == states) switch (size) {
      case 1:
        return work(Shape<1, true>(size, states));
      case 2:
        return work(Shape<2, true>(size, states));
      case 3:
        return work(Shape<3, true>(size, states));
      case 4:
        return work(Shape<4, true>(size, states));
      case 8:
        return work(Shape<8, true>(size, states));
      default:
        break;
    }
  if (size <= 4) return work(Shape<4, false>(size, states));
  if (size <= 8) return work(Shape<8, false>(size, states));
  if (size <= 16) return work(Shape<16, false>(size, states));
  return work(Shape<Eigen::Dynamic, false>(size, states));
}

/// At most four numbers, the other lanes 0. @param step from one to the next.
LACUNA_INLINE void load_some(const double* from, Index count, Index step, Pack& pack) {
  pack = Pack{};
  if (count > 0) pack[0] = from[0];
  if (count > 1) pack[1] = from[step];
  if (count > 2) pack[2] = from[2 * step];
  if (count > 3) pack[3] = from[3 * step];
}

/// out = sum of x[k] a_k over the first `count` columns.
template <class S>
LACUNA_INLINE void multiply(const S& shape, const double* a, const double* x, Index count,
                            double* out) {
  for (Index p = 0; p < shape.stride(); p += kLane) {
    Pack total = {};
    for (Index k = 0; k < count; ++k)
      total += x[k] * at<kLane>(a + k * shape.stride() + p).values;
    at<kLane>(out + p).values = total;
  }
}

template <class S>
LACUNA_INLINE double dot(const S& shape, const double* a, const double* b) {
  Pack total = {};
  for (Index p = 0; p < shape.stride(); p += kLane)
    total += at<kLane>(a + p).values * at<kLane>(b + p).values;
  return sum(total);
}

/// x += factor y.
template <class S>
LACUNA_INLINE void add(const S& shape, double factor, const double* y, double* x) {
  for (Index p = 0; p < shape.stride(); p += kLane)
    at<kLane>(x + p).values += factor * at<kLane>(y + p).values;
}

/// m += factor left right'.
template <class S>
LACUNA_INLINE void add_outer(const S& shape, double factor, const double* left,
                             const double* right, double* m) {
  for (Index p = 0; p < shape.stride(); p += kLane) {
    const Pack rows = factor * at<kLane>(left + p).values;
    for (Index j = 0; j < shape.size(); ++j)
      at<kLane>(m + j * shape.stride() + p).values += right[j] * rows;
  }
}

/// Some columns of a product, kept in registers. @param down, across steps from one element of
/// the right factor to the next in its column and its row.
template <int Together, class S>
LACUNA_INLINE void product_columns(const S& shape, const double* a, const double* b, Index down,
                                   Index across, double* out) {
  for (Index p = 0; p < shape.stride(); p += kLane) {
    Pack total[Together] = {};
    if constexpr (!S::kExact)
      for (int j = 0; j < Together; ++j)
        total[j] = at<kLane>(out + j * shape.stride() + p).values;
    for (Index k = 0; k < shape.states(); ++k) {
      const Pack left = at<kLane>(a + k * shape.stride() + p).values;
      for (int j = 0; j < Together; ++j) total[j] += b[k * down + j * across] * left;
    }
    for (int j = 0; j < Together; ++j)
      at<kLane>(out + j * shape.stride() + p).values = total[j];
  }
}

/// The first `columns` columns of a b, over the columns of a that are states' (exact shapes),
/// or of out + a b.
template <class S>
LACUNA_INLINE void product(const S& shape, const double* a, const double* b, Index down,
                           Index across, Index columns, double* out) {
  constexpr int kTogether = 4;
  Index j = 0;
  for (; j + kTogether <= columns; j += kTogether)
    product_columns<kTogether>(shape, a, b + j * across, down, across,
                               out + j * shape.stride());
  for (; j < columns; ++j)
    product_columns<1>(shape, a, b + j * across, down, across, out + j * shape.stride());
}

}  // namespace lacuna
