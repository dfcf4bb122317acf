// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/base/text.hpp"
#include "report/plot/figure.hpp"
#include "svg.hpp"

namespace lacuna {
namespace {

constexpr double kHeight = 430.0, kTop = 30.0;
constexpr Index kMostPoints = 4000;
constexpr double kTurn = 0.7, kTilt = 0.45;  // of the first view, radians
constexpr double kUnits = 1000.0;            // points are numbers from -1000 to 1000
constexpr double kPartsOfAUnit = 1000.0;     // a decision: rounding is off by 2.5e-7 of the range

/// Middle and half width of each axis over all orbits.
struct Box {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero(), half = Eigen::Vector3d::Ones();
};

Box box_of(const OrbitFigure& figure) {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(INFINITY), high = -low;
  for (const Orbit& orbit : figure.orbits)
    for (Index i = 0; i < orbit.points.rows(); ++i) {
      const Eigen::Vector3d point = orbit.points.row(i).transpose();
      if (!point.allFinite()) continue;
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
  if (!(low.array() <= high.array()).all()) return {};
  return {(low + high) / 2.0, ((high - low) / 2.0).cwiseMax(1e-300)};
}

/// Points in the box, those that are shown; nothing stands for a gap.
std::vector<std::optional<Eigen::Vector3d>> shown_points(const Orbit& orbit, const Box& box) {
  const Index n = orbit.points.rows(), step = std::max<Index>(1, n / kMostPoints);
  std::vector<std::optional<Eigen::Vector3d>> points;
  for (Index i = 0; i < n; i += step) {
    const Eigen::Vector3d point = orbit.points.row(i).transpose();
    if (!point.allFinite())
      points.emplace_back();
    else
      points.emplace_back((point - box.middle).cwiseQuotient(box.half) * kUnits);
  }
  return points;
}

/// Where a point is seen; the script of the page computes the same when it is turned.
Eigen::Vector2d projected(const Eigen::Vector3d& point, double width) {
  const double x = point[0] * std::cos(kTurn) - point[1] * std::sin(kTurn);
  const double depth = point[0] * std::sin(kTurn) + point[1] * std::cos(kTurn);
  const double y = point[2] * std::cos(kTilt) + depth * std::sin(kTilt);
  // Beside the orbit there is room for the labels of its axes.
  const double scale = 0.31 * std::min(kHeight - kTop, width - 40.0) / kUnits;
  return {width / 2.0 + scale * x, kTop + (kHeight - kTop) / 2.0 - scale * y};
}

/// The values at -1000 and 1000 of each axis.
std::string ranges_of(const Box& box) {
  std::string text;
  for (Index k = 0; k < 3; ++k)
    text += (k > 0 ? " " : "") + format_number(box.middle[k] - box.half[k]) + " " +
            format_number(box.middle[k] + box.half[k]);
  return text;
}

Markup curve_of(const Orbit& orbit, const Box& box, std::size_t number, double width) {
  std::string path, data;
  bool open = false;
  for (const auto& point : shown_points(orbit, box)) {
    data += data.empty() ? "" : " ";
    if (!point) {
      data += "-";
      open = false;
      continue;
    }
    const Eigen::Vector2d seen = projected(*point, width);
    path += (open ? " " : "M") + svg::pixels(seen[0]) + "," + svg::pixels(seen[1]);
    for (Index k = 0; k < 3; ++k)
      data += (k > 0 ? "," : "") + svg::pixels((*point)[k], kPartsOfAUnit);
    open = true;
  }
  return empty_element("path", {{"d", path},
                                {"class", "curve " + svg::class_of(orbit.curve)},
                                {"data-series", std::to_string(number)},
                                {"data-label", orbit.label},
                                {"data-ranges", ranges_of(box)},
                                {"data-points", data}});
}

/// The axes from the corner of the box.
Markup axes(const OrbitFigure& figure, double width) {
  Markup all;
  const Eigen::Vector3d corner = Eigen::Vector3d::Constant(-kUnits);
  for (std::size_t k = 0; k < 3; ++k) {
    Eigen::Vector3d end = corner;
    end[static_cast<Index>(k)] = kUnits * 1.1;
    const Eigen::Vector2d a = projected(corner, width), b = projected(end, width);
    const Attributes place{{"class", "spatial"}, {"data-axis", std::to_string(k)}};
    all += element("g", place,
                   svg::line(a[0], a[1], b[0], b[1], "grid") +
                       svg::label(b[0], b[1] - 4.0, svg::shortened(figure.labels[k], 30),
                                  "middle", "axis"));
  }
  return all;
}

Markup drawn(const OrbitFigure& figure, double width) {
  const double left = width > svg::kNarrow ? 76.0 : 8.0, right = width - 16.0;
  std::vector<svg::Key> keys;
  for (std::size_t s = 0; s < figure.orbits.size(); ++s)
    keys.push_back({figure.orbits[s].label, svg::class_of(figure.orbits[s].curve), s});
  const svg::TextLines title = svg::lines(figure.title, left, right, 16.0, "title");
  const svg::Legend legend = svg::legend(keys, left, right, title.height + 40.0);
  const Box box = box_of(figure);
  Markup curves;
  for (std::size_t s = 0; s < figure.orbits.size(); ++s)
    curves += curve_of(figure.orbits[s], box, s, width);
  return svg::drawing(figure.title, "orbit", width, kHeight,
                      title.markup + legend.markup + axes(figure, width) + curves);
}

}  // namespace

Picture draw(const OrbitFigure& figure) {
  return {figure.name, figure.title, drawn(figure, svg::kWidth), figure,
          drawn(figure, svg::kNarrow)};
}

}  // namespace lacuna
