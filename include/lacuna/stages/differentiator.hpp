// SPDX-License-Identifier: MIT
#pragma once

#include "lacuna/core/stage.hpp"
#include "lacuna/core/types.hpp"

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

 private:
  virtual Matrix do_differentiate(const Vector& time, const Eigen::Ref<const Matrix>& values,
                                  int order) const = 0;
};

}  // namespace lacuna
