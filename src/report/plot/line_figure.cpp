// SPDX-License-Identifier: MIT
#include <cmath>

#include "core/base/text.hpp"
#include "report/plot/figure.hpp"
#include "report/plot/scale.hpp"
#include "svg.hpp"

namespace lacuna {
namespace {

constexpr double kPlot = 230.0;
constexpr double kLeft = 76.0, kRight = 16.0, kAbove = 26.0, kBelow = 44.0;
// A decision: rounding is then off by 2.2e-7 of the height, and panels can be compared to 1e-6.
constexpr double kPartsOfAPixel = 1e4;

/// The rectangle that curves are drawn in, and what its edges stand for.
struct Frame {
  Scale x, y;
  double width = svg::kWidth, top = 0.0;

  double right() const { return width - kRight; }
  double across() const { return right() - kLeft; }
  double at_x(double value) const { return kLeft + x.part(value) * across(); }
  double at_y(double value) const { return top + (1.0 - y.part(value)) * kPlot; }
};

Frame frame_of(const LineFigure& figure, double width) {
  std::vector<const Vector*> x, y;
  for (const Series& series : figure.series) {
    x.push_back(&series.x);
    y.push_back(&series.y);
  }
  Vector band;
  if (figure.band) {
    band = Eigen::Vector2d(figure.band->low, figure.band->high);
    y.push_back(&band);
  }
  return {scale_of(x, figure.logarithmic_x), scale_of(y, figure.logarithmic_y), width};
}

Markup axes(const LineFigure& figure, const Frame& frame) {
  constexpr double kBetweenTicks = 80.0;
  const double bottom = frame.top + kPlot, right = frame.right();
  Markup all;
  for (const Tick& tick : ticks_of(frame.x, static_cast<int>(frame.across() / kBetweenTicks))) {
    const double x = frame.at_x(tick.value);
    all += svg::line(x, frame.top, x, bottom, "grid");
    all += svg::label(x, bottom + 16.0, tick.label, "middle", "tick");
  }
  for (const Tick& tick : ticks_of(frame.y, 5)) {
    const double y = frame.at_y(tick.value);
    all += svg::line(kLeft, y, right, y, "grid");
    all += svg::label(kLeft - 6.0, y + 4.0, tick.label, "end", "tick");
  }
  all += svg::label(kLeft + frame.across() / 2.0, bottom + 36.0,
                    svg::shortened(figure.x_label, svg::room_in(frame.across())), "middle",
                    "axis");
  const double middle = frame.top + kPlot / 2.0;
  all += element("g", {{"transform", "translate(14 " + svg::pixels(middle) + ") rotate(-90)"}},
                 svg::label(0.0, 0.0, svg::shortened(figure.y_label, 34), "middle", "axis"));
  return all;
}

/// "M1,2 3,4" with a new M behind each gap.
std::string path_of(const Series& series, const Frame& frame) {
  std::string path;
  bool open = false;
  const auto columns = static_cast<Index>(frame.across());
  for (const Index i : shown_samples(series.x, series.y, frame.x, columns)) {
    const double x = frame.at_x(series.x[i]), y = frame.at_y(series.y[i]);
    if (!std::isfinite(x) || !std::isfinite(y)) {
      open = false;
      continue;
    }
    path += open ? " " : "M";
    path += svg::pixels(x, kPartsOfAPixel) + "," + svg::pixels(y, kPartsOfAPixel);
    // A line of no length with round ends is a dot.
    if (series.dots) path += "h0";
    open = !series.dots;
  }
  return path;
}

Markup curves(const LineFigure& figure, const Frame& frame) {
  Markup all;
  if (figure.band) {
    const double high = frame.at_y(figure.band->high), low = frame.at_y(figure.band->low);
    all += empty_element("rect", {{"x", svg::pixels(kLeft)},
                                  {"y", svg::pixels(high)},
                                  {"width", svg::pixels(frame.across())},
                                  {"height", svg::pixels(low - high)},
                                  {"class", "band"}});
  }
  for (std::size_t s = 0; s < figure.series.size(); ++s) {
    const Series& series = figure.series[s];
    const std::string kind =
        "curve " + svg::class_of(series.curve) + (series.dots ? " dots" : "");
    all += empty_element("path", {{"d", path_of(series, frame)},
                                  {"class", kind},
                                  {"data-series", std::to_string(s)},
                                  {"data-label", series.label}});
  }
  return all;
}

std::vector<svg::Key> keys_of(const LineFigure& figure) {
  std::vector<svg::Key> keys;
  for (std::size_t s = 0; s < figure.series.size(); ++s)
    keys.push_back({figure.series[s].label, svg::class_of(figure.series[s].curve), s,
                    figure.series[s].dots});
  if (figure.band) keys.push_back({figure.band->label, "band-key", figure.series.size(), false});
  return keys;
}

/// What a script needs to show the value at a place of the picture.
Markup with_scales(const LineFigure& figure, const Frame& frame, const Markup& content) {
  const auto text = [](const Scale& scale) {
    return format_number(scale.low) + " " + format_number(scale.high) +
           (scale.logarithmic ? " log" : "");
  };
  return element("g",
                 {{"class", "plot"},
                  {"data-x", text(frame.x)},
                  {"data-y", text(frame.y)},
                  {"data-box", svg::pixels(kLeft) + " " + svg::pixels(frame.top) + " " +
                                   svg::pixels(frame.across()) + " " + svg::pixels(kPlot)},
                  {"data-xlabel", figure.x_label},
                  {"data-ylabel", figure.y_label}},
                 content);
}

Markup drawn(const LineFigure& figure, double width) {
  Frame frame = frame_of(figure, width);
  const double left = width > svg::kNarrow ? kLeft : 8.0;  // of words above the curves
  const svg::TextLines title = svg::lines(figure.title, left, frame.right(), 16.0, "title");
  const svg::Legend legend =
      svg::legend(keys_of(figure), left, frame.right(), kAbove + title.height + 14.0);
  frame.top = kAbove + title.height + legend.height + 4.0;
  const Markup content = title.markup + legend.markup + axes(figure, frame) +
                         with_scales(figure, frame, curves(figure, frame));
  return svg::drawing(figure.title, "lines", width, frame.top + kPlot + kBelow, content);
}

}  // namespace

Picture draw(const LineFigure& figure) {
  return {figure.name, figure.title, drawn(figure, svg::kWidth), figure,
          drawn(figure, svg::kNarrow)};
}

}  // namespace lacuna
