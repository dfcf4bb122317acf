// SPDX-License-Identifier: MIT
// The likelihood of measured values beside those of the model.
#pragma once

#include <vector>

#include "core/statistics/truncated_normal.hpp"
#include "lacuna/core/base/types.hpp"
#include "lacuna/model/equations/ode_model.hpp"

namespace lacuna {

/// What a measured value says.
enum class Censoring {
  None,   ///< the value itself
  Below,  ///< it is not above a limit
  Above   ///< it is not below a limit
};

/// A value of a channel with the law of its noise. With l the log-likelihood of the model's value
/// y and I its expected information (of a limit the curvature), a row w dy and a residual z have
/// w z = dl/dy and w w = I: least squares with them are the scoring method for the likelihood
/// (Fisher scoring; Green, J. R. Stat. Soc. B 46:149-192, 1984).
struct NoiseScore {
  double loss = 0.0;      ///< -2 l, without the part that does not depend on y
  double weight = 0.0;    ///< w
  double residual = 0.0;  ///< z
};

/// How a standard normal number z, which makes a measured value with its law, changes with y.
struct NormalChange {
  double scale = 1.0;  ///< deviation of the value (of its logarithm): value = location + scale z
  double shift = 0.0;  ///< derivative of the location by y, over the scale
  double widening = 0.0;  ///< derivative of the logarithm of the scale by y
};

/// The numbers of a law at present.
struct NoiseSizes {
  double a = 1.0, b = 0.1;
  double least = 0.0;  ///< a value near 0, below which deviations do not fall
};

/// The noise of one channel, its sizes known or estimated.
class ChannelNoise {
 public:
  /// @param noise deviation of the values, a first guess. @param values those that are measured.
  ChannelNoise(const NoiseLaw& law, double noise, const Vector& values);

  const NoiseLaw& law() const noexcept { return law_; }  ///< as given

  /// The law with the present sizes.
  NoiseLaw sized() const;

  /// Takes sizes, each > 0, in the place of the present ones; those that are given stay.
  void set_sizes(double constant, double fraction);

  /// What a measured value says by the limits of the law; nothing but itself where it is
  /// truncated there.
  Censoring censoring(double measured) const;

  /// The score of a value y of the model.
  NoiseScore score(double measured, double y) const;

  /// A part of the loss that depends on the measured value alone: the loss less this part is about
  /// the square of a normal number.
  double offset(double measured) const;

  /// The measured value less its mean in its deviations, 0 for what is censored.
  double pearson(double measured, double y) const;

  /// The derivative by y of the mean of a measured value, in its deviations; of a logarithm
  /// that of the value.
  double pearson_weight(double y) const;

  /// The deviation of a measured value about y, were it not truncated.
  double deviation(double y) const;

  /// The log-likelihood of a measured value, of what is censored that of its limit.
  double log_likelihood(double measured, double y) const;

  /// Takes the sizes of the largest likelihood for these values, those that are given stay.
  /// @param freedom degrees of freedom over values, by which variances are larger.
  void estimate(const Vector& measured, const Vector& y, double freedom);

 private:
  double variance(double y) const;
  double variance_slope(double y) const;
  double log_value(double y) const;
  double log_slope(double y) const;
  NoiseScore normal_score(double residual, double y) const;
  NoiseScore limit_score(double measured, double y) const;
  NoiseScore truncated_score(double measured, double y) const;
  NormalChange change(double y) const;
  double standard(double value, double y) const;
  TruncatedNormal between_limits(double y) const;
  double total(const Vector& measured, const Vector& y) const;
  void search(double& size, const Vector& measured, const Vector& y);

  NoiseLaw law_;
  NoiseSizes sizes_;
};

}  // namespace lacuna
