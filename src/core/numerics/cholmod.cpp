// SPDX-License-Identifier: MIT
#include <cholmod.h>

#include <memory>

#include "lacuna/core/base/error.hpp"
#include "core/numerics/sparse_cholesky.hpp"

namespace lacuna {
namespace {

static_assert(sizeof(SuiteSparse_long) == sizeof(Index));

/// Settings and memory of one factorisation.
struct Cholmod {
  Cholmod() {
    cholmod_l_start(&common);
    common.supernodal = CHOLMOD_SIMPLICIAL;
    common.final_ll = 1;
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_NATURAL;
    common.postorder = 0;
    common.print = 0;
  }
  ~Cholmod() { cholmod_l_finish(&common); }
  Cholmod(const Cholmod&) = delete;
  Cholmod& operator=(const Cholmod&) = delete;

  cholmod_common common;
};

/// The compressed rows of a symmetric matrix, which are its columns too.
cholmod_sparse symmetric_view(const SparseRows& matrix) {
  cholmod_sparse view{};
  view.nrow = view.ncol = static_cast<std::size_t>(matrix.rows());
  view.nzmax = static_cast<std::size_t>(matrix.nonZeros());
  view.p = const_cast<Index*>(matrix.outerIndexPtr());
  view.i = const_cast<Index*>(matrix.innerIndexPtr());
  view.x = const_cast<double*>(matrix.valuePtr());
  view.stype = -1;
  view.itype = CHOLMOD_LONG;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = view.packed = 1;
  return view;
}

}  // namespace

SparseRows sparse_cholesky(const SparseRows& matrix) {
  SparseRows packed = matrix;
  packed.makeCompressed();
  Cholmod cholmod;
  cholmod_sparse view = symmetric_view(packed);
  const auto free_factor = [&](cholmod_factor* f) {
    cholmod_l_free_factor(&f, &cholmod.common);
  };
  const std::unique_ptr<cholmod_factor, decltype(free_factor)> factor(
      cholmod_l_analyze(&view, &cholmod.common), free_factor);
  if (factor) cholmod_l_factorize(&view, factor.get(), &cholmod.common);
  if (cholmod.common.status == CHOLMOD_OUT_OF_MEMORY) throw std::bad_alloc();
  if (!factor || cholmod.common.status != CHOLMOD_OK)
    throw ArgumentError("sparse_cholesky", "the matrix is not positive definite",
                        "leave out rows that depend on each other");
  const auto free_sparse = [&](cholmod_sparse* s) {
    cholmod_l_free_sparse(&s, &cholmod.common);
  };
  const std::unique_ptr<cholmod_sparse, decltype(free_sparse)> lower(
      cholmod_l_factor_to_sparse(factor.get(), &cholmod.common), free_sparse);
  if (!lower) throw std::bad_alloc();
  const auto* starts = static_cast<const Index*>(lower->p);
  using Columns = Eigen::SparseMatrix<double, Eigen::ColMajor, Index>;
  return SparseRows(Eigen::Map<const Columns>(
      matrix.rows(), matrix.cols(), starts[matrix.cols()], starts,
      static_cast<const Index*>(lower->i), static_cast<const double*>(lower->x)));
}

std::string sparse_cholesky_back_end() { return "CHOLMOD"; }

}  // namespace lacuna
