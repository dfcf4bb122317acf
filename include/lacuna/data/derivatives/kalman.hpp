// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "lacuna/core/base/options.hpp"
#include "lacuna/data/derivatives/differentiator.hpp"

namespace lacuna {

/// Options of KalmanSmoother.
struct KalmanSmootherOptions {
  static constexpr StageInfo kInfo{
      "kalman", "Smoother of a signal whose m-th derivative is white noise",
      "H. E. Rauch, F. Tung, C. T. Striebel, AIAA J. 3 (1965) 1445-1450; R. Kohn, C. F. Ansley, "
      "Biometrika 74 (1987) 751-764"};

  std::optional<int> order = {};
  std::optional<double> lambda = {};

  void describe(OptionVisitor& v) {
    v.field({"order", "", "m: the m-th derivative is white noise; by likelihood when not given.",
             2.0, 4.0},
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
class KalmanSmoother final : public Configured<Differentiator, KalmanSmootherOptions> {
 public:
  /// @throws ConfigError when lambda is given without the order.
  explicit KalmanSmoother(Options options = {});

 private:
  Matrix do_differentiate(const Vector& time, const Eigen::Ref<const Matrix>& values,
                          int order) const override;
  std::optional<Matrix> do_standard_error(const Vector& time,
                                          const Eigen::Ref<const Matrix>& values,
                                          int order) const override;
  Index do_margin() const override { return margin_; }
  Index do_fewest_samples() const override { return 5; }
  std::shared_ptr<const Differentiator> do_fit(
      const Dataset& data, const std::optional<Vector>& noise) const override;

  Index margin_ = 0;  ///< of the records to which lambda was fitted
};

}  // namespace lacuna
