// SPDX-License-Identifier: MIT
// The pruners of lacuna. Each function makes one from its options;
// Registry has the same by name.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "lacuna/core/base/options.hpp"
#include "lacuna/core/numerics/negligible.hpp"
#include "lacuna/regression/stages/solvers.hpp"

namespace lacuna {

/// Options of keep_all(): none.
struct KeepAllOptions {
  static constexpr StageInfo kInfo{"keep-all", "Keeps every term that the filter left.", ""};

  void describe(OptionVisitor&) {}
};

/// Keeps every active term, e.g. where the regressor chooses them itself.
Stage<TermPruner> keep_all(const KeepAllOptions& options = {});

/// Options of minor_terms().
struct MinorTermsOptions {
  /// When it stops.
  enum class Tolerances {
    Relative,  ///< by the residual, without units; see Stop
    Paper,     ///< before |residual| / n exceeds eta, raw, as in the authors' toolbox
  };
  /// Which term is next with relative tolerances.
  enum class Criterion {
    Contribution,  ///< the smallest |h_i tau_i|, as published
    Residual,      ///< the one whose loss raises the residual least
  };

  /// When it stops with relative tolerances.
  enum class Stop {
    Errors,  ///< where the residual is more than the errors of the targets explain
    Jump,    ///< before the first large jump of the residual
  };

  static constexpr StageInfo kInfo{
      "minor-terms", "Drops the least important term and refits while the fit stays good.",
      "Kera & Hasegawa, Nonlinear Dynamics 85 (2016) 675; Karimov et al. 2023, Sect. 2.1"};
  static constexpr std::array<std::string_view, 2> kTolerances{"relative", "paper"};
  static constexpr std::array<std::string_view, 2> kCriteria{"contribution", "residual"};
  static constexpr std::array<std::string_view, 2> kStops{"errors", "jump"};

  Tolerances tolerances = Tolerances::Relative;
  Criterion criterion = Criterion::Residual;
  Stop stop = Stop::Errors;
  std::optional<double> eta = {};
  double jump = 0.4;
  double resolution = 1e-11;
  NegligibleTerms negligible = {};

  /// eta, or the default of the chosen tolerances.
  double effective_eta() const {
    return eta.value_or(tolerances == Tolerances::Relative ? 0.0025 : 1e-5);
  }

  void describe(OptionVisitor& v) {
    v.field({"tolerances", "",
             "'relative': by the residual, see 'stop'; 'paper': while |residual| / n <= eta, "
             "raw."},
            kTolerances, tolerances);
    v.field({"stop", "",
             "relative: 'errors', at more residual than noise and systematic errors of the "
             "targets explain ('jump' where those are not known); 'jump', before its first "
             "large jump."},
            kStops, stop);
    v.field(
        {"criterion", "",
         "Next to go: smallest |h tau| ('contribution', always so in 'paper') or least loss "
         "of fit ('residual')."},
        kCriteria, criterion);
    v.field({"eta", "",
             "jump: growth of the residual that is no growth, 0.0025 when not given; paper: "
             "the largest |residual| / n, 1e-5 when not given.",
             0.0},
            eta);
    v.field({"jump", "",
             "jump: a jump of this fraction (logarithmic) of the largest one is the first that "
             "counts; 0: every growth beyond eta does.",
             0.0, 1.0},
            jump);
    v.field(
        {"resolution", "",
         "relative: residuals below this fraction of |y| and of the terms count as rounding.",
         0.0, 1.0},
        resolution);
    negligible.describe(v);
  }
};

/// delMinorTerms: drops the least important term, refits with the pipeline's regressor, and
/// goes on while the fit is acceptable; the terms there before the first unacceptable step are
/// kept.
///
/// Paper tolerances: |y - Theta_A h| / n <= eta, and nothing is dropped when already the fit of
/// all terms is worse. This eta depends on the number of samples, on units and on time scale.
///
/// Relative tolerances: r_k is |y - Theta_A h| after k terms were dropped.
///
/// Stop by errors, where the system knows its targets' systematic error T (rms): spurious
/// terms can have fitted no more than that error, and of the noise each about one in n. Terms
/// are dropped while
///   r_k^2 <= r^2 (1 + k ln(n) / n) + n T^2,   r = max(r_0, resolution),
/// with Schwarz' penalty ln n of a term (Ann. Statist. 6:461-464, 1978), and then while they
/// are negligible beside the rate (NegligibleTerms).
///
/// Stop by jump: noise gives r_0 and
/// hardly more as spurious terms leave; the truncation error of finite differences, which
/// spurious terms fit in part, lets r_k rise by a factor of up to some hundred, but bit by bit.
/// In both cases the first true term that leaves makes a jump. It is looked for in the excess
///   D_k = max(r_k^2 - r^2, ((1 + eta)^2 - 1) r^2),   r = max(r_0, resolution),
/// along the whole path down to no term: g_k = ln(D_k+1 / D_k), and dropping stops before the
/// first g_k >= jump * max g. Nothing of this depends on n, on units or on time scale.
///
/// Equations of Rossler (h = 0.1 and 0.02) and Lorenz (h = 0.01), n = 1e4, found exactly, of
/// 36 with exact derivatives (9..56 terms), 144 with differences of order 2, 4, 6, 10 without
/// noise, 234 with 0.01..2 % noise (order 4..10, Savitzky-Golay; 10 and 20 terms):
///
///   rule                        criterion      exact  no noise  noise
///   r_k <= 1.05 r_0             contribution      36        32    173
///   r_k <= 1.05 r_0             residual          36        34    174
///   r_k <= 2 r_0                residual          36        76    156
///   jump 0.4 (default)          contribution      36       116    192
///   jump 0.4 (default)          residual          36       124    195
Stage<TermPruner> minor_terms(const MinorTermsOptions& options = {});

/// Options of sequential_thresholding().
struct SequentialThresholdingOptions {
  static constexpr StageInfo kInfo{"sequential-thresholding",
                                   "Drops all small terms, refits, and repeats until none is.",
                                   "Brunton, Proctor & Kutz, PNAS 113 (2016) 3932"};

