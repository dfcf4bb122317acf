// SPDX-License-Identifier: MIT
// The filters of lacuna. Each function makes one from its options;
// Registry has the same by name.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "lacuna/core/base/options.hpp"
#include "lacuna/regression/stages/solvers.hpp"

namespace lacuna {

/// Options of no_filter(): none.
struct NoFilterOptions {
  static constexpr StageInfo kInfo{"none", "Keeps every term except columns of zeros.", ""};

  void describe(OptionVisitor&) {}
};

/// Keeps every term whose column has a norm above 0; nothing else can have a coefficient.
Stage<TermFilter> no_filter(const NoFilterOptions& options = {});

/// Options of abm().
struct AbmOptions {
  /// In which units eps is understood.
  enum class Tolerances {
    Relative,  ///< columns scaled to unit norm: independent of n, of units and of time scale
    Paper,     ///< columns as they are, as published
  };

  static constexpr StageInfo kInfo{
      "abm", "Adds terms in library order unless the terms already there express them.",
      "Kera & Hasegawa, Nonlinear Dynamics 85 (2016) 675; Karimov et al. 2023, Sect. 2.1"};
  static constexpr std::array<std::string_view, 2> kTolerances{"relative", "paper"};

  Tolerances tolerances = Tolerances::Relative;
  std::optional<double> eps = {};

  /// eps, or the default of the chosen tolerances.
  double effective_eps() const {
    return eps.value_or(tolerances == Tolerances::Relative ? 1e-16 : 1e-5);
  }

  void describe(OptionVisitor& v) {
    v.field({"tolerances", "",
             "'relative': eps refers to columns of unit norm; 'paper': to raw data."},
            kTolerances, tolerances);
    v.field({"eps", "",
             "Smallest eigenvalue of E'E below which a term vanishes; 1e-16 (relative) or 1e-5 "
             "(paper) when not given.",
             0.0},
            eps);
  }
};

/// Approximate Buchberger-Moeller: goes through the candidates in library order and adds one to
/// E (n x k) when the smallest eigenvalue of E'E with it stays at least eps; else the term is
/// removed as vanishing (a combination of lower terms, up to eps).
///
/// With relative tolerances eps is dimensionless: the default 1e-16 is a singular value of 1e-8
/// of columns of unit norm, so only what is numerically dependent goes. E'E is never formed:
/// columns of the system's triangular factor are orthogonalised one by one and the smallest
/// singular value of the small triangle is found by inverse iteration, O(k^2) a step. Source:
/// Karimov et al. 2023, Sect. 2.1 (ABM).
Stage<TermFilter> abm(const AbmOptions& options = {});

/// Options of svd_filter().
struct SvdFilterOptions {
  static constexpr StageInfo kInfo{
      "svd", "Keeps as many well-conditioned terms as the candidates have numerical rank.",
      "Golub & Van Loan, Matrix Computations, Sect. 5.5.7 (subset selection)"};

  double tolerance = 1e-8;

  void describe(OptionVisitor& v) {
    v.field({"tolerance", "",
             "Singular values of the unit-norm columns below this fraction of the largest "
             "count as zero.",
             0.0, 1.0},
            tolerance);
  }
};

/// Rank-revealing filter: E (n x L, columns of unit norm) = U S V'. The rank r is the number of
/// singular values above tolerance * S_1. The r terms kept are the pivots of a column-pivoted
/// QR of V_r' (r x L), which bounds how much worse than S_r the kept columns' smallest singular
/// value can be. Of columns that serve alike (at least half of the largest remaining norm) the
/// first in library order is taken, so that simple terms are preferred. Independent of n, of
/// units and of time scale.
Stage<TermFilter> svd_filter(const SvdFilterOptions& options = {});

/// Options of vca().
struct VcaOptions {
  static constexpr StageInfo kInfo{
      "vca", "Removes what vanishes on the data degree by degree, plain terms first.",
      "R. Livni et al., Proc. 30th Int. Conf. Machine Learning (2013), PMLR 28, 597-605"};

  double tolerance = 1e-8;

  void describe(OptionVisitor& v) {
    v.field({"tolerance", "",
             "Singular values of the unit-norm columns, without their parts in lower degrees, "
             "below this count as zero.",
             0.0, 1.0},
            tolerance);
  }
};

/// Vanishing component analysis over the terms of the library. With F an orthonormal basis of
/// what the terms of lower degrees span, the columns C of unit norm of the next degree give
///
///   C - F F'C = U S V'.
///
/// Combinations with S_i <= tolerance vanish, given lower degrees; the r others join F, and the
/// pivots of V_r' are the terms kept, as in SvdFilter. So what two degrees express alike is
/// removed from the higher one, which a decomposition of all columns at once does not know. The
/// degree of a term is that of its formula in all variables together, a function of them counts
/// as one variable.
Stage<TermFilter> vca(const VcaOptions& options = {});

}  // namespace lacuna
