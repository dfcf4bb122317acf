// SPDX-License-Identifier: MIT
#include "report/plot/figure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "lacuna/core/base/error.hpp"
#include "report/plot/heat_figure.hpp"
#include "report/plot/markup.hpp"
#include "support/well_formed.hpp"

namespace lacuna {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

int count(const std::string& text, const std::string& part) {
  int found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++found;
  return found;
}

LineFigure lines() {
  LineFigure figure{"lines", "A < B", "time [s]", "x [V]", {}};
  figure.series.push_back({"measured <b>", Eigen::Vector3d(0, 1, 2), Eigen::Vector3d(0, 1, 0),
                           Curve::Measured, true});
  figure.series.push_back(
      {"model", Eigen::Vector4d(0, 1, 2, 3), Eigen::Vector4d(0, NAN, 1, 2), Curve::Model});
  figure.band = Band{"noise", -0.5, 0.5};
  return figure;
}

TEST(LineFigure, IsWellFormedAndEscaped) {
  const std::string svg = draw(lines()).svg.string();
  EXPECT_EQ(support::first_fault(svg), "");
  EXPECT_THAT(svg, HasSubstr("measured &lt;b&gt;"));
  EXPECT_THAT(svg, HasSubstr("A &lt; B"));
  EXPECT_THAT(svg, HasSubstr("time [s]"));
  EXPECT_EQ(count(svg, "class=\"key\""), 3);
  EXPECT_EQ(count(svg, "class=\"band\""), 1);
}

TEST(LineFigure, CurvesAreSplitWhereThereIsNoValue) {
  const std::string svg = draw(lines()).svg.string();
  const std::size_t at = svg.find("d=\"", svg.rfind("<path"));
  const std::string path = svg.substr(at, svg.find('"', at + 3) - at);
  EXPECT_EQ(count(path, "M"), 2) << path;
}

/// Numbers behind each other in an attribute behind a place in a text.
std::vector<double> numbers_of(const std::string& svg, const std::string& name,
                               std::size_t from) {
  const std::size_t at = svg.find(" " + name + "=\"", from) + name.size() + 3;
  std::string text = svg.substr(at, svg.find('"', at) - at);
  std::replace_if(text.begin(), text.end(), [](char c) { return c == 'M' || c == ','; }, ' ');
  std::istringstream words(text);
  std::vector<double> numbers;
  for (double number = 0.0; words >> number;) numbers.push_back(number);
  return numbers;
}

TEST(LineFigure, WhatIsDrawnHasTheValuesTo1e6OfTheirRange) {
  LineFigure figure{"lines", "sine", "t", "x", {}};
  const Vector t = Vector::LinSpaced(300, 0.0, 7.0);
  figure.series.push_back({"model", t, t.array().sin(), Curve::Model});
  const std::string svg = draw(figure).svg.string();
  const std::size_t plot = svg.find("class=\"plot\"");
  const auto box = numbers_of(svg, "data-box", plot), x = numbers_of(svg, "data-x", plot),
             y = numbers_of(svg, "data-y", plot), drawn = numbers_of(svg, "d", plot);
  ASSERT_EQ(drawn.size(), 600u);
  for (std::size_t i = 0; i < 300; ++i) {
    const double time = x[0] + (drawn[2 * i] - box[0]) / box[2] * (x[1] - x[0]);
    const double value = y[0] + (1.0 - (drawn[2 * i + 1] - box[1]) / box[3]) * (y[1] - y[0]);
    EXPECT_NEAR(time, t[static_cast<Index>(i)], 1e-6 * 7.0);
    EXPECT_NEAR(value, std::sin(t[static_cast<Index>(i)]), 1e-6 * 2.0);
  }
}

TEST(LineFigure, OfNothingIsStillOne) {
  EXPECT_EQ(support::first_fault(draw(LineFigure{"e", "", "", "", {}}).svg.string()), "");
  LineFigure flat{"flat", "", "", "", {{"x", Vector::Zero(5), Vector::Zero(5)}}};
  flat.logarithmic_y = true;
  EXPECT_EQ(support::first_fault(draw(flat).svg.string()), "");
}

TEST(LineFigure, AMillionSamplesAreAFewKilobytes) {
  const Vector x = Vector::LinSpaced(1000000, 0.0, 1.0);
  const LineFigure figure{"big", "", "", "", {{"x", x, (1e4 * x.array()).sin()}}};
  EXPECT_LT(draw(figure).svg.string().size(), 60000u);
}

TEST(RowFigure, BarsAreAsLongAsTheirValues) {
  const RowFigure figure{"rows", "Rivals", "criterion", {{"a", 1.0}, {"b", 2.0}}};
  const std::string svg = draw(figure).svg.string();
  EXPECT_EQ(support::first_fault(svg), "");
  std::vector<double> widths;
  for (std::size_t at = svg.find("<rect"); at != std::string::npos;
       at = svg.find("<rect", at + 1))
    widths.push_back(std::stod(svg.substr(svg.find("width=\"", at) + 7)));
  ASSERT_EQ(widths.size(), 2u);
  EXPECT_NEAR(widths[1], 2.0 * widths[0], 0.2);
}

TEST(RowFigure, IntervalsHaveWhiskersAndLongNamesAreCut) {
  RowFigure figure{"rows", "", "", {{std::string(400, 'n'), 1.0, 0.5, 2.0}}, true};
  const std::string svg = draw(figure).svg.string();
  EXPECT_EQ(count(svg, "class=\"whisker\""), 3);
  EXPECT_THAT(svg, HasSubstr("\u2026</text>"));
  EXPECT_THAT(svg, HasSubstr(std::string(400, 'n') + ": 1")) << "the whole name is a tooltip";
  figure.rows[0].high.reset();
  EXPECT_EQ(count(draw(figure).svg.string(), "class=\"whisker\""), 0);
}

/// For a phone: what a picture says is whole there, in lines of its own where that takes them.
TEST(Picture, IsDrawnForAPhoneToo) {
  LineFigure figure = lines();
  figure.title = "v [m/s]: measured minus model in windows of 3.9 s";
  const std::string wide = draw(figure).svg.string(), narrow = draw(figure).narrow.string();
  EXPECT_EQ(support::first_fault(narrow), "");
  EXPECT_THAT(wide, HasSubstr(">" + figure.title + "</text>"));
  EXPECT_THAT(narrow, Not(HasSubstr(">" + figure.title + "</text>")));
  EXPECT_THAT(narrow, HasSubstr("viewBox=\"0 0 360 "));
  EXPECT_THAT(narrow, Not(HasSubstr("\u2026")));
  EXPECT_THAT(wide, Not(HasSubstr(" narrow\"")));
  const RowFigure rows{"rows", "", "", {{"sin(2*pi*0.7102*t+1.561) in dv/dt", 1.0}}};
  EXPECT_THAT(draw(rows).narrow.string(), HasSubstr(">sin(2*pi*0.7102*t+1.561) in dv/dt</text>"));
}

TEST(OrbitFigure, BringsNumbersForTurning) {
  Matrix points(3, 3);
  points << 0, 0, 0, NAN, 0, 0, 2, 4, 8;
  const OrbitFigure figure{"orbit", "Orbit", {"x", "y", "z"}, {{"model", points}}};
  const std::string svg = draw(figure).svg.string();
  EXPECT_EQ(support::first_fault(svg), "");
  EXPECT_THAT(svg, HasSubstr("data-points=\"-1000,-1000,-1000 - 1000,1000,1000\""));
  EXPECT_THAT(svg, HasSubstr("data-ranges=\"0 2 0 4 0 8\""));
  EXPECT_EQ(count(svg, "class=\"spatial\""), 3);
}

TEST(StandAlone, HasItsStyleInside) {
  const std::string text = stand_alone(draw(lines()));
  EXPECT_EQ(text.rfind("<?xml", 0), 0u);
  EXPECT_THAT(text, HasSubstr("<style>"));
  EXPECT_THAT(text, Not(HasSubstr("href")));
}

HeatFigure two_by_two() {
  return {"parts",
          "Parts",
          {"a", "b<c"},
          {"0 %", "1 %"},
          {{"100", "50"}, {"0", "-"}},
          {{1.0, 0.5}, {0.0, std::nullopt}}};
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++count;
  return count;
}

TEST(HeatFigure, ShadesCellsThatHaveANumber) {
  const std::string svg = draw(two_by_two()).svg.string();
  EXPECT_EQ(count_of(svg, "class=\"heat\""), 3u);
  EXPECT_THAT(svg, HasSubstr("fill-opacity=\"0.6\""));
  EXPECT_THAT(svg, HasSubstr("fill-opacity=\"0.3\""));
  EXPECT_THAT(svg, HasSubstr("b&lt;c"));
}

TEST(HeatFigure, KeepsItsNumbers) {
  const RowFigure rows = std::get<RowFigure>(draw(two_by_two()).figure);
  ASSERT_EQ(rows.rows.size(), 4u);
  EXPECT_EQ(rows.rows[1].label, "a, 1 %");
  EXPECT_EQ(rows.rows[1].value, 0.5);
}

TEST(Markup, TextCannotBecomeMarkup) {
  EXPECT_EQ(escape_markup("<script>alert('1' & \"2\")</script>"),
            "&lt;script&gt;alert(&#39;1&#39; &amp; &quot;2&quot;)&lt;/script&gt;");
  EXPECT_EQ(Markup::text("a<b").string(), "a&lt;b");
}

TEST(Markup, ControlCharactersAndBytesThatAreNoTextAreShown) {
  EXPECT_EQ(escape_markup("a\x1b[1m"), "a\\x1b[1m");
  EXPECT_EQ(escape_markup("\xff"), "\\xff");
  EXPECT_EQ(escape_markup("\u03c6"), "\u03c6");
}

TEST(Markup, AttributesAreEscaped) {
  EXPECT_EQ(element("p", {{"title", "\"><b>"}}, Markup::text("x")).string(),
            "<p title=\"&quot;&gt;&lt;b&gt;\">x</p>");
  EXPECT_EQ(empty_element("br", {}).string(), "<br/>");
}

TEST(Markup, PiecesFollowOneAnother) {
  Markup both = element("i", Markup::text("a")) + Markup::own("<hr/>");
  both += Markup::text("&");
  EXPECT_EQ(both.string(), "<i>a</i><hr/>&amp;");
  EXPECT_TRUE(Markup().empty());
}

}  // namespace
}  // namespace lacuna