  double threshold = 0.01;

  void describe(OptionVisitor& v) {
    v.field({"threshold", "", "Terms with |h_i theta_i| / |y| below this are dropped.", 0.0},
            threshold);
  }
};

/// Drops every term with |h_i theta_i| < threshold |y|, refits with the pipeline's regressor,
/// and repeats until no term is that small. Independent of n, of units and of time scale.
Stage<TermPruner> sequential_thresholding(const SequentialThresholdingOptions& options = {});

/// Options of information_criterion().
struct InformationCriterionOptions {
  /// What is minimised.
  enum class Criterion {
    Bic,           ///< n ln(RSS / n) + k ln n
    Aicc,          ///< n ln(RSS / n) + 2 k + 2 k (k + 1) / (n - k - 1)
    EffectiveBic,  ///< BIC with n / tau for n, tau by serial_correlation()
  };

  static constexpr StageInfo kInfo{
      "information-criterion",
      "Backward elimination to the number of terms that an information criterion prefers.",
      "Schwarz, Ann. Stat. 6 (1978) 461; Hurvich & Tsai, Biometrika 76 (1989) 297"};
  static constexpr std::array<std::string_view, 3> kCriteria{"bic", "aicc", "bic-effective"};

  Criterion criterion = Criterion::Bic;
  double resolution = 1e-11;

  void describe(OptionVisitor& v) {
    v.field({"criterion", "", "Which criterion is minimised."}, kCriteria, criterion);
    v.field(
        {"resolution", "",
         "Residuals below this fraction of |y| and of the terms count as rounding.", 0.0, 1.0},
        resolution);
  }
};

/// Takes out, one by one, the term whose loss raises the residual least, refitting each time,
/// and keeps the set with the smallest BIC or AICc, RSS = |y - Theta_A h|^2. Right where the
/// residual is independent noise; where it is not, n rows are not n independent ones and too
/// many terms stay: the effective BIC counts as many rows as the residuals of all terms are
/// worth. The systematic error of a derivative is predictable, and terms that describe it stay.
/// Depends on n as the criteria do, not on units or time scale.
Stage<TermPruner> information_criterion(const InformationCriterionOptions& options = {});

/// Options of cross_validation().
struct CrossValidationOptions {
  static constexpr StageInfo kInfo{
      "cross-validation",
      "Backward elimination to the fewest terms that predict blocks left out as well as any.",
      "Burman, Chow & Nolan, Biometrika 81 (1994) 351; Breiman et al., CART (1984) 78"};

  int blocks = 10;
  double standard_errors = 1.0;
  double resolution = 1e-11;

  void describe(OptionVisitor& v) {
    v.field({"blocks", "", "Contiguous blocks of rows, each left out once.", 2.0, 1000.0},
            blocks);
    v.field(
        {"standard_errors", "",
         "So many standard errors above the least prediction error are as good as it.", 0.0},
        standard_errors);
    v.field(
        {"resolution", "",
         "Residuals below this fraction of |y| and of the terms count as rounding.", 0.0, 1.0},
        resolution);
  }
};

/// The number of terms by h-block cross-validation, the terms by backward elimination.
///
/// The rows are divided into B contiguous blocks. Each is left out once, with a gap to either
/// side as long as the residuals of all terms are correlated (serial_correlation), at most half
/// a block: neighbours in time would determine the block beforehand. In the other rows the
/// terms leave one by one, the one whose loss raises the residual least first, and each set
/// predicts the block, by least squares:
///
///   e_bk = |y_b - Theta_b h_k|^2, h_k fitted with k terms to the rows outside of b and its
///   gaps.
///
/// The smallest k is taken whose sum of e exceeds the least one by no more than so many
/// standard errors of the difference, from its scatter over the blocks. k terms are then left
/// of the elimination in all rows with the given regressor. Depends on the noise of the record
/// only through what it makes of predictions; needs neither its size nor a threshold.
Stage<TermPruner> cross_validation(const CrossValidationOptions& options = {});

}  // namespace lacuna
