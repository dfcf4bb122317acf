// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "lacuna/forms/candidate/effect.hpp"

namespace lacuna {

/// Shapes from the unit cube, and back.
class ShapeScale {
 public:
  explicit ShapeScale(const std::vector<ShapeParameter>& shapes) : shapes_(shapes) {}

  Vector shapes(const Vector& unit) const {
    Vector result(unit.size());
    for (Index i = 0; i < unit.size(); ++i) {
      const ShapeParameter& shape = shapes_[static_cast<std::size_t>(i)];
      const double value = shape.logarithmic
                               ? shape.low * std::pow(shape.high / shape.low, unit[i])
                               : shape.low + (shape.high - shape.low) * unit[i];
      result[i] = std::clamp(value, shape.low, shape.high);
    }
    return result;
  }

  Vector unit(const Vector& shapes) const {
    Vector result(shapes.size());
    for (Index i = 0; i < shapes.size(); ++i) {
      const ShapeParameter& shape = shapes_[static_cast<std::size_t>(i)];
      const double span =
          shape.logarithmic ? std::log(shape.high / shape.low) : shape.high - shape.low;
      const double above =
          shape.logarithmic ? std::log(shapes[i] / shape.low) : shapes[i] - shape.low;
      const double fraction = above / span;  // no number for a range of one value, or below it
      result[i] = fraction > 0.0 ? std::min(fraction, 1.0) : 0.0;
    }
    return result;
  }

 private:
  const std::vector<ShapeParameter>& shapes_;
};

}  // namespace lacuna
