// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>

#include "lacuna/core/base/options.hpp"
#include "lacuna/core/base/types.hpp"
#include "lacuna/data/records/dataset.hpp"

namespace lacuna {

/// Plug point: estimates time derivatives from samples.
class Differentiator : public StageInterface {
 public:
  static constexpr std::string_view kKind = "differentiator";

  /// The k-th derivative of every column; k = 0 gives what the method takes for the signal
  /// itself (smoothed where it smooths).
  /// @param time n, strictly increasing, uniform or not; @param values n x m.
  /// @return n x m, in units of the values per time unit to the k.
  /// @throws DataError when there are fewer samples than the method needs, saying how many;
  ///   ArgumentError when shapes do not fit or the order is negative.
  Matrix differentiate(const Vector& time, const Eigen::Ref<const Matrix>& values,
                       int order = 1) const;

  /// Standard error of each entry of differentiate() of the same arguments, from the noise that
  /// the method finds in the values or their estimated noise; nothing where it has none.
  /// @throws DataError and ArgumentError as differentiate().
  std::optional<Matrix> standard_error(const Vector& time,
                                       const Eigen::Ref<const Matrix>& values,
                                       int order = 1) const;

  /// Samples at either end of a record at which the first derivative is one-sided: it has many
  /// times the noise and the truncation error of the others there.
  Index margin() const { return do_margin(); }

  /// Samples that a record must have for first derivatives.
  Index fewest_samples() const { return do_fewest_samples(); }

  /// rms of what first derivatives of these records have of systematic error, one per state in
  /// state units per time unit; nothing when the method cannot estimate it.
  std::optional<Vector> truncation_error(const Dataset& data) const {
    return do_truncation_error(data);
  }

 private:
  friend Stage<Differentiator> fitted_to(const Stage<Differentiator>& method,
                                         const Dataset& data,
                                         const std::optional<Vector>& noise);

  virtual Matrix do_differentiate(const Vector& time, const Eigen::Ref<const Matrix>& values,
                                  int order) const = 0;

  virtual std::optional<Matrix> do_standard_error(const Vector&, const Eigen::Ref<const Matrix>&,
                                                  int) const {
    return std::nullopt;
  }

  virtual Index do_margin() const { return 0; }

  virtual Index do_fewest_samples() const { return 2; }

  virtual std::optional<Vector> do_truncation_error(const Dataset&) const {
    return std::nullopt;
  }

  /// The method with what it leaves open chosen for these records; null when nothing is open.
  virtual std::shared_ptr<const Differentiator> do_fit(const Dataset&,
                                                       const std::optional<Vector>&) const {
    return nullptr;
  }
};

/// The method with those of its parameters that were left open chosen for these records; the
/// method itself when none is. @param noise of the states (estimate_noise) where it is known
/// already; else it is estimated where it is needed.
/// @throws ArgumentError when noise is not one number per state; DataError as check_form().
Stage<Differentiator> fitted_to(const Stage<Differentiator>& method, const Dataset& data,
                                const std::optional<Vector>& noise = {});

/// The differentiator among the options of a stage. @throws ConfigError when there is none.
Stage<Differentiator> differentiator_of(const StageInterface& stage);

}  // namespace lacuna
