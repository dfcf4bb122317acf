// SPDX-License-Identifier: MIT
#include "report/pages/page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/well_formed.hpp"

namespace lacuna {
namespace {

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

}  // namespace
}  // namespace lacuna
