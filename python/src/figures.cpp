// SPDX-License-Identifier: MIT
#include "figures.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <array>

#include "arrays.hpp"

namespace lacuna::python {
namespace {

/// Names of Curve, in order.
constexpr std::array kCurves = {"measured", "before", "model", "other"};

const char* name_of(Curve curve) { return kCurves.at(static_cast<std::size_t>(curve)); }

nb::dict begun(const char* kind, const std::string& name, const std::string& title) {
  nb::dict values;
  values["kind"] = kind;
  values["name"] = name;
  values["title"] = title;
  return values;
}

nb::dict values_of(const LineFigure& figure) {
  nb::dict values = begun("lines", figure.name, figure.title);
  values["x_label"] = figure.x_label;
  values["y_label"] = figure.y_label;
  values["logarithmic_x"] = figure.logarithmic_x;
  values["logarithmic_y"] = figure.logarithmic_y;
  nb::list all;
  for (const Series& series : figure.series) {
    nb::dict one;
    one["label"] = series.label;
    one["x"] = array_of(series.x);
    one["y"] = array_of(series.y);
    one["curve"] = name_of(series.curve);
    one["dots"] = series.dots;
    all.append(one);
  }
  values["series"] = all;
  values["band"] = nb::none();
  if (figure.band)
    values["band"] = nb::make_tuple(figure.band->low, figure.band->high, figure.band->label);
  return values;
}

nb::dict values_of(const RowFigure& figure) {
  nb::dict values = begun("rows", figure.name, figure.title);
  values["x_label"] = figure.x_label;
  values["intervals"] = figure.intervals;
  nb::list all;
  for (const Row& row : figure.rows) {
    nb::dict one;
    one["label"] = row.label;
    one["value"] = row.value;
    one["low"] = row.low;
    one["high"] = row.high;
    one["note"] = row.note;
    one["marked"] = row.marked;
    all.append(one);
  }
  values["rows"] = all;
  return values;
}

nb::dict values_of(const OrbitFigure& figure) {
  nb::dict values = begun("orbits", figure.name, figure.title);
  values["labels"] = figure.labels;
  nb::list all;
  for (const Orbit& orbit : figure.orbits) {
    nb::dict one;
    one["label"] = orbit.label;
    one["points"] = array_of(orbit.points);
    one["curve"] = name_of(orbit.curve);
    all.append(one);
  }
  values["orbits"] = all;
  return values;
}

}  // namespace

nb::list figures_of(const Page& page) {
  nb::list all;
  for (const Picture& picture : pictures_of(page))
    all.append(
        std::visit([](const auto& figure) { return values_of(figure); }, picture.figure));
  return all;
}

}  // namespace lacuna::python
