// SPDX-License-Identifier: MIT
// Regressors that choose among the terms they are given. Each function makes one from its
// options; `Registry` has the same by name.
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "lacuna/core/base/options.hpp"
#include "lacuna/regression/stages/solvers.hpp"

namespace lacuna {

/// Options of stlsq().
struct StlsqOptions {
  /// What is compared with the threshold.
  enum class Scale {
    Contribution,  ///< |h_j| |theta_j| / |y|: without unit
    Coefficient,   ///< |h_j| in the units of the data
  };

  static constexpr StageInfo kInfo{
      "stlsq", "Least squares with all small terms removed, again and again.",
      "Brunton, Proctor & Kutz, PNAS 113 (2016) 3932"};
  static constexpr std::array<std::string_view, 2> kScales{"contribution", "coefficient"};

  double threshold = 0.01;
  Scale scale = Scale::Contribution;
  std::optional<double> alpha = {};
  int max_iterations = 100;

  void describe(OptionVisitor& v) {
    v.field({"threshold", "", "Smaller terms are removed.", 0.0}, threshold);
    v.field({"scale", "",
             "'contribution': |h_j| |theta_j| / |y|; 'coefficient': |h_j|, depends on units."},
            kScales, scale);
    v.field({"alpha", "",
             "Ridge penalty on the squares of what 'scale' names (times |y|), while terms are "
             "chosen; none when not given.",
             0.0},
            alpha);
    v.field({"max_iterations", "", "Most rounds of removal.", 1.0, 1e6}, max_iterations);
  }
};

/// Sequentially thresholded least squares: fit, remove every term below the threshold, fit
/// again until none is below. With a ridge penalty the terms are chosen on
///   |y - Theta h|^2 + alpha |D h|^2, D = diag |theta_j| (contribution) or identity
///   (coefficient);
/// the coefficients returned are those of plain least squares on the chosen terms.
/// Regression::removed says which term went in which round and at which number.
/// Source: Brunton, Proctor & Kutz 2016, supporting code; `coefficient` as PySINDy has it.
Stage<Regressor> stlsq(const StlsqOptions& options = {});

/// Options of frols().
struct FrolsOptions {
  static constexpr StageInfo kInfo{
      "frols", "Forward selection by orthogonal least squares: the best next term, again.",
      "Chen, Billings & Luo, Int. J. Control 50 (1989) 1873; Billings 2013, ch. 3"};

  std::optional<double> threshold = {};
  double penalty = 1.0;
  int max_terms = 50;

  void describe(OptionVisitor& v) {
    v.field({"threshold", "",
             "Ends when the next term reduces the error by less than this fraction of |y|^2; "
             "by the score when not given.",
             0.0, 1.0},
            threshold);
    v.field({"penalty", "", "Penalty for a term in the score, in log n; 1 is that of the BIC.",
             0.0},
            penalty);
    v.field({"max_terms", "", "Most terms.", 1.0, 1e6}, max_terms);
  }
};

/// Forward regression with orthogonal least squares: takes the term with the largest error
/// reduction ratio
///
///   ERR_j = (w_j' y)^2 / (|w_j|^2 |y|^2),  w_j = theta_j without its parts in the terms taken,
///
/// again and again; ends by `threshold`, or where the score of SubsetScore (BIC) along the way
/// is least. The coefficients are those of least squares on the terms taken.
Stage<Regressor> frols(const FrolsOptions& options = {});

/// Options of best_subset().
struct BestSubsetOptions {
  static constexpr StageInfo kInfo{"best-subset",
                                   "The best of all sets of terms, proved by branch and bound.",
                                   "Furnival & Wilson, Technometrics 16 (1974) 499; Gatu & "
                                   "Kontoghiorghes, J. Comput. Graph. "
                                   "Stat. 15 (2006) 139"};

  int max_terms = 8;
  double penalty = 1.0;
  double most_operations = 2e10;

