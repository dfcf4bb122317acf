// SPDX-License-Identifier: MIT
// The differentiators of lacuna. Each function makes one from its options;
// Registry has the same by name.
#pragma once

#include <optional>

#include "lacuna/core/base/options.hpp"
#include "lacuna/data/derivatives/differentiator.hpp"

namespace lacuna {

/// Options of automatic_differentiator().
struct AutomaticDifferentiatorOptions {
  static constexpr StageInfo kInfo{
      "auto", "The differentiator with the least error predicted for the records",
      "B. Efron, R. J. Tibshirani, An Introduction to the Bootstrap, 1993, ch. 6"};

  int draws = 3;

  void describe(OptionVisitor& v) {
    v.field({"draws", "", "Noisy copies on which the error of each differentiator is measured.",
             1.0, 1000.0},
            draws);
  }
};

/// Chooses among the differentiators by a parametric bootstrap. Pilots are smoothed records
/// with known derivatives: the three of SmoothingSpline, KalmanSmoother, Spectral and
/// TrendFilter with the least estimated error of the signal,
///
///   |y - signal|^2 / noise^2 - n + 2 trace(d signal / d y)
///
/// (C. Stein, Annals of Statistics 9 (1981), the trace by random changes of y: S. Ramani,
/// T. Blu, M. Unser, IEEE Transactions on Image Processing 17 (2008), eq. (13)). Each gets
/// white noise of the size that is estimated in the record, and every differentiator, fitted
/// anew, is measured by
///
///   sum over pilots and states of log mean (rate - rate of the pilot)^2
///
/// over `draws` copies, of the middle of the longest record (1024 samples at most). The seed is
/// fixed. A record whose noise cannot be distinguished from its signal gets finite differences.
Stage<Differentiator> automatic_differentiator(
    const AutomaticDifferentiatorOptions& options = {});

/// Options of finite_differences().
struct FiniteDifferencesOptions {
  static constexpr StageInfo kInfo{
      "finite-differences",
      "Differences of any even order of accuracy on uniform and other grids; no smoothing",
      "B. Fornberg, Math. Comp. 51 (1988) 699-706"};

  std::optional<int> order = {};  ///< of accuracy, even; without it, chosen from the record

  void describe(OptionVisitor& v) {
    v.field(
        {"order", "",
         "Order of accuracy p: the error falls as step^p; even. Chosen from the record when "
         "not given.",
         2.0, 20.0},
        order);
  }
};

/// The k-th derivative by the polynomial through the nearest samples.
///
///   x^(k)(t_i) = sum_j w_j x(t_j) + O(h^p)
///
/// Inside a uniform grid the stencil is central, with p/2 + (k-1)/2 (rounded down) samples to
/// either side; near the ends and on other grids it takes the p + k samples nearest in number,
/// of the same order of accuracy. k = 0 gives the values. Needs p + k samples.
///
/// Without an order, p is chosen from 2, 4, .., 20 for the longest record such that
///
///   sum_k (T_pk^2 + g_p^2 s_k^2 / n) / rms(D_p x_k)^2
///
/// is least; g_p^2 is the sum of the squared weights, s_k the noise (estimate_noise(), and
/// no less than rounding leaves). Noise is counted with 1/n because a fit to n samples averages
/// it, while truncation is the same everywhere in state space and passes into the coefficients.
///
/// The truncation error T_p comes from t_p, the rms of D_{p+2} x - D_p x without what noise
/// contributes to it (0 where no more is left than chance leaves in one of 40 cases): what is
/// still to come is the geometric series T_p = t_p / (1 - t_p / t_{p-2}), the ratio at most
/// 0.9 (that of t_4 and t_2 for p = 2).
Stage<Differentiator> finite_differences(const FiniteDifferencesOptions& options = {});

/// Options of savitzky_golay().
struct SavitzkyGolayOptions {
  static constexpr StageInfo kInfo{
      "savitzky-golay", "Derivatives of a polynomial fitted to the samples in a moving window",
      "A. Savitzky, M. J. E. Golay, Anal. Chem. 36 (1964) 1627-1639"};

  std::optional<int> window = {};  ///< samples, odd; without it, chosen from the record
  int degree = 4;                  ///< of the polynomial, below window

