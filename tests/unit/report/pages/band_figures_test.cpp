// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <variant>

#include "report/pages/run_figures.hpp"

namespace lacuna {
namespace {

/// A run of n samples of a hidden state z and a measured one x.
FitBands run_of(const std::string& record, Index n) {
  const Vector time = Vector::LinSpaced(n, 0.0, 1.0);
  const Matrix value = time * Eigen::RowVector2d(1.0, 2.0);
  Matrix least = value.array() - 0.5, most = value.array() + 0.5;
  least.col(0).setConstant(std::nan(""));
  most.col(0).setConstant(std::nan(""));
  return {record,
          time,
          {{"z", ""}, {"x", "V"}},
          value,
          Matrix::Constant(n, 2, 0.1),
          value.array() - 0.2,
          value.array() + 0.2,
          least,
          most};
}

/// Three samples of a, a gap, five of b.
TEST(BandPictures, ShowAllRunsMeasuredQuantitiesFirst) {
  const std::vector<Picture> pictures =
      band_pictures("bands", {run_of("a", 3), run_of("b", 5)}, {}, {}, "s");
  ASSERT_EQ(pictures.size(), 2u);
  EXPECT_EQ(pictures[0].name, "bands_x");
  const auto& figure = std::get<LineFigure>(pictures[0].figure);
  ASSERT_EQ(figure.series.size(), 3u);
  ASSERT_EQ(figure.series[2].y.size(), 9);
  EXPECT_EQ(figure.series[2].y[2], 2.0);
  EXPECT_TRUE(std::isnan(figure.series[2].y[3]));
  EXPECT_EQ(figure.series[2].y[8], 2.0);
  EXPECT_EQ(figure.y_label, "x [V]");
  // Both ends of a band, a gap between them.
  EXPECT_NEAR(figure.series[0].y[0], -0.5, 1e-12);
  EXPECT_TRUE(std::isnan(figure.series[0].y[9]));
  EXPECT_NEAR(figure.series[0].y[10], 0.5, 1e-12);
  EXPECT_NEAR(figure.series[1].y[0], -0.2, 1e-12);
  EXPECT_EQ(std::get<LineFigure>(pictures[1].figure).series.size(), 2u) << "no values of z";
}

TEST(BandPictures, HaveTheSamplesOfTheirRecord) {
  const Matrix ones = Matrix::Ones(5, 1);
  const FitRun run{"b", Vector::LinSpaced(5, 0.0, 1.0), ones, ones, Matrix()};
  FitQuality x;
  x.channel = "x";
  const std::vector<Picture> pictures =
      band_pictures("bands", {run_of("b", 5)}, {run}, {x}, "s");
  const auto& series = std::get<LineFigure>(pictures[0].figure).series;
  ASSERT_EQ(series.size(), 4u);
  EXPECT_TRUE(series[3].dots);
  EXPECT_EQ(series[3].y[2], 1.0);
  EXPECT_TRUE(band_pictures("none", {}, {}, {}, "s").empty());
}

}  // namespace
}  // namespace lacuna
