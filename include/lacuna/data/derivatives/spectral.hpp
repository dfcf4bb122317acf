// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "lacuna/core/base/options.hpp"
#include "lacuna/data/derivatives/differentiator.hpp"

namespace lacuna {

/// Options of Spectral.
struct SpectralOptions {
  static constexpr StageInfo kInfo{
      "spectral", "Derivatives of a cosine series up to a frequency, with polynomials for the ends",
      "C. Lanczos, Discourse on Fourier Series, 1966; P. Craven, G. Wahba, Numer. Math. 31 (1979) "
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
/// every K from one factor. Records longer than 1024 samples go by pieces that overlap by half, of
/// which the middles are taken. Standard errors are those of least squares.
class Spectral final : public Configured<Differentiator, SpectralOptions> {
 public:
  using Configured::Configured;

 private:
  Matrix do_differentiate(const Vector& time, const Eigen::Ref<const Matrix>& values,
                          int order) const override;
  std::optional<Matrix> do_standard_error(const Vector& time,
                                          const Eigen::Ref<const Matrix>& values,
                                          int order) const override;
  Index do_fewest_samples() const override { return 5; }
  std::shared_ptr<const Differentiator> do_fit(
      const Dataset& data, const std::optional<Vector>& noise) const override;
};

}  // namespace lacuna
