// SPDX-License-Identifier: MIT
// Eigen's kernels of products and of triangular solutions in doubles are compiled in one
// source: else each of the forty folders that multiply matrices has its own. Every source of
// the library reads this first (CMakeLists.txt); what is not listed is compiled where it is
// used.
#pragma once

#include <Eigen/Core>

namespace lacuna::product_kernels {

/// How a kernel reads a factor that lies by columns or by rows, and a result by columns.
using Columns = Eigen::internal::const_blas_data_mapper<double, Eigen::Index, Eigen::ColMajor>;
using Rows = Eigen::internal::const_blas_data_mapper<double, Eigen::Index, Eigen::RowMajor>;
using Result = Eigen::internal::blas_data_mapper<double, Eigen::Index, Eigen::ColMajor>;

/// Sizes of the blocks on this machine.
using Blocks = Eigen::internal::gebp_traits<double, double>;

}  // namespace lacuna::product_kernels

/// All of them. @param how `extern template`, or `template` in the one source.
#define LACUNA_PRODUCT_KERNELS(how)                                              \
  how struct gebp_kernel<double, double, Index, lacuna::product_kernels::Result, \
                         lacuna::product_kernels::Blocks::mr,                    \
                         lacuna::product_kernels::Blocks::nr, false, false>;     \
  LACUNA_VECTOR_KERNEL(how, Columns, ColMajor, Columns);                         \
  LACUNA_VECTOR_KERNEL(how, Columns, ColMajor, Rows);                            \
  LACUNA_VECTOR_KERNEL(how, Rows, RowMajor, Columns);                            \
  LACUNA_LEFT_BLOCKS(how, Columns, ColMajor, false);                             \
  LACUNA_LEFT_BLOCKS(how, Rows, RowMajor, false);                                \
  LACUNA_LEFT_BLOCKS(how, Result, ColMajor, true);                               \
  LACUNA_RIGHT_BLOCKS(how, Columns, ColMajor, false);                            \
  LACUNA_RIGHT_BLOCKS(how, Rows, RowMajor, false);                               \
  LACUNA_RIGHT_BLOCKS(how, Rows, RowMajor, true);                                \
  LACUNA_RIGHT_BLOCKS(how, Result, ColMajor, true);                              \
  LACUNA_SOLUTION(how, OnTheLeft, Lower, ColMajor);                              \
  LACUNA_SOLUTION(how, OnTheLeft, Lower, RowMajor);                              \
  LACUNA_SOLUTION(how, OnTheLeft, Upper, ColMajor);                              \
  LACUNA_SOLUTION(how, OnTheLeft, Upper, RowMajor);                              \
  LACUNA_SOLUTION(how, OnTheLeft, UnitLower, ColMajor);                          \
  LACUNA_SOLUTION(how, OnTheRight, Upper, RowMajor)

#define LACUNA_VECTOR_KERNEL(how, matrix, order, vector)                                   \
  how struct general_matrix_vector_product<Index, double, lacuna::product_kernels::matrix, \
                                           order, false, double,                           \
                                           lacuna::product_kernels::vector, false, 0>

#define LACUNA_LEFT_BLOCKS(how, matrix, order, panels)                                     \
  how struct gemm_pack_lhs<                                                                \
      double, Index, lacuna::product_kernels::matrix, lacuna::product_kernels::Blocks::mr, \
      lacuna::product_kernels::Blocks::LhsProgress,                                        \
      lacuna::product_kernels::Blocks::LhsPacket4Packing, order, false, panels>

#define LACUNA_RIGHT_BLOCKS(how, matrix, order, panels)                    \
  how struct gemm_pack_rhs<double, Index, lacuna::product_kernels::matrix, \
                           lacuna::product_kernels::Blocks::nr, order, false, panels>

#define LACUNA_SOLUTION(how, side, part, order) \
  how struct triangular_solve_matrix<double, Index, side, part, false, order, ColMajor, 1>

namespace Eigen::internal {
LACUNA_PRODUCT_KERNELS(extern template);
}  // namespace Eigen::internal
