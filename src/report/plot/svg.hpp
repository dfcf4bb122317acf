// SPDX-License-Identifier: MIT
// What all figures are drawn with.
#pragma once

#include <string>
#include <vector>

#include "report/plot/figure.hpp"
#include "report/plot/scale.hpp"

namespace lacuna::svg {

/// How wide a figure is, in pixels, on paper and on a phone.
inline constexpr double kWidth = 760.0, kNarrow = 360.0;

/// Pixels, rounded to so many parts of one: "12.5".
std::string pixels(double value, double parts = 10.0);

/// "measured", "before", "model", "other": class of a curve.
std::string class_of(Curve curve);

/// Text at a place. @param anchor start, middle, end.
Markup label(double x, double y, const std::string& text, const std::string& anchor = "start",
             const std::string& kind = "label");

/// The text, or its beginning and "..." where it has more than `most` characters.
std::string shortened(const std::string& text, std::size_t most);

/// Pixels that a text takes at the size of labels, about.
double width_of(const std::string& text);

/// Text in as many lines as it needs, three at most.
struct TextLines {
  Markup markup;
  double height = 0.0;  ///< of the lines behind the first
};

/// Lines from x to `right`, the first on the height y; a word that is longer than a line breaks.
TextLines lines(const std::string& text, double x, double right, double y,
                const std::string& kind = "label");

/// Characters for which there is room.
std::size_t room_in(double pixels);

/// A straight line of a class.
Markup line(double x1, double y1, double x2, double y2, const std::string& kind);

/// An entry of the legend.
struct Key {
  std::string label;
  std::string kind;  ///< class of the curve
  std::size_t number = 0;
  bool dots = false;  ///< whether points are shown, not a curve
};

/// The legend from `left` on, in as many lines as it needs.
struct Legend {
  Markup markup;
  double height = 0.0;
};
Legend legend(const std::vector<Key>& keys, double left, double right, double top);

/// The whole: <svg> of that size with a title for those who cannot see it; of the class `narrow`
/// where it is no wider than kNarrow.
Markup drawing(const std::string& title, const std::string& kind, double width, double height,
               const Markup& content);

}  // namespace lacuna::svg
