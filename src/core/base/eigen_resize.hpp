// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <complex>

// Eigen 3.4 frees the memory of a matrix before it asks for more, and keeps the old pointer:
// where there is no more memory the destructor frees it again. These members forget it first,
// so that std::bad_alloc leaves an empty matrix. The build puts this file in front of every
// source of the library (CMakeLists.txt); always inline, so that no other copy of the function
// takes part.
#if EIGEN_WORLD_VERSION == 3 && EIGEN_MAJOR_VERSION == 4
namespace Eigen {

#define LACUNA_RESIZE(Scalar, Rows, Cols, Options, FORGET_SIZE, SET_SIZE)                \
  template <>                                                                            \
  EIGEN_ALWAYS_INLINE void DenseStorage<Scalar, Dynamic, Rows, Cols, Options>::resize(   \
      Index size, [[maybe_unused]] Index rows, [[maybe_unused]] Index cols) {            \
    const Index before = this->rows() * this->cols();                                    \
    if (size != before) {                                                                \
      Scalar* const old = m_data;                                                        \
      m_data = nullptr;                                                                  \
      FORGET_SIZE;                                                                       \
      internal::conditional_aligned_delete_auto<Scalar, true>(old, before);              \
      if (size > 0) m_data = internal::conditional_aligned_new_auto<Scalar, true>(size); \
    }                                                                                    \
    SET_SIZE;                                                                            \
  }
#define LACUNA_RESIZE_ALL(Scalar)                                        \
  LACUNA_RESIZE(Scalar, Dynamic, Dynamic, ColMajor, m_rows = m_cols = 0, \
                (m_rows = rows, m_cols = cols))                          \
  LACUNA_RESIZE(Scalar, Dynamic, Dynamic, RowMajor, m_rows = m_cols = 0, \
                (m_rows = rows, m_cols = cols))                          \
  LACUNA_RESIZE(Scalar, Dynamic, 1, ColMajor, m_rows = 0, m_rows = rows) \
  LACUNA_RESIZE(Scalar, 1, Dynamic, RowMajor, m_cols = 0, m_cols = cols)

LACUNA_RESIZE_ALL(double)
LACUNA_RESIZE_ALL(std::complex<double>)
LACUNA_RESIZE_ALL(Index)
LACUNA_RESIZE_ALL(int)
LACUNA_RESIZE_ALL(bool)

#undef LACUNA_RESIZE_ALL
#undef LACUNA_RESIZE

}  // namespace Eigen
#endif
