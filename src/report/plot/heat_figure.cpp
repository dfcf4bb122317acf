// SPDX-License-Identifier: MIT
#include "report/plot/heat_figure.hpp"

#include <algorithm>

#include "core/base/check.hpp"
#include "core/base/text.hpp"
#include "svg.hpp"

namespace lacuna {
namespace {

constexpr double kCellHeight = 22.0, kHeatTop = 56.0;
constexpr std::size_t kHeatLabel = 44, kHeatText = 12;

void check_cells(const HeatFigure& figure) {
  bool fits = figure.texts.size() == figure.rows.size() &&
              figure.shades.size() == figure.rows.size() && !figure.columns.empty();
  for (std::size_t r = 0; fits && r < figure.rows.size(); ++r)
    fits = figure.texts[r].size() == figure.columns.size() &&
           figure.shades[r].size() == figure.columns.size();
  check_argument(fits, "draw", "there is not one text and one shade for each cell");
}

struct HeatFrame {
  double left = 0.0, width = 0.0;
};

HeatFrame heat_frame(const HeatFigure& figure) {
  double label = 40.0;
  for (const std::string& row : figure.rows)
    label = std::max(label, svg::width_of(svg::shortened(row, kHeatLabel)));
  const double left = label + 16.0;
  return {left, (svg::kWidth - left - 10.0) / static_cast<double>(figure.columns.size())};
}

Markup heat_cell(const HeatFigure& figure, std::size_t r, std::size_t c,
                 const HeatFrame& frame) {
  const double x = frame.left + frame.width * static_cast<double>(c);
  const double y = kHeatTop + kCellHeight * static_cast<double>(r);
  const std::optional<double> shade = figure.shades[r][c];
  Markup all = element("title", Markup::text(figure.rows[r] + ", " + figure.columns[c] + ": " +
                                             figure.texts[r][c]));
  if (shade)
    all += empty_element(
        "rect", {{"x", svg::pixels(x + 1.0)},
                 {"y", svg::pixels(y + 1.0)},
                 {"width", svg::pixels(frame.width - 2.0)},
                 {"height", svg::pixels(kCellHeight - 2.0)},
                 {"fill-opacity", format_number(0.6 * std::clamp(*shade, 0.0, 1.0), 3)},
                 {"class", "heat"}});
  return element("g", {{"class", "cell"}},
                 all + svg::label(x + 0.5 * frame.width, y + 15.0,
                                  svg::shortened(figure.texts[r][c], kHeatText), "middle"));
}

/// The numbers of the cells, for whoever draws them otherwise.
RowFigure rows_of(const HeatFigure& figure) {
  RowFigure rows{figure.name, figure.title, "shade", {}};
  for (std::size_t r = 0; r < figure.rows.size(); ++r)
    for (std::size_t c = 0; c < figure.columns.size(); ++c)
      rows.rows.push_back({figure.rows[r] + ", " + figure.columns[c],
                           figure.shades[r][c].value_or(0.0),
                           {},
                           {},
                           figure.texts[r][c]});
  return rows;
}

}  // namespace

Picture draw(const HeatFigure& figure) {
  check_cells(figure);
  const HeatFrame frame = heat_frame(figure);
  Markup content = svg::label(8.0, 16.0, svg::shortened(figure.title, 100), "start", "title");
  for (std::size_t c = 0; c < figure.columns.size(); ++c)
    content += svg::label(frame.left + frame.width * (static_cast<double>(c) + 0.5), kHeatTop - 8.0,
                          svg::shortened(figure.columns[c], 16), "middle", "tick");
  for (std::size_t r = 0; r < figure.rows.size(); ++r) {
    content += svg::label(frame.left - 10.0, kHeatTop + kCellHeight * static_cast<double>(r) + 15.0,
                          svg::shortened(figure.rows[r], kHeatLabel), "end");
    for (std::size_t c = 0; c < figure.columns.size(); ++c)
      content += heat_cell(figure, r, c, frame);
  }
  const double height = kHeatTop + kCellHeight * static_cast<double>(figure.rows.size()) + 14.0;
  return {figure.name, figure.title,
          svg::drawing(figure.title, "rows", svg::kWidth, height, content), rows_of(figure)};
}

}  // namespace lacuna
