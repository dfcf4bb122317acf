// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "core/base/text.hpp"
#include "report/plot/figure.hpp"
#include "report/plot/scale.hpp"
#include "svg.hpp"

namespace lacuna {
namespace {

constexpr double kRow = 24.0, kLabelLine = 18.0, kFirstRow = 30.0, kAxis = 46.0;

/// Characters of a label beside its bar; where one is longer all stand above their bars, where a
/// line has room for kLongLabel.
constexpr std::size_t kLabel = 48, kLongLabel = 120, kNote = 26;

struct RowFrame {
  Scale scale;
  double left = 0.0, right = 0.0;
  bool labels_above = false;

  double row_height() const { return labels_above ? kRow + kLabelLine : kRow; }

  double at(double value) const { return left + scale.part(value) * (right - left); }
};

/// All values and ends of intervals, and the zero that bars begin at.
Vector values_of(const RowFigure& figure) {
  std::vector<double> values{0.0};
  for (const Row& row : figure.rows) {
    values.push_back(row.value);
    values.push_back(row.low.value_or(row.value));
    values.push_back(row.high.value_or(row.value));
  }
  return Eigen::Map<const Vector>(values.data(), static_cast<Index>(values.size()));
}

RowFrame frame_of(const RowFigure& figure) {
  double label = 40.0, note = 20.0;
  bool is_long = false;
  for (const Row& row : figure.rows) {
    is_long = is_long || svg::shortened(row.label, kLabel) != row.label;
    label = std::max(label, svg::width_of(svg::shortened(row.label, kLabel)));
    note = std::max(note, svg::width_of(svg::shortened(row.note, kNote)));
  }
  const Vector values = values_of(figure);
  return {scale_of({&values}), is_long ? 10.0 : label + 16.0, svg::kWidth - note - 18.0,
          is_long};
}

Markup bar(const Row& row, const RowFrame& frame, double middle) {
  const double zero = frame.at(0.0), end = frame.at(std::isfinite(row.value) ? row.value : 0.0);
  return empty_element("rect", {{"x", svg::pixels(std::min(zero, end))},
                                {"y", svg::pixels(middle - 7.0)},
                                {"width", svg::pixels(std::max(1.0, std::abs(end - zero)))},
                                {"height", "14"},
                                {"class", row.marked ? "bar marked" : "bar"}});
}

Markup interval(const Row& row, const RowFrame& frame, double middle) {
  const std::string kind = row.marked ? "whisker marked" : "whisker";
  Markup all;
  if (row.low && row.high) {
    const double low = frame.at(*row.low), high = frame.at(*row.high);
    all += svg::line(low, middle, high, middle, kind);
    all += svg::line(low, middle - 4.0, low, middle + 4.0, kind);
    all += svg::line(high, middle - 4.0, high, middle + 4.0, kind);
  }
  return all + empty_element("circle", {{"cx", svg::pixels(frame.at(row.value))},
                                        {"cy", svg::pixels(middle)},
                                        {"r", "4"},
                                        {"class", row.marked ? "dot marked" : "dot"}});
}

/// @param top of the row.
Markup row_of(const RowFigure& figure, const Row& row, const RowFrame& frame, double top) {
  const double middle = top + frame.row_height() - kRow / 2.0;
  Markup all = element("title", Markup::text(row.label + ": " + format_number(row.value, 6) +
                                             (row.note.empty() ? "" : ", " + row.note)));
  all += frame.labels_above
             ? svg::label(16.0, top + 14.0, svg::shortened(row.label, kLongLabel), "start")
             : svg::label(frame.left - 10.0, middle + 4.0, row.label, "end");
  all += figure.intervals ? interval(row, frame, middle) : bar(row, frame, middle);
  all += svg::label(frame.right + 8.0, middle + 4.0, svg::shortened(row.note, kNote), "start",
                    "tick");
  return element("g", {{"class", "row"}}, all);
}

}  // namespace

Picture draw(const RowFigure& figure) {
  const RowFrame frame = frame_of(figure);
  const double bottom = kFirstRow + frame.row_height() * static_cast<double>(figure.rows.size());
  Markup content = svg::label(8.0, 16.0, svg::shortened(figure.title, 100), "start", "title");
  const int count = static_cast<int>((frame.right - frame.left) / 70.0);
  for (const Tick& tick : ticks_of(frame.scale, std::clamp(count, 2, 8))) {
    const double x = frame.at(tick.value);
    content += svg::line(x, kFirstRow, x, bottom, tick.value == 0.0 ? "zero" : "grid");
    content += svg::label(x, bottom + 16.0, tick.label, "middle", "tick");
  }
  content += svg::label((frame.left + frame.right) / 2.0, bottom + 36.0,
                        svg::shortened(figure.x_label, 80), "middle", "axis");
  for (std::size_t r = 0; r < figure.rows.size(); ++r)
    content += row_of(figure, figure.rows[r], frame,
                      kFirstRow + frame.row_height() * static_cast<double>(r));
  return {figure.name, figure.title,
          svg::drawing(figure.title, "rows", svg::kWidth, bottom + kAxis, content), figure};
}

}  // namespace lacuna
