// SPDX-License-Identifier: MIT
// Numbers of the library as arrays of NumPy.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <memory>
#include <optional>
#include <utility>

#include "lacuna/core/base/types.hpp"

namespace lacuna::python {

namespace nb = nanobind;

/// An array on numbers that `owner` has, which lives as long as the array does.
/// @param columns of a matrix in column-major order; nothing: a vector.
template <class Owner>
nb::object view_of(Owner owner, const double* values, Index rows,
                   std::optional<Index> columns = {}) {
  auto* const kept = new Owner(std::move(owner));
  const nb::capsule keeper(kept, [](void* p) noexcept { delete static_cast<Owner*>(p); });
  const std::size_t shape[] = {static_cast<std::size_t>(rows),
                               static_cast<std::size_t>(columns.value_or(1))};
  const std::int64_t strides[] = {1, static_cast<std::int64_t>(rows)};
  const std::size_t dimensions = columns ? 2 : 1;
  return nb::cast(
      nb::ndarray<nb::numpy, const double>(values, dimensions, shape, keeper, strides));
}

/// An array with numbers of its own.
inline nb::object array_of(Matrix values) {
  auto kept = std::make_shared<const Matrix>(std::move(values));
  return view_of(kept, kept->data(), kept->rows(), kept->cols());
}

inline nb::object array_of(Vector values) {
  auto kept = std::make_shared<const Vector>(std::move(values));
  return view_of(kept, kept->data(), kept->size());
}

}  // namespace lacuna::python