  void describe(OptionVisitor& v) {
    v.field({"max_terms", "", "Most terms of a set.", 1.0, 1000.0}, max_terms);
    v.field({"penalty", "",
             "Penalty for a term in the score, in log n; 1 is that of the BIC, 0 gives the "
             "best set of max_terms terms.",
             0.0},
            penalty);
    v.field({"most_operations", "",
             "The search ends after about so many; then the set is not proved to be the best "
             "(not converged).",
             1.0},
            most_operations);
  }
};

/// Of all sets of at most `max_terms` terms the one with the least score of SubsetScore,
///
///   2 n log(|y - Theta_S h_S| / |y|) + penalty |S| log n,
///
/// with the coefficients of least squares. Branches of the search are triangles: a branch has
/// columns that all its sets contain, in front, and columns that they may contain. Leaving out
/// the k-th column, for each k, makes the branches below it (those before it are then in all
/// sets); the residual of all columns of a branch bounds those of its sets from below. Columns
/// are ordered by what leaving them out costs, so that most branches end at once.
Stage<Regressor> best_subset(const BestSubsetOptions& options = {});

/// Options of elastic_net().
struct ElasticNetOptions {
  static constexpr StageInfo kInfo{
      "elastic-net",
      "Path of l1 and l2 penalties; least squares on the best set of terms on it.",
      "Zou & Hastie, J. R. Statist. Soc. B 67 (2005) 301; Friedman, Hastie & Tibshirani 2010; "
      "Meinshausen, Comput. Stat. Data Anal. 52 (2007) 374; Zou, J. Am. Stat. Assoc. 101 "
      "(2006) "
      "1418"};

  double mix = 0.9;
  double adaptivity = 0.0;
  int points = 60;
  double range = 1e-6;
  double penalty = 1.0;

  void describe(OptionVisitor& v) {
    v.field({"mix", "", "Fraction of the l1 penalty; 1 is the lasso.", 1e-3, 1.0}, mix);
    v.field({"adaptivity", "",
             "gamma: the l1 penalty of a term is divided by the power gamma of its part of the "
             "least-squares fit; 1 is the adaptive lasso, 0 the same for all.",
             0.0, 10.0},
            adaptivity);
    v.field({"points", "", "Penalties on the path, equally far apart in their logarithm.", 2.0,
             1e5},
            points);
    v.field({"range", "", "Smallest penalty, as a fraction of the one that leaves no term.",
             1e-15, 0.99},
            range);
    v.field({"penalty", "", "Penalty for a term in the score, in log n; 1 is that of the BIC.",
             0.0},
            penalty);
  }
};

/// The elastic net, relaxed: the path of
///
///   min_z |c - R z|^2 / |y|^2 + lambda (mix sum_j v_j |z_j| + (1 - mix) / 2 |z|_2^2),
///
/// columns of unit norm, v_j = (max |z_ls| / |z_ls_j|)^gamma with the least squares z_ls, from
/// the smallest lambda that leaves no term down by `range` gives sets of terms; the one with
/// the least score of SubsetScore (BIC) after least squares is taken, with the coefficients of
/// least squares.
Stage<Regressor> elastic_net(const ElasticNetOptions& options = {});

/// Options of ensemble().
struct EnsembleOptions {
  static constexpr StageInfo kInfo{
      "ensemble", "Thresholded least squares on many resamples; terms that most of them keep.",
      "Fasel, Kutz, Brunton & Brunton, Proc. R. Soc. A 478 (2022) 20210904; Breiman, Machine "
      "Learning 24 (1996) 123; Kuensch, Ann. Statist. 17 (1989) 1217"};

  int bags = 50;
  int blocks = 20;
  int left_out = 0;
  double threshold = 0.01;
  double inclusion = 0.6;

  void describe(OptionVisitor& v) {
    v.field({"bags", "", "Resamples.", 1.0, 1e6}, bags);
    v.field({"blocks", "",
             "Blocks of successive rows that are drawn with replacement; rows near each other "
             "are alike.",
             2.0, 1e6},
            blocks);
    v.field(
        {"left_out", "", "Terms that each resample does not offer, drawn at random.", 0.0, 1e6},
        left_out);
    v.field({"threshold", "", "|h_j theta_j| / |y| below which a resample drops a term.", 0.0},
            threshold);
    v.field({"inclusion", "", "Fraction of the resamples that have to keep a term.", 0.0, 1.0},
            inclusion);
  }
};

/// Bagging of rows and terms: each resample draws blocks of rows with replacement and leaves
/// terms out at random, and is fitted by sequentially thresholded least squares. Terms whose
/// inclusion probability (fraction of the resamples that kept them among those that offered
/// them) is at least `inclusion` get the coefficients of least squares on all rows. Random
/// numbers come from the seed of the run.
Stage<Regressor> ensemble(const EnsembleOptions& options = {});

/// Options of entropic().
struct EntropicOptions {
  static constexpr StageInfo kInfo{
      "entropic",
      "Forward and backward selection by conditional mutual information: outliers do not lead "
      "it.",
      "Almomani, Sun & Bollt, Chaos 30 (2020) 013107; Ince et al., Hum. Brain Mapp. 38 (2017) "
      "1541"};

