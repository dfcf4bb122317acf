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

/// Parts of the width for a label beside its bar, and for what stands behind it; where a label is
/// longer all stand above their bars.
constexpr double kLabelPart = 0.45, kNotePart = 0.25;

struct RowFrame {
  Scale scale;
  double width = 0.0, left = 0.0, right = 0.0;
  std::optional<double> above = {};  ///< height of labels that stand above their bars

  double row_height() const { return kRow + above.value_or(0.0); }
  std::size_t note_room() const { return svg::room_in(kNotePart * width); }

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

svg::TextLines label_above(const Row& row, double width, double top) {
  return svg::lines(row.label, 16.0, width - 10.0, top + 14.0);
}

RowFrame frame_of(const RowFigure& figure, double width) {
  double label = 40.0, note = 20.0, above = 0.0;
  const std::size_t room = svg::room_in(kNotePart * width);
  for (const Row& row : figure.rows) {
    label = std::max(label, svg::width_of(row.label));
    note = std::max(note, svg::width_of(svg::shortened(row.note, room)));
    above = std::max(above, kLabelLine + label_above(row, width, 0.0).height);
  }
  const Vector values = values_of(figure);
  RowFrame frame{scale_of({&values}), width, label + 16.0, width - note - 18.0};
  if (label > kLabelPart * width) {
    frame.left = 10.0;
    frame.above = above;
  }
  return frame;
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
  all += frame.above
             ? label_above(row, frame.width, top).markup
             : svg::label(frame.left - 10.0, middle + 4.0, row.label, "end");
  all += figure.intervals ? interval(row, frame, middle) : bar(row, frame, middle);
  all += svg::label(frame.right + 8.0, middle + 4.0, svg::shortened(row.note, frame.note_room()),
                    "start", "tick");
  return element("g", {{"class", "row"}}, all);
}

Markup drawn(const RowFigure& figure, double width) {
  const RowFrame frame = frame_of(figure, width);
  const svg::TextLines title = svg::lines(figure.title, 8.0, width - 8.0, 16.0, "title");
  const double first = kFirstRow + title.height;
  const double bottom = first + frame.row_height() * static_cast<double>(figure.rows.size());
  Markup content = title.markup;
  const int count = static_cast<int>((frame.right - frame.left) / 70.0);
  for (const Tick& tick : ticks_of(frame.scale, std::clamp(count, 2, 8))) {
    const double x = frame.at(tick.value);
    content += svg::line(x, first, x, bottom, tick.value == 0.0 ? "zero" : "grid");
    content += svg::label(x, bottom + 16.0, tick.label, "middle", "tick");
  }
  content += svg::label((frame.left + frame.right) / 2.0, bottom + 36.0,
                        svg::shortened(figure.x_label, svg::room_in(frame.right - frame.left)),
                        "middle", "axis");
  for (std::size_t r = 0; r < figure.rows.size(); ++r)
    content += row_of(figure, figure.rows[r], frame,
                      first + frame.row_height() * static_cast<double>(r));
  return svg::drawing(figure.title, "rows", width, bottom + kAxis, content);
}

}  // namespace

Picture draw(const RowFigure& figure) {
  return {figure.name, figure.title, drawn(figure, svg::kWidth), figure,
          drawn(figure, svg::kNarrow)};
}

}  // namespace lacuna
