// SPDX-License-Identifier: MIT
#include "core/base/names.hpp"

#include <gtest/gtest.h>

#include "lacuna/core/base/error.hpp"
#include "lacuna/model/expressions/expression.hpp"

namespace lacuna {
namespace {

TEST(Names, IdentifiersStartWithALetter) {
  for (const char* name : {"x", "x_1", "_x", "Th2"}) EXPECT_TRUE(is_identifier(name)) << name;
  for (const char* name : {"", "1x", "x y", "x-y", "\xcf\x86"})
    EXPECT_FALSE(is_identifier(name)) << name;
}

TEST(Names, EveryFunctionOfTheLanguageIsReserved) {
  for (const char* name :
       {"sin", "cos", "tan", "asin", "acos", "atan", "tanh", "exp", "log", "sqrt", "abs",
        "sign", "min", "max", "step", "clip", "delay", "pi", "t"})
    EXPECT_TRUE(is_reserved_name(name)) << name;
  EXPECT_FALSE(is_reserved_name("x"));
}

TEST(Names, AReservedNameIsNoVariable) {
  EXPECT_THROW(Expression::variable("sin"), ModelError);
  EXPECT_EQ(Expression::variable("t").name(), "t");
}

TEST(Names, AreIdentifiersOfBoundedLength) {
  EXPECT_FALSE(name_fault("x_1"));
  EXPECT_FALSE(name_fault(std::string(kLongestName, 'x')));
  EXPECT_TRUE(name_fault(std::string(kLongestName + 1, 'x')));
  EXPECT_EQ(name_fault("a\xE2\x80\xAE"
                       "b")
                ->problem,
            "the name 'a\\u202eb' is not an identifier");
  EXPECT_EQ(name_fault("sin")->problem, "the name 'sin' is a word of the formula language");
}

TEST(Names, UnitsAreComposedVisibleAndWrittenFromTheLeft) {
  for (const char* unit : {"", "V", "m/s^2", "N m",
                           "\xC2\xB0"
                           "C",
                           "\xC2\xB5m", "k\xCE\xA9", "m\xC2\xB2", "\xC3\x85", "\xE2\x84\x83",
                           "\xE7\xA7\x92", "\xD0\xBA\xD0\xB3", "#/cm3", "\"", "\\"})
    EXPECT_FALSE(unit_fault(unit)) << unit;
  for (const char* unit : {" V",           "V ",
                           "a\tb",         "a\nb",
                           "a\rb",         "\x1b[31m",
                           "\x7f",         "\xC2\x85",
                           "\xC2\xA0",     "\xC2\xAD",
                           "e\xCC\x81",    "\xE2\x84\xA6",
                           "\xE2\x84\xAA", "\xE2\x84\xAB",
                           "\xE2\x80\x8B", "\xE2\x80\x8D",
                           "\xE2\x80\x8E", "\xE2\x80\xA8",
                           "\xE2\x80\xA9", "\xE2\x80\xAE",
                           "\xE2\x81\xA6", "\xE2\x81\xA0",
                           "\xEF\xBB\xBF", "\xD8\x9C",
                           "\xD9\x85",     "\xF0\x9F\x98\x80",
                           "[V]",          "\xFF",
                           "\xE2\x84"})
    EXPECT_TRUE(unit_fault(unit)) << unit;
  EXPECT_FALSE(unit_fault(std::string(kLongestName, 'm')));
  EXPECT_TRUE(unit_fault(std::string(kLongestName + 1, 'm')));
}

TEST(Names, AFaultSaysWhereAndWhatToWrite) {
  const auto ohm = unit_fault("k\xE2\x84\xA6");
  EXPECT_EQ(ohm->at, 1u);
  EXPECT_EQ(ohm->problem, "the unit 'k\xE2\x84\xA6' has the character U+2126");
  EXPECT_EQ(ohm->remedy, "write \xCE\xA9 (U+03A9)");
  EXPECT_EQ(unit_fault("a\xC2\xA0"
                       "b")
                ->remedy,
            "write a blank");
  EXPECT_EQ(unit_fault("\xE2\x80\xAE")->remedy, "remove it");
  EXPECT_EQ(unit_fault("a\nb")->problem, "the unit 'a\\nb' has the character U+000A");
  EXPECT_EQ(unit_fault("\xF0\x9F\x98\x80")->remedy, "write it in other letters");
  EXPECT_LT(unit_fault(std::string(300, 'm'))->problem.size(), 100u);
}

TEST(Names, CommentsAreAnyTextThatIsSeen) {
  EXPECT_FALSE(comment_fault("\xD9\x85, e\xCC\x81 and \xF0\x9F\x98\x80\twide\nsecond line"));
  for (const char* bad : {"a\rb", "\x1b", "\xE2\x80\xAE", "\xE2\x81\xA9", "\xE2\x80\x8B",
                          "\xEF\xBB\xBF", "\xE2\x80\xA8", "\xC2\x85", "\xFF"})
    EXPECT_TRUE(comment_fault(bad)) << bad;
  EXPECT_EQ(comment_fault("ab\rc")->at, 2u);
  EXPECT_EQ(comment_fault("ab\rc")->remedy, "end lines by a line feed");
}

TEST(Names, ACleanedUnitIsTheOneThatIsMeant) {
  EXPECT_EQ(cleaned_unit(" k\xE2\x84\xA6 "), "k\xCE\xA9");
  EXPECT_EQ(cleaned_unit("\xE2\x84\xAA"), "K");
  EXPECT_EQ(cleaned_unit("\xE2\x84\xAB"), "\xC3\x85");
  EXPECT_EQ(cleaned_unit("N\xC2\xA0m"), "N m");
  EXPECT_EQ(cleaned_unit("\xEF\xBC\x85"), "%");
  EXPECT_EQ(cleaned_unit("a] [b"), "a) (b");
  EXPECT_EQ(cleaned_unit("V\x1b\xE2\x80\xAE\xEF\xBB\xBF"), "V");
  EXPECT_EQ(cleaned_unit("A\xCC\x8A"), "A?");
  EXPECT_EQ(cleaned_unit("s\r\nint"), "s  int");
  const std::string cut = cleaned_unit(std::string(254, 'm') + "\xCE\xA9");
  EXPECT_EQ(cut, std::string(254, 'm')) << "no half of a character";
}

}  // namespace
}  // namespace lacuna
