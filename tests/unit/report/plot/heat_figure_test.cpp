// SPDX-License-Identifier: MIT
#include "report/plot/heat_figure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

using ::testing::HasSubstr;

HeatFigure two_by_two() {
  return {"parts",      "Parts",
          {"a", "b<c"}, {"0 %", "1 %"},
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

}  // namespace
}  // namespace lacuna
