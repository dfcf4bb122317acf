// SPDX-License-Identifier: MIT
#include "support/cell_values.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "lacuna/core/base/types.hpp"

namespace lacuna::benchmarks {
namespace {

enum class Colour { Red, Green };

struct Inner {
  int count = 0;
  bool yes = false;

  auto fields() { return std::tie(count, yes); }
};

struct Everything {
  double number = 0.0;
  std::string text;
  Colour colour = Colour::Red;
  std::optional<double> known, unknown;
  Vector values;
  std::vector<Inner> inner;
  std::array<Colour, 2> colours{};

  auto fields() {
    return std::tie(number, text, colour, known, unknown, values, inner, colours);
  }
};

/// Written as text and read again.
template <class T>
T again(T value) {
  T read{};
  read_value(nlohmann::json::parse(json_of(value).dump()), read);
  return read;
}

TEST(CellValues, NumbersAreTheSameToTheBit) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  for (const double value : {0.1, 1.0 / 3.0, 5e-324, 1.7976931348623157e308, -2.0 / 3e-7, 42.0,
                             kInfinity, -kInfinity})
    EXPECT_EQ(again(value), value);
  EXPECT_TRUE(std::signbit(again(-0.0)));
  EXPECT_TRUE(std::isnan(again(std::numeric_limits<double>::quiet_NaN())));
}

TEST(CellValues, StructsListTheirFields) {
  Vector values(2);
  values << 0.1, -std::numeric_limits<double>::infinity();
  const Everything there{1e-300,
                         "a \"b\",\n\xC3\xA4",
                         Colour::Green,
                         0.7,
                         {},
                         values,
                         {{3, true}, {-4, false}},
                         {Colour::Green, Colour::Red}};
  const Everything read = again(there);
  EXPECT_EQ(read.number, there.number);
  EXPECT_EQ(read.text, there.text);
  EXPECT_EQ(read.colour, Colour::Green);
  EXPECT_EQ(read.known, there.known);
  EXPECT_FALSE(read.unknown.has_value());
  EXPECT_EQ(read.values, values);
  ASSERT_EQ(read.inner.size(), 2u);
  EXPECT_EQ(read.inner[1].count, -4);
  EXPECT_TRUE(read.inner[0].yes);
  EXPECT_EQ(read.colours, there.colours);
}

TEST(CellValues, NothingTakesThePlaceOfSomething) {
  std::optional<double> value = 1.0;
  read_value(nlohmann::json(), value);
  EXPECT_FALSE(value.has_value());
  std::vector<int> list{1, 2, 3};
  read_value(nlohmann::json::array(), list);
  EXPECT_TRUE(list.empty());
}

TEST(CellValues, OtherValuesAreAnError) {
  Inner inner;
  EXPECT_THROW(read_value(nlohmann::json::parse("[1]"), inner), nlohmann::json::exception);
  EXPECT_THROW(read_value(nlohmann::json::parse("[\"a\",true]"), inner),
               nlohmann::json::exception);
}

}  // namespace
}  // namespace lacuna::benchmarks
