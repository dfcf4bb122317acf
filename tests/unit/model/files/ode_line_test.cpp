// SPDX-License-Identifier: MIT
#include "model/files/ode_line.hpp"

#include <gtest/gtest.h>

#include "lacuna/core/base/error.hpp"

namespace lacuna {
namespace {

const std::string kSource = "m.ode";

TEST(OdeLine, TakesWholeWordsOnly) {
  OdeLine line("  statement state x", 1, kSource);
  EXPECT_FALSE(line.take("state"));
  EXPECT_TRUE(line.take("statement"));
  EXPECT_TRUE(line.take("state"));
  EXPECT_EQ(line.identifier("name"), "x");
  EXPECT_TRUE(line.at_end());
}

TEST(OdeLine, AValueEndsBeforeItsUnitOrAWordBehindIt) {
  for (const char* text : {"2*inner + 1 [V] fixed", "2*inner + 1 in 0..3", "2*inner + 1fixed",
                           "2*inner + 1 fixed", "2*inner + 1"}) {
    OdeLine line(text, 1, kSource);
    EXPECT_EQ(line.value(), std::string(text) == "2*inner + 1fixed" ? text : "2*inner + 1");
  }
}

TEST(OdeLine, UnitsStandInBrackets) {
  OdeLine line(" [ m/s ] rest", 1, kSource);
  EXPECT_EQ(line.unit(), "m/s");
  EXPECT_EQ(line.unit(), "");
  EXPECT_EQ(line.formula(), "rest");
}

TEST(OdeLine, PlacesCountFromOne) {
  OdeLine line("ab = c", 7, kSource);
  EXPECT_EQ(line.place(), "m.ode:7:1");
  line.identifier("name");
  line.expect('=');
  const std::string_view formula = line.formula();
  EXPECT_EQ(line.place_of(formula), "m.ode:7:6");
  EXPECT_THROW(line.formula(), ModelError);
}

TEST(OdeLine, AHashInBracketsIsNoComment) {
  OdeLine line("x [#/s] # the [rate]", 1, kSource);
  EXPECT_EQ(line.identifier("name"), "x");
  EXPECT_EQ(line.unit(), "#/s");
  EXPECT_TRUE(line.at_end());
}

TEST(OdeLine, KeywordsBeforeAnEqualsSignAreNames) {
  OdeLine output("time = 2*x", 1, kSource);
  EXPECT_FALSE(output.take_keyword("time"));
  EXPECT_EQ(output.identifier("name"), "time");
  OdeLine statement("time [ms]", 1, kSource);
  EXPECT_TRUE(statement.take_keyword("time"));
  EXPECT_EQ(statement.time_unit(), "ms");
  OdeLine bare("time  1/s ", 1, kSource);
  bare.take("time");
  EXPECT_EQ(bare.time_unit(), "1/s");
}

}  // namespace
}  // namespace lacuna