  int samples = 1000;
  int shuffles = 50;
  double significance = 0.01;
  int max_terms = 50;

  void describe(OptionVisitor& v) {
    v.field({"samples", "", "Rows that terms are chosen from, drawn at random; all of fewer.",
             20.0, 1e6},
            samples);
    v.field({"shuffles", "", "Shuffles of the rows that show what information chance makes.",
             10.0, 1e5},
            shuffles);
    v.field({"significance", "",
             "Probability that one of the terms is taken though none explains anything.",
             1e-300, 1.0},
            significance);
    v.field({"max_terms", "", "Most terms.", 1.0, 1e6}, max_terms);
  }
};

/// Entropic regression. For the terms S that are taken let z_S be their fit to the target y and
/// r_S = y - z_S. The next term is the one that has most information on the target beside the
/// fit,
///
///   max_j I(y; z_{S+j} | z_S) = max_j I(r_S; z_{S+j} - z_S | z_S),
///
/// as long as a shuffle test shows it (chance would make as much with the probability
/// `significance`); then terms j without significant I(y; z_S | z_{S-j}) go, the least first.
/// Differences from the publication: fits minimise the Huber function of the residuals (Irls),
/// not squares, so that outliers do not bend them. Information is that of normal scores, which
/// depends on ranks alone, without their means over ten rows of nearly the same z_S, among
/// which rows are shuffled; a thousand rows cost less than the neighbours of two hundred. The
/// tail of the test is that of chi-squared with one degree of freedom, scaled to the mean of
/// the shuffles, by Bonferroni's bound for all terms that could be next. A constant has no
/// information: the same number of scores of sizes with signs stands for it. Random numbers
/// come from the seed of the run.
Stage<Regressor> entropic(const EntropicOptions& options = {});

/// Options of sr3().
struct Sr3Options {
  /// What the sparse copy is penalised by.
  enum class Penalty {
    L0,       ///< the number of its terms
    L1,       ///< the sum of their sizes
    Clipped,  ///< the same, sizes beyond `clip` counting as that
  };
  static constexpr std::array<std::string_view, 3> kPenalties{"l0", "l1", "clipped"};

  static constexpr StageInfo kInfo{
      "sr3", "Sparse relaxed regularised regression: a sparse copy near the coefficients.",
      "Zheng, Askham, Brunton, Kutz & Aravkin, IEEE Access 7 (2019) 1404; Champion, Zheng, "
      "Aravkin, Brunton & Kutz, IEEE Access 8 (2020) 169259"};

  double threshold = 0.01;
  Penalty penalty = Penalty::L0;
  double clip = 5.0;
  double relaxation = 1.0;
  int max_iterations = 10000;

  void describe(OptionVisitor& v) {
    v.field({"threshold", "", "Terms of the copy below this fraction of |y| are zero.", 0.0},
            threshold);
    v.field({"penalty", "",
             "Of the copy: 'l0' keeps or drops, 'l1' takes the threshold off all terms, "
             "'clipped' off the small ones."},
            kPenalties, penalty);
    v.field({"clip", "thresholds", "Size from which 'clipped' lets terms be.", 1.0, 1e9}, clip);
    v.field(
        {"relaxation", "",
         "nu: how far the copy may be from the coefficients; columns have unit norm.", 1e-9},
        relaxation);
    v.field({"max_iterations", "", "Most steps.", 1.0, 1e9}, max_iterations);
  }
};

/// Relaxed sparse regression in columns of unit norm, z_j = h_j |theta_j|:
///
///   min_{z,w} 1/2 |c - R z|^2 + 1/(2 nu) |z - w|^2 + lambda p(w),
///   z <- (R'R + I/nu)^-1 (R'c + w/nu),   w <- argmin_w 1/2 |z - w|^2 + nu lambda p(w).
///
/// With the limit t = threshold |y| the last step is, entry by entry,
///
///   l0:       z where |z| >= t, else 0                          (nu lambda = t^2 / 2)
///   l1:       sign(z) max(|z| - t, 0)                           (nu lambda = t)
///   clipped:  z where |z| >= (clip + 1/2) t, else that of l1    (p = sum min(|w|, clip t)).
///
/// Starts with w of least squares. Each step lowers the objective. The terms of w get the
/// coefficients of plain least squares.
Stage<Regressor> sr3(const Sr3Options& options = {});

}  // namespace lacuna