  void describe(OptionVisitor& v) {
    v.field({"window", "samples",
             "Length of the moving window; odd. Chosen from the record when not given.", 3.0,
             100001.0},
            window);
    v.field({"degree", "", "Degree of the polynomial; below the window.", 1.0, 20.0}, degree);
  }
};

/// Smoothing differentiator: at each sample the k-th derivative of the polynomial of degree d
/// that fits the `window` samples around it best; k = 0 smooths.
///
/// The first and last (window-1)/2 samples take the derivative, off centre, of the first and
/// the last window's polynomial. On a grid that is not uniform each sample has a fit of its own
/// in time scaled to the window. Needs `window` samples.
///
/// Without a window, that of degree + 2, and on by a quarter, to half the record (1001 samples
/// at most) is taken which has the least generalised cross-validation of the samples that all
/// of them see from both sides,
///
///   sum over states of log RSS - 2 log(1 - w_0),   w_0 the weight of a sample for itself,
///
/// one for all states and records.
Stage<Differentiator> savitzky_golay(const SavitzkyGolayOptions& options = {});

/// Options of local_polynomial().
struct LocalPolynomialOptions {
  static constexpr StageInfo kInfo{
      "local-polynomial", "Weighted polynomials around each time, as wide as the signal allows",
      "J. Fan, I. Gijbels, Local Polynomial Modelling, 1996; A. Goldenshluger, A. Nemirovski, "
      "Math. Methods Stat. 6 (1997) 135-170"};

  int degree = 3;
  std::optional<double> width = {};

  void describe(OptionVisitor& v) {
    v.field({"degree", "", "Of the polynomials.", 2.0, 10.0}, degree);
    v.field({"width", "time",
             "Half width of the weights; at each sample as the signal allows when not given.",
             1e-300},
            width);
  }
};

/// At each time t the polynomial of degree d with least sum_i K((t_i - t) / w) (y_i -
/// p(t_i))^2, K(u) = (1 - |u|^3)^3 (tricube), on any grid.
///
/// Without a width each sample has its own: widths grow by a quarter from the narrowest that
/// determines the polynomial to half the record or 512 samples, and the widest is taken whose
/// interval, derivative +- 2 standard errors, still meets those of all narrower ones
/// (intersection of confidence intervals): where the signal turns quickly it is narrow. All
/// states of a record have the same width, the least of theirs. The noise is estimate_noise()
/// of the samples; without noise all widths are the narrowest.
Stage<Differentiator> local_polynomial(const LocalPolynomialOptions& options = {});

/// How the weight of a penalty is chosen from the data.
enum class PenaltyChoice {
  Gcv,   ///< least n RSS / (n - tr S)^2 (Craven & Wahba, Numer. Math. 31 (1979) 377-403)
  Reml,  ///< largest restricted likelihood (Wahba, Ann. Stat. 13 (1985) 1378-1402)
  Noise  ///< least RSS / sigma^2 + 2 tr S with the known noise (Mallows 1973)
};

/// Options of smoothing_spline().
struct SmoothingSplineOptions {
  static constexpr StageInfo kInfo{
      "smoothing-spline", "Derivatives of a spline that follows the samples and bends little",
      "F. O'Sullivan, Stat. Sci. 1 (1986) 502-518; G. Wahba, Spline Models for Observational "
      "Data, SIAM 1990"};

  int order = 3;
  PenaltyChoice choice = PenaltyChoice::Gcv;
  std::optional<double> lambda = {};

  void describe(OptionVisitor& v);
};

/// The spline f of degree 2m-1 with least
///
///   sum_i (y_i - f(t_i))^2 + lambda integral (f^(m))^2 dt
///
/// over knots at equal spacing, as many as samples, on any grid; over gaps it goes on with the
/// least penalty. Polynomials below degree m have no penalty. B-splines make the normal
/// equations banded; they are solved by sparse Cholesky. One lambda for all states and records:
/// unequal filters bias equations between states. Chosen between 1e-6 and 1e11 times h^(2m-1)
/// of the mean step h (beyond, rounding decides): features may have about 2 pi 1e11^(1/2m)
/// samples, 430 for m = 3; thin out records that are sampled more densely.
///
/// The standard error is that of the Bayesian model (Wahba 1983), sigma sqrt(b'A^-1 b), with
/// sigma^2 = RSS / (n - tr S).
Stage<Differentiator> smoothing_spline(const SmoothingSplineOptions& options = {});

/// Options of whittaker().
struct WhittakerOptions {
  static constexpr StageInfo kInfo{
      "whittaker", "Samples smoothed by a penalty on their differences (Whittaker-Henderson)",
      "E. T. Whittaker, Proc. Edinb. Math. Soc. 41 (1923) 63-75; P. H. C. Eilers, Anal. Chem. "
      "75 (2003) 3631-3636"};

  int order = 3;
  PenaltyChoice choice = PenaltyChoice::Gcv;
  std::optional<double> lambda = {};

