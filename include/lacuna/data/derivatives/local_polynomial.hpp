// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "lacuna/core/base/options.hpp"
#include "lacuna/data/derivatives/differentiator.hpp"

namespace lacuna {

/// Options of LocalPolynomial.
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

/// At each time t the polynomial of degree d with least sum_i K((t_i - t) / w) (y_i - p(t_i))^2,
/// K(u) = (1 - |u|^3)^3 (tricube), on any grid.
///
/// Without a width each sample has its own: widths grow by a quarter from the narrowest that
/// determines the polynomial to half the record or 512 samples, and the widest is taken whose
/// interval, derivative +- 2 standard errors, still meets those of all narrower ones (intersection
/// of confidence intervals): where the signal turns quickly it is narrow. All states of a record
/// have the same width, the least of theirs.
/// The noise is estimate_noise() of the samples; without noise all widths are the narrowest.
class LocalPolynomial final : public Configured<Differentiator, LocalPolynomialOptions> {
 public:
  using Configured::Configured;

 private:
  Matrix do_differentiate(const Vector& time, const Eigen::Ref<const Matrix>& values,
                          int order) const override;
  std::optional<Matrix> do_standard_error(const Vector& time,
                                          const Eigen::Ref<const Matrix>& values,
                                          int order) const override;
  Index do_fewest_samples() const override { return options().degree + 2; }
};

}  // namespace lacuna
