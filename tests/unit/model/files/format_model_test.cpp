// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

#include "core/base/random.hpp"
#include "lacuna/model/files/model_file.hpp"

namespace lacuna {
namespace {

const Variables kOnlyX{{"x"}, {}};

OdeModel decay(const WeightedTerm& summand) {
  return OdeModel({{"x", "V"}}, {}, {{summand}}, "ms");
}

TEST(FormatModel, LayoutIsOneTermPerLine) {
  EXPECT_EQ(
      format_model(decay({Term::parse("x", kOnlyX), -0.5, 0.01, {{-0.52, -0.48}}})),
      "{\"format\": \"lacuna.model/1\",\n"
      " \"time_unit\": \"ms\",\n"
      " \"states\": [\n"
      "  {\"name\":\"x\",\"unit\":\"V\"}],\n"
      " \"inputs\": [],\n"
      " \"equations\": [\n"
      "  {\"state\": \"x\", \"terms\": [\n"
      "    {\"term\":\"x\",\"coefficient\":-0.5,\"stderr\":0.01,\"ci95\":[-0.52,-0.48]}]}]}\n");
}

TEST(FormatModel, TextThatNeedsEscapesSurvives) {
  const OdeModel model({{"x", "\"\\ \xc2\xb5V"}}, {}, {{}}, "\"%");
  const OdeModel again = parse_model(format_model(model), "m");
  EXPECT_EQ(again.states(), model.states());
  EXPECT_EQ(again.time_unit(), "\"%");
}

TEST(FormatModel, CoefficientsSurviveToTheLastBit) {
  Random random(42);
  for (int i = 0; i < 2000; ++i) {
    const auto pattern = random.below(1ULL << 53) << 11 | random.below(1ULL << 11);
    const double coefficient = std::bit_cast<double>(pattern);
    if (!std::isfinite(coefficient)) continue;
    const OdeModel model = decay({Term::parse("sin(0.1*x)", kOnlyX), coefficient});
    const OdeModel again = parse_model(format_model(model), "m");
    ASSERT_EQ(std::bit_cast<std::uint64_t>(again.equations()[0][0].coefficient), pattern);
    ASSERT_EQ(again.equations()[0][0].term, model.equations()[0][0].term);
  }
}

TEST(FormatModel, ErrorsThatAreNotFiniteAreLeftOut) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const std::string text = format_model(
      decay({Term::parse("x", kOnlyX), 1.0, std::nan(""), {{-kInfinity, kInfinity}}}));
  EXPECT_THAT(text, ::testing::Not(::testing::HasSubstr("stderr")));
  EXPECT_THAT(text, ::testing::Not(::testing::HasSubstr("ci95")));
  EXPECT_EQ(parse_model(text, "m").coefficient(0, "x"), 1.0);
}

TEST(FormatModel, IntervalsThatSayNothingAreLeftOut) {
  const std::string text =
      format_model(decay({Term::parse("x", kOnlyX), 7.5e-12, 1e71, {{-2e71, 2e71}}}));
  EXPECT_THAT(text, ::testing::HasSubstr("\"stderr\":1e+71"));
  EXPECT_THAT(text, ::testing::Not(::testing::HasSubstr("ci95")));
}

}  // namespace
}  // namespace lacuna
