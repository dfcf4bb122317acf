// SPDX-License-Identifier: MIT
#include "report/pages/page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lacuna/model/files/model_file.hpp"
#include "report/pages/folded_text.hpp"
#include "report/pages/invariant_text.hpp"
#include "report/pages/readable.hpp"
#include "support/well_formed.hpp"

namespace lacuna {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* kHostile = "<script>alert(1)</script>\"'&";

/// A page in which every text comes from a file that nobody should trust.
Page hostile_page() {
  LineFigure figure{"a", kHostile, kHostile, kHostile, {}};
  figure.series.push_back({kHostile, Vector::Zero(2), Vector::Zero(2)});
  const RowFigure rows{"a", kHostile, kHostile, {{kHostile, 1.0, {}, {}, kHostile}}};
  const OrbitFigure orbit{
      "c", kHostile, {kHostile, "y", "z"}, {{kHostile, Matrix::Random(5, 3)}}};
  Page page{kHostile, kHostile, Tone::Bad, {kHostile}, {{kHostile, kHostile, kHostile}},
            {},       {},       kHostile};
  page.sections.push_back({kHostile,
                           table({kHostile}, {{kHostile}}) + bullets({kHostile}),
                           {draw(figure), draw(rows), draw(orbit)}});
  page.sections.push_back({kHostile, {}, {}, true});
  return page;
}

TEST(Page, TextCannotBecomeMarkup) {
  const std::string html = format_html(hostile_page());
  EXPECT_EQ(support::first_fault(html), "");
  EXPECT_THAT(html, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(html, Not(HasSubstr("alert(1)</script>")));
  EXPECT_THAT(html, HasSubstr("&lt;script&gt;alert(1)&lt;/script&gt;"));
}

TEST(Page, LoadsNothing) {
  const std::string html = format_html(hostile_page());
  for (const char* loader : {"src=", "href=", "@import", "url(", "fetch(", "XMLHttpRequest"})
    EXPECT_THAT(html, Not(HasSubstr(loader))) << loader;
  EXPECT_THAT(html, HasSubstr("default-src &#39;none&#39;"));
}

TEST(Page, SaysTheAnswerFirst) {
  Page page{"kind", "It holds.", Tone::Good,          {"Because."}, {{"Gap", "3 %", "of 4"}},
            {},     {},          "lacuna sync m.json"};
  page.sections.push_back({"Details", {}});
  const std::string html = format_html(page);
  const std::size_t headline = html.find("<h1 class=\"good\">It holds.</h1>");
  ASSERT_NE(headline, std::string::npos);
  EXPECT_LT(headline, html.find("Because."));
  EXPECT_LT(html.find("3 %"), html.find("Details"));
  EXPECT_THAT(html, HasSubstr("<code>lacuna sync m.json</code>"));
}

TEST(Page, BeginsWithVerdictEquationsAndOnePicture) {
  Page page{"kind", "It holds.", Tone::Good, {"Because."}, {{"Gap", "3 %", "of 4"}},
            element("i", Markup::text("equations")), {}};
  page.first = {"But."};
  const LineFigure one{"one", "One", "t", "x", {}}, two{"two", "Two", "t", "x", {}};
  page.sections.push_back({"Details", {}, {draw(one), draw(two)}});
  page.sections.push_back({"Other", {}, {draw(LineFigure{"three", "", "", "", {}})}});
  show_first(page, "two");
  const std::string html = format_html(page);
  std::size_t at = 0;
  for (const std::string part : {"It holds.", "But.", "<i>equations", "id=\"two\"", "Because.",
                                 "3 %", "Details", "id=\"one\""}) {
    const std::size_t found = html.find(part, at);
    ASSERT_NE(found, std::string::npos) << part;
    at = found;
  }
  EXPECT_EQ(html.find("id=\"two\""), html.rfind("id=\"two\"")) << "it stands there once";
  EXPECT_EQ(pictures_of(page).front().name, "two");
  show_first(page, "nothing");
  EXPECT_EQ(pictures_of(page).size(), 3u);
}

TEST(Page, PicturesHaveNamesOfTheirOwn) {
  const std::vector<Picture> pictures = pictures_of(hostile_page());
  ASSERT_EQ(pictures.size(), 3u);
  EXPECT_EQ(pictures[0].name, "a");
  EXPECT_EQ(pictures[1].name, "a_2");
}

TEST(Table, SetsColumnsOfNumbersToTheRight) {
  const std::string text =
      table({"term", "value"}, {{"1", "0.5 +- 0.1"}, {"x", "-"}, {"y", "1e-3 V"}}).string();
  EXPECT_THAT(text, HasSubstr("<td>1</td><td class=\"number\">0.5 +- 0.1</td>"));
}

TEST(Readable, UnitsOfRates) {
  EXPECT_EQ(rate_unit("V", "s"), "V/s");
  EXPECT_EQ(rate_unit("rad/s", "s"), "rad/s^2");
  EXPECT_EQ(rate_unit("m/s^2", "s"), "m/s^3");
  EXPECT_EQ(rate_unit("", "ms"), "1/ms");
  EXPECT_EQ(rate_unit("m/s", "ms"), "m/s/ms");
  EXPECT_EQ(rate_unit("V/sec", "s"), "V/sec/s");
}

TEST(Readable, DigitsFollowTheError) {
  EXPECT_EQ(with_error(-0.400412345, 0.00082), "-0.40041 +- 0.00082");
  EXPECT_EQ(with_error(1234.5, 100.0), "1.23e+03 +- 1e+02");
  EXPECT_EQ(with_error(0.123456, 0.0), "0.1235");
  EXPECT_EQ(with_error(0.01234, 0.5), "0.012 +- 0.5");
  EXPECT_EQ(with_error(7.5e-12, 2e71), "7.5e-12 (not determined)");
}

TEST(Readable, CoefficientsHaveTheDigitsOfTheirIntervals) {
  const Term x = Term::parse("x", {{"x"}, {}});
  EXPECT_EQ(coefficient_text({x, 1.23456789, {}, std::array{1.22, 1.25}}), "1.235");
  EXPECT_EQ(coefficient_text({x, 1.23456789, 0.01}), "1.235");
  EXPECT_EQ(coefficient_text({x, 1.23456789}), "1.23457");
  EXPECT_EQ(coefficient_text({x, 1.23456789, 0.01}, {.full = true}), "1.23456789");
  EXPECT_EQ(coefficient_text({x, 1.23456789, 0.01}, {.significant = 2}), "1.2");
}

TEST(Readable, EquationsReadAsTheyAreWrittenByHand) {
  const Variables variables{{"x", "y"}, {}};
  const OdeModel model({{"x", ""}, {"y", ""}}, {},
                       {{{Term::parse("1", variables), -0.5},
                         {Term::parse("x+y", variables), 2.0},
                         {Term::parse("y", variables), -1.0}},
                        {}});
  EXPECT_EQ(equation_text(model, 0, {}, Intervals::Shown), "dx/dt = -0.5 + 2*(x+y) - y");
  EXPECT_EQ(equation_text(model, 1, {}, Intervals::Shown), "dy/dt = 0");
}

TEST(Readable, EquationsShowIntervals) {
  const Variables variables{{"x"}, {}};
  const OdeModel model({{"x", ""}}, {},
                       {{{Term::parse("1", variables), 0.25, {}, std::array{0.24, 0.26}},
                         {Term::parse("x", variables), -9.98, {}, std::array{-10.0, -9.96}},
                         {Term::parse("x^2", variables), 3e-12, 1.0},
                         {Term::parse("x^3", variables), 1.5, 1e-12}}});
  // 1.96 x 1 is far more than 10^6 times the coefficient.
  EXPECT_EQ(
      equation_text(model, 0, {}, Intervals::Shown),
      "dx/dt = (0.25 +- 0.01) - (9.98 +- 0.02)*x + (3e-12, not determined)*x^2 + 1.5*x^3");
  EXPECT_EQ(equation_text(model, 0, {}, Intervals::Hidden),
            "dx/dt = 0.25 - 9.98*x + 3e-12*x^2 + 1.5*x^3");
}

TEST(Readable, FilesWithoutTheirFolders) {
  EXPECT_EQ(short_name("/a/b/run.csv"), "run.csv");
  EXPECT_EQ(short_name("a/run.csv, record 2"), "run.csv, record 2");
  EXPECT_EQ(short_name("run.csv"), "run.csv");
}

TEST(SaidOnce, PlacesStandTogetherInFrontOfWhatIsSaidOfThem) {
  EXPECT_THAT(
      said_once({"a.csv: the column s is text", "nothing moves", "b.csv: the column s is text",
                 "a.csv: time jumps"}),
      ElementsAre("a.csv, b.csv: the column s is text", "nothing moves", "a.csv: time jumps"));
  EXPECT_THAT(said_once({"a.csv:4:3: no value", "a.csv:9:3: no value", "b.csv:1:3: no value"}),
              ElementsAre("a.csv:4:3 and 2 more: no value"));
}

TEST(SaidOnce, WhatIsThereTwiceStandsOnce) {
  EXPECT_THAT(said_once({"a: b", "c", "a: b", "c"}), ElementsAre("a: b", "c"));
  EXPECT_THAT(said_once({}), ElementsAre());
}

/// Colons inside of what is said are no places.
TEST(SaidOnce, NumbersThatDifferAreSaidApart) {
  EXPECT_THAT(said_once({"clipped: x at 5: 3 %", "clipped: v at 5: 3 %"}),
              ElementsAre("clipped: x at 5: 3 %", "clipped: v at 5: 3 %"));
}

TEST(FoldedText, BreaksAtBlanksAndIndentsWhatFollows) {
  EXPECT_EQ(folded("one two three\n", 8), "one two\n  three\n");
  EXPECT_EQ(folded("  one two three", 10), "  one two\n      three");
  EXPECT_EQ(folded("short\n\nlines\n", 8), "short\n\nlines\n");
}

TEST(FoldedText, KeepsSignsWithWhatFollowsThem) {
  EXPECT_EQ(folded("y = aa + bb", 9), "y = aa\n  + bb");
  EXPECT_EQ(folded("a b 1 +- 2", 9), "a b\n  1 +- 2");
}

TEST(FoldedText, LeavesLongWordsWhole) {
  EXPECT_EQ(folded("a/long/path/of/a/file x", 8), "a/long/path/of/a/file\n  x");
}

TEST(FoldedText, CountsCharactersAndNoEscapeCodes) {
  EXPECT_EQ(folded("\x1b[1mone two\x1b[0m", 7), "\x1b[1mone two\x1b[0m");
  EXPECT_EQ(folded("\xc3\xa4\xc3\xb6\xc3\xbc \xc3\xa4\xc3\xb6\xc3\xbc", 7),
            "\xc3\xa4\xc3\xb6\xc3\xbc \xc3\xa4\xc3\xb6\xc3\xbc");
}

TEST(Glossary, ExplainsTheWordsThatStandInThePage) {
  Page page{"kind", "A friction at 12 sigma.", Tone::Good, {}, {}, {}, {}, {}};
  const auto glossary = glossary_of(page);
  ASSERT_TRUE(glossary.has_value());
  EXPECT_TRUE(glossary->folded);
  const std::string text = glossary->content.string();
  EXPECT_THAT(text, HasSubstr("<dt>sigma</dt>"));
  EXPECT_THAT(text, Not(HasSubstr("<dt>probability</dt>")));
  const std::string html = format_html(page);
  EXPECT_EQ(support::first_fault(html), "");
  EXPECT_THAT(html, HasSubstr("<summary>What the words mean</summary>"));
}

TEST(Glossary, LooksAtFactsAndSections) {
  Page page{"kind", "It holds.", Tone::Good, {}, {{"Gap", "3 %", "rms"}}, {}, {}, {}};
  page.sections.push_back({"Numbers", table({"estimate", "95 % interval"}, {})});
  const auto glossary = glossary_of(page);
  ASSERT_TRUE(glossary.has_value());
  EXPECT_THAT(glossary->content.string(), HasSubstr("<dt>rms</dt>"));
  EXPECT_THAT(glossary->content.string(), HasSubstr("<dt>95 %</dt>"));
}

TEST(RelationText, ReadsLikeAnEquation) {
  EXPECT_EQ(relation_text({{{"x^2", 1.0, 0.0}, {"y^2", 1.0003, 0.001}}, 4.0012, 0.011, 0.01}),
            "x^2 + y^2 = 4.001 +- 0.022");
  EXPECT_EQ(relation_text({{{"x", 1.0, 0.0}, {"y", -0.5012, 5e-5}}, -1.0, 0.1, 0.1}),
            "x - 0.5012*y = -1 +- 0.2");
  EXPECT_EQ(relation_text({{{"x", 1.0, 0.0}, {"y", 0.5012, 0.002}}, -1.0, 0.1, 0.1}),
            "x + 0.5*y = -1 +- 0.2");
  EXPECT_EQ(relation_text({{{"z", 1.0, 0.0}}, 3.0, 0.0, 0.0}), "z = 3");
  EXPECT_EQ(relation_text({{{"z", 1.0, 0.0}}, 7.5e-12, 2e71, 2e71}), "z = 0 +- 3.9e+71");
}

TEST(RelationText, SaysWhatCannotBeToldApart) {
  EXPECT_EQ(relation_sentence({{{"S", 1.0, 0.0}, {"I", 1.0, 0.001}}, 1.0, 0.01, 0.01}),
            "S + I = 1 +- 0.02 on these data: S, I and a constant cannot be distinguished");
}

TEST(TrappingSentence, ReadsLikeAnInequality) {
  const OdeModel model = parse_ode("dx/dt = -x\ndy/dt = -y\n", "a.ode");
  EXPECT_EQ(trapping_sentence(model, {Vector{{1e-9, -2.5}}, Vector{{1.0, 0.25}}, 101.33, 1.0}),
            "All paths come into x^2 + 0.25*(y + 2.5)^2 <= 101^2 and stay");
}

}  // namespace
}  // namespace lacuna
