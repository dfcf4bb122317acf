// SPDX-License-Identifier: MIT
// Pictures of a report, as SVG that needs nothing else.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "lacuna/core/base/types.hpp"
#include "report/plot/markup.hpp"

namespace lacuna {

/// What a curve is; pictures of one report show the same thing in the same colour.
enum class Curve { Measured, Before, Model, Other };

/// One curve of a figure. NaN splits it.
struct Series {
  std::string label;
  Vector x, y;  ///< of one length
  Curve curve = Curve::Measured;
  bool dots = false;  ///< samples alone, not a line
};

/// Values between two levels, as a band behind the curves: what noise makes.
struct Band {
  std::string label;
  double low = 0.0, high = 0.0;
};

/// Curves over an axis, or orbits in a plane.
struct LineFigure {
  std::string name;  ///< file name without its ending: letters, digits, underscores
  std::string title;
  std::string x_label, y_label;  ///< with units
  std::vector<Series> series;
  std::optional<Band> band = {};
  bool logarithmic_x = false, logarithmic_y = false;
};

/// One row of a figure of rows: a bar, or a number with its interval.
struct Row {
  std::string label;
  double value = 0.0;
  std::optional<double> low = {}, high = {};  ///< interval
  std::string note = {};                      ///< behind the bar
  bool marked = false;                        ///< what was taken, what is new
};

/// Ranked bars from 0, or intervals beside a line at 0.
struct RowFigure {
  std::string name, title, x_label;
  std::vector<Row> rows;
  bool intervals = false;
};

/// An orbit in space, to be turned by dragging.
struct Orbit {
  std::string label;
  Matrix points;  ///< n x 3
  Curve curve = Curve::Measured;
};

struct OrbitFigure {
  std::string name, title;
  std::vector<std::string> labels;  ///< of the three axes, with units
  std::vector<Orbit> orbits;
};

using Figure = std::variant<LineFigure, RowFigure, OrbitFigure>;

/// A figure that was drawn.
struct Picture {
  std::string name, title;
  Markup svg;     ///< with classes whose style the page, or stand_alone(), brings
  Figure figure;  ///< its numbers, for whoever draws them otherwise
  Markup narrow = {};  ///< the same for a phone; empty where there is none
};

Picture draw(const LineFigure& figure);
Picture draw(const RowFigure& figure);
Picture draw(const OrbitFigure& figure);

/// The colours and lines of pictures, for light and dark (CSS).
std::string picture_style();

/// The picture as a file of its own.
std::string stand_alone(const Picture& picture);

}  // namespace lacuna
