// SPDX-License-Identifier: MIT
#include "report/pages/run_figures.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <variant>

#include "lacuna/model/files/model_file.hpp"
#include "report/pages/pages.hpp"

namespace lacuna {
namespace {

using ::testing::HasSubstr;

GapRecord run(Index n) {
  const Vector t = Vector::LinSpaced(n, 0.0, 0.1 * static_cast<double>(n - 1));
  Matrix measured(n, 1), before(n, 1), after(n, 1);
  measured << (6.283185307179586 * t.array()).sin();
  before << measured.array() + 0.3;
  after << measured.array() - 0.1;
  return {"run.csv", t, measured, before, after, 0, 50};
}

int count(const std::string& text, const std::string& part) {
  int found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++found;
  return found;
}

TEST(RunFigures, SayHowFarModelsAreOff) {
  const std::vector<GapRecord> runs{run(200)};
  const RunView view{runs, {{"x", "V"}}, "s", Vector::Constant(1, 0.05)};
  const auto pictures = deviation_pictures(view);
  ASSERT_EQ(pictures.size(), 1u);
  EXPECT_THAT(pictures[0].svg.string(), HasSubstr("nominal model, rms 0.3<"));
  EXPECT_THAT(pictures[0].svg.string(), HasSubstr("model, rms 0.1<"));
  EXPECT_THAT(pictures[0].svg.string(), HasSubstr("difference in x [V]"));
  // rms 0.3 and 0.1 over the deviation of a sine, 1 / sqrt(2).
  EXPECT_NEAR(relative_misfit(runs, true), 0.3 * std::sqrt(2.0), 0.01);
  EXPECT_NEAR(relative_misfit(runs, false), 0.1 * std::sqrt(2.0), 0.01);
}

/// The values of a curve of a picture by their times.
std::map<double, double> values_of(const Picture& picture, const std::string& label) {
  std::map<double, double> values;
  for (const Series& series : std::get<LineFigure>(picture.figure).series)
    if (series.label.rfind(label, 0) == 0)
      for (Index i = 0; i < series.x.size(); ++i)
        if (std::isfinite(series.y[i])) values[series.x[i]] = series.y[i];
  return values;
}

TEST(RunFigures, PanelsThatShowTheSameThingAgree) {
  std::vector<GapRecord> runs{run(200)};
  GapRecord& one = runs[0];
  one.measured = (Matrix(200, 3) << one.measured, 2.0 * one.measured, one.before).finished();
  one.before = one.measured.array() + 0.3;
  one.after = one.measured.array() * 1.01;
  const RunView view{runs, {{"x", ""}, {"y", ""}, {"z", ""}}, "s", Vector()};
  const auto shown = comparison_pictures(view), left = deviation_pictures(view);
  const Picture orbit = orbit_pictures(view).at(0);
  const auto& orbits = std::get<OrbitFigure>(orbit.figure).orbits;
  ASSERT_EQ(shown.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    const auto measured = values_of(shown[k], "measured");
    EXPECT_EQ(measured.size(), 200u);
    for (const std::string& label : {view.before, view.after}) {
      const auto model = values_of(shown[k], label), off = values_of(left[k], label);
      EXPECT_EQ(off.size(), 200u) << label;
      for (const auto& [time, value] : off)
        EXPECT_NEAR(measured.at(time) - model.at(time), value, 1e-6) << label << time;
    }
    Index row = 0;
    for (const auto& [time, value] : measured)
      EXPECT_NEAR(orbits[0].points(row++, static_cast<Index>(k)), value, 1e-6) << time;
  }
}

TEST(RunFigures, WindowsAreNotJoined) {
  const std::vector<GapRecord> runs{run(200)};
  const auto pictures = comparison_pictures({runs, {{"x", "V"}}, "s", Vector()});
  const std::string svg = pictures.at(0).svg.string();
  const std::size_t at = svg.find("curve before", svg.find("class=\"plot\""));
  const std::size_t begin = svg.rfind("<path", at);
  EXPECT_EQ(count(svg.substr(begin, at - begin), "M"), 4) << "200 samples in windows of 50";
}

/// 230 samples in windows of 50: there is no model behind the fourth.
TEST(RunFigures, EndWithTheLastWholeWindow) {
  std::vector<GapRecord> runs{run(230)};
  runs[0].after.bottomRows(30).setConstant(NAN);
  const RunView view{runs, {{"x", "V"}}, "s", Vector()};
  const Picture shown = comparison_pictures(view).at(0), left = deviation_pictures(view).at(0);
  EXPECT_EQ(values_of(shown, "measured").size(), 200u);
  EXPECT_NEAR(values_of(shown, "measured").rbegin()->first, 19.9, 1e-9);
  EXPECT_EQ(values_of(left, view.after).size(), 200u);
  EXPECT_EQ(left.title, "x [V]: measured minus model in windows of 5 s");
  EXPECT_EQ(stretch_text(view), "in windows of 5 s");
  runs[0].length = 0;
  EXPECT_EQ(deviation_pictures(view).at(0).title,
            "x [V]: measured minus model over the whole record");
}

TEST(RunFigures, WindowsBeginWhereTheFirstDoes) {
  std::vector<GapRecord> runs{run(230)};
  runs[0].begin = 30;
  const auto measured = values_of(
      comparison_pictures({runs, {{"x", "V"}}, "s", Vector()}).at(0), "measured");
  EXPECT_EQ(measured.size(), 200u);
  EXPECT_NEAR(measured.begin()->first, 3.0, 1e-9);
}

TEST(RunFigures, TheLongestRecordIsShown) {
  std::vector<GapRecord> runs{run(100), run(300)};
  runs[1].source = "/data/long.csv";
  const auto pictures = comparison_pictures({runs, {{"x", ""}}, "s", Vector()});
  EXPECT_THAT(pictures.at(0).title, HasSubstr("long.csv"));
}

TEST(RunFigures, AStateThatNobodyMeasuredIsShownAsTheModelHasIt) {
  std::vector<GapRecord> runs{run(200)};
  runs[0].measured.setConstant(NAN);
  const RunView view{runs, {{"x", ""}}, "s", Vector()};
  EXPECT_EQ(count(comparison_pictures(view).at(0).svg.string(), "class=\"key\""), 2);
  EXPECT_TRUE(deviation_pictures(view).empty());
  EXPECT_TRUE(spectrum_pictures(view).empty());
}

TEST(RunFigures, ShortRecordsHaveNoSpectrumAndOneStateNoOrbit) {
  const std::vector<GapRecord> runs{run(40)};
  const RunView view{runs, {{"x", ""}}, "s", Vector()};
  EXPECT_TRUE(spectrum_pictures(view).empty());
  EXPECT_TRUE(orbit_pictures(view).empty());
  EXPECT_TRUE(comparison_pictures({{}, {{"x", ""}}, "s", Vector()}).empty());
}

/// Two records of two and three samples, with noise in proportion to the value.
TEST(FitPage, ShowsAllRecordsAndTheNoiseOfTheLaw) {
  Fit fit{.model = parse_ode_system("param k = 1\ndx/dt = -k*x\ny = x noise proportional\n",
                                    "m.ode")};
  FitQuality y;
  y.channel = "y";
  y.law = NoiseLaw{.form = NoiseForm::Proportional, .fraction = 0.1};
  fit.quality = {y};
  for (const Index n : {2, 3}) {
    const Matrix values = Matrix::Constant(n, 1, static_cast<double>(n));
    fit.runs.push_back({"r", Vector::LinSpaced(n, 0.0, 1.0), values, values, Matrix()});
  }
  std::map<std::string, LineFigure> figures;
  for (const PageSection& section : fit_page(fit).sections)
    for (const Picture& picture : section.pictures)
      figures.emplace(picture.name, std::get<LineFigure>(picture.figure));
  const std::vector<Series>& beside = figures.at("comparison_y").series;
  ASSERT_EQ(beside.back().y.size(), 6);
  EXPECT_EQ(beside.back().y[1], 2.0);
  EXPECT_TRUE(std::isnan(beside.back().y[2])) << "a gap between the records";
  EXPECT_EQ(beside.back().y[5], 3.0);
  const LineFigure& off = figures.at("deviation_y");
  EXPECT_FALSE(off.band) << "no level is that of all values";
  const Series& noise = off.series.back();
  EXPECT_NEAR(noise.y[0], -1.96 * 0.2, 1e-3);
  EXPECT_NEAR(noise.y[noise.y.size() - 1], 1.96 * 0.3, 1e-3);
}

}  // namespace
}  // namespace lacuna
