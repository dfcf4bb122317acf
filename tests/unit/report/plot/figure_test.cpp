// SPDX-License-Identifier: MIT
#include "report/plot/figure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

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
  RowFigure figure{"rows", "", "", {{std::string(200, 'n'), 1.0, 0.5, 2.0}}, true};
  const std::string svg = draw(figure).svg.string();
  EXPECT_EQ(count(svg, "class=\"whisker\""), 3);
  EXPECT_THAT(svg, HasSubstr("\u2026</text>"));
  EXPECT_THAT(svg, HasSubstr(std::string(200, 'n') + ": 1")) << "the whole name is a tooltip";
  figure.rows[0].high.reset();
  EXPECT_EQ(count(draw(figure).svg.string(), "class=\"whisker\""), 0);
}

TEST(RowFigure, LongNamesStandAboveTheirBars) {
  const std::string name = std::string(40, 'n') + " and " + std::string(40, 'm');
  const std::string beside = draw(RowFigure{"rows", "", "", {{"short", 1.0}}}).svg.string();
  const std::string above =
      draw(RowFigure{"rows", "", "", {{"short", 1.0}, {name, 2.0}}}).svg.string();
  EXPECT_THAT(above, HasSubstr(">" + name + "</text>"));
  EXPECT_EQ(count(beside, "text-anchor=\"end\""), 1) << "beside its bar";
  EXPECT_EQ(count(above, "text-anchor=\"end\""), 0);
}

TEST(OrbitFigure, BringsWholeNumbersForTurning) {
  Matrix points(3, 3);
  points << 0, 0, 0, NAN, 0, 0, 2, 4, 8;
  const OrbitFigure figure{"orbit", "Orbit", {"x", "y", "z"}, {{"model", points}}};
  const std::string svg = draw(figure).svg.string();
  EXPECT_EQ(support::first_fault(svg), "");
  EXPECT_THAT(svg, HasSubstr("data-points=\"-1000,-1000,-1000 - 1000,1000,1000\""));
  EXPECT_EQ(count(svg, "class=\"spatial\""), 3);
}

TEST(Picture, HasItsNumbers) {
  const Picture picture = draw(lines());
  const auto* const figure = std::get_if<LineFigure>(&picture.figure);
  ASSERT_NE(figure, nullptr);
  ASSERT_EQ(figure->series.size(), 2u);
  EXPECT_EQ(figure->series[0].y, Vector(Eigen::Vector3d(0, 1, 0)));
  EXPECT_TRUE(std::holds_alternative<RowFigure>(draw(RowFigure{"r", "", "", {}}).figure));
}

TEST(StandAlone, HasItsStyleInside) {
  const std::string text = stand_alone(draw(lines()));
  EXPECT_EQ(text.rfind("<?xml", 0), 0u);
  EXPECT_THAT(text, HasSubstr("<style>"));
  EXPECT_THAT(text, Not(HasSubstr("href")));
}

}  // namespace
}  // namespace lacuna
