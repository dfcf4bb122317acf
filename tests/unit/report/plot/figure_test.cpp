// SPDX-License-Identifier: MIT
#include "report/plot/figure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

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

}  // namespace
}  // namespace lacuna