  void describe(OptionVisitor& v);
};

/// The samples z with least
///
///   sum_i (y_i - z_i)^2 + lambda h sum_i (D^d z)_i^2,
///
/// D^d z the d-th derivative of the polynomial through d + 1 neighbours and h the mean step, by
/// sparse Cholesky; derivatives are differences of fourth order of z. Polynomials below degree
/// d have no penalty. One lambda for all states and records, chosen within the range of
/// SmoothingSpline. The standard error is given of z itself (order 0).
Stage<Differentiator> whittaker(const WhittakerOptions& options = {});

/// Options of kalman_smoother().
struct KalmanSmootherOptions {
  static constexpr StageInfo kInfo{"kalman",
                                   "Smoother of a signal whose m-th derivative is white noise",
                                   "H. E. Rauch, F. Tung, C. T. Striebel, AIAA J. 3 (1965) "
                                   "1445-1450; R. Kohn, C. F. Ansley, "
                                   "Biometrika 74 (1987) 751-764"};

  std::optional<int> order = {};
  std::optional<double> lambda = {};

  void describe(OptionVisitor& v) {
    v.field({"order", "",
             "m: the m-th derivative is white noise; by likelihood when not given.", 2.0, 4.0},
            order);
    v.field({"lambda", "time^(2m-1)",
             "Variance of the samples' noise over intensity of the white noise; by likelihood "
             "when not given. It needs the order.",
             1e-300},
            lambda);
  }
};

/// The signal and its derivatives as an integrated Wiener process, d^m x/dt^m = white noise of
/// intensity q, seen with white noise of variance sigma^2 at any times:
///
///   s_(i+1) = Phi(h_i) s_i + w_i,  Phi_ab = h^(b-a) / (b-a)!,
///   cov w = q h^(2m-1-a-b) / ((2m-1-a-b) (m-1-a)! (m-1-b)!),  y_i = s_i0 + noise,
///
/// by Kalman's filter from a diffuse start and the smoother of Rauch, Tung and Striebel. With
/// lambda = sigma^2 / q the mean is the smoothing spline of SmoothingSpline. Order and lambda
/// have the largest likelihood of the samples from the ninth on, given those before; one of
/// them for all states and records. Standard errors are those of the smoother.
Stage<Differentiator> kalman_smoother(const KalmanSmootherOptions& options = {});

/// Options of spectral().
struct SpectralOptions {
  static constexpr StageInfo kInfo{
      "spectral",
      "Derivatives of a cosine series up to a frequency, with polynomials for the ends",
      "C. Lanczos, Discourse on Fourier Series, 1966; P. Craven, G. Wahba, Numer. Math. 31 "
      "(1979) "
      "377-403"};

  std::optional<double> cutoff = {};

  void describe(OptionVisitor& v) {
    v.field({"cutoff", "1 / time",
             "Highest frequency: the window is 1 up to it and 0 beyond; chosen when not given.",
             1e-300},
            cutoff);
  }
};

/// The least-squares fit, on any grid, of
///
///   f(t) = sum_(p=0..5) a_p s^p + sum_(k=1..K) b_k cos(pi k s),  s = (t - t_first) / T,
///
/// a rectangular window over frequencies up to cutoff = K / (2 T). The polynomials take up what
/// keeps an even continuation from being smooth at the ends (Lanczos), so no taper over time is
/// needed. K has the least generalised cross-validation, one for all states; by QR, which gives
/// every K from one factor. Records longer than 1024 samples go by pieces that overlap by half,
/// of which the middles are taken. Standard errors are those of least squares.
Stage<Differentiator> spectral(const SpectralOptions& options = {});

/// Options of trend_filter().
struct TrendFilterOptions {
  static constexpr StageInfo kInfo{
      "trend-filter",
      "Samples smoothed by pieces of polynomials with few knots (total variation)",
      "S.-J. Kim, K. Koh, S. Boyd, D. Gorinevsky, SIAM Review 51 (2009) 339-360; R. Chartrand, "
      "ISRN Appl. Math. (2011) 164564"};

  int order = 3;
  std::optional<double> lambda = {};

  void describe(OptionVisitor& v) {
    v.field({"order", "", "d: pieces of degree d - 1; 2 is the total variation of the rate.",
             2.0, 4.0},
            order);
    v.field({"lambda", "time^(d-1)",
             "Weight of the penalty in units of the noise; chosen when not given.", 1e-300},
            lambda);
  }
};

/// The samples z with least
///
///   sum_i (y_i - z_i)^2 + lambda sigma h sum_i |(D^d z)_i|,
///
/// sigma the noise of the state (estimate_noise()), h the mean step, D^d z as in Whittaker.
/// Where a signal is smooth but for some instants, a sum of absolute values leaves the instants
/// as they are, where a sum of squares rounds them off. Derivatives are differences of fourth
/// order of z. One lambda for all states and records, by Mallows' C_p (see choose_trend()).
/// Samples without noise stay as they are. It knows no standard error.
Stage<Differentiator> trend_filter(const TrendFilterOptions& options = {});

}  // namespace lacuna
