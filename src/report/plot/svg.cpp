// SPDX-License-Identifier: MIT
#include "svg.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <vector>

#include "core/base/utf8.hpp"

namespace lacuna::svg {
namespace {

constexpr double kCharacter = 7.0;  // of the 12 pixel font, on average

std::size_t characters(const std::string& text) {
  std::size_t count = 0;
  for (std::size_t at = 0; at < text.size(); ++count)
    at += std::max<std::size_t>(1, utf8_length(text, at));
  return count;
}

}  // namespace

std::string pixels(double value, double parts) {
  std::array<char, 32> buffer{};
  const double rounded = std::round(std::clamp(value, -1e6, 1e6) * parts) / parts;
  const auto [end, error] =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), rounded + 0.0);
  return error == std::errc() ? std::string(buffer.data(), end) : "0";
}

std::string class_of(Curve curve) {
  switch (curve) {
    case Curve::Measured:
      return "measured";
    case Curve::Before:
      return "before";
    case Curve::Model:
      return "model";
    case Curve::Other:
      break;
  }
  return "other";
}

Markup label(double x, double y, const std::string& text, const std::string& anchor,
             const std::string& kind) {
  return element("text",
                 {{"x", pixels(x)}, {"y", pixels(y)}, {"class", kind}, {"text-anchor", anchor}},
                 Markup::text(text));
}

std::string shortened(const std::string& text, std::size_t most) {
  if (characters(text) <= most) return text;
  std::size_t at = 0;
  for (std::size_t count = 0; count + 1 < most; ++count)
    at += std::max<std::size_t>(1, utf8_length(text, at));
  return text.substr(0, at) + "\u2026";
}

double width_of(const std::string& text) {
  return kCharacter * static_cast<double>(characters(text));
}

std::size_t room_in(double pixels) {
  return static_cast<std::size_t>(std::max(8.0, pixels / kCharacter));
}

TextLines lines(const std::string& text, double x, double right, double y,
                const std::string& kind) {
  constexpr double kLine = 17.0;
  constexpr std::size_t kMostLines = 3;
  // Titles are bold.
  const double wide = kind == "title" ? 1.15 : 1.0;
  const std::size_t room = room_in((right - x) / wide);
  TextLines all;
  std::string rest = text;
  for (std::size_t i = 0; !rest.empty() && i < kMostLines; ++i) {
    std::string part = rest;
    if (characters(rest) > room && i + 1 < kMostLines) {
      std::size_t end = shortened(rest, room).size() - std::string("\u2026").size();
      const std::size_t blank = rest.rfind(' ', end);
      if (blank != std::string::npos && blank > 0) end = blank;
      part = rest.substr(0, end);
    }
    rest.erase(0, std::min(part.size() + (rest[part.size()] == ' ' ? 1 : 0), rest.size()));
    all.height = kLine * static_cast<double>(i);
    all.markup += label(x, y + all.height, shortened(part, room), "start", kind);
  }
  return all;
}

Markup line(double x1, double y1, double x2, double y2, const std::string& kind) {
  return empty_element("line", {{"x1", pixels(x1)},
                                {"y1", pixels(y1)},
                                {"x2", pixels(x2)},
                                {"y2", pixels(y2)},
                                {"class", kind}});
}

Legend legend(const std::vector<Key>& keys, double left, double right, double top) {
  constexpr double kLine = 18.0, kSwatch = 22.0, kSpace = 16.0;
  Legend result;
  double x = left, y = top;
  for (const Key& key : keys) {
    const std::string text = shortened(key.label, room_in(right - left - kSwatch));
    const double width = kSwatch + width_of(text) + kSpace;
    if (x > left && x + width > right) {
      x = left;
      y += kLine;
    }
    // Three dots for points, as they are drawn: lines of no length.
    Markup swatch;
    for (const double at : key.dots ? std::vector{2.0, 8.0, 14.0} : std::vector<double>{})
      swatch += line(x + at, y - 4.0, x + at, y - 4.0, "curve " + key.kind + " dots");
    if (!key.dots) swatch = line(x, y - 4.0, x + 16.0, y - 4.0, "curve " + key.kind);
    result.markup += element("g",
                             {{"class", "key"},
                              {"data-series", std::to_string(key.number)},
                              {"tabindex", "0"},
                              {"role", "button"}},
                             swatch + label(x + kSwatch, y, text));
    x += width;
  }
  result.height = keys.empty() ? 0.0 : y - top + kLine;
  return result;
}

Markup drawing(const std::string& title, const std::string& kind, double width, double height,
               const Markup& content) {
  return element("svg",
                 {{"xmlns", "http://www.w3.org/2000/svg"},
                  {"viewBox", "0 0 " + pixels(width) + " " + pixels(height)},
                  {"width", pixels(width)},
                  {"height", pixels(height)},
                  {"class", "picture " + kind + (width > kNarrow ? "" : " narrow")},
                  // What can be pressed is no part of an image.
                  {"role", kind == "lines" || kind == "orbit" ? "group" : "img"}},
                 element("title", Markup::text(title)) + content);
}

}  // namespace lacuna::svg
