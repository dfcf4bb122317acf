// SPDX-License-Identifier: MIT
#include "report/plot/markup.hpp"

#include <gtest/gtest.h>

namespace lacuna {
namespace {

TEST(Markup, TextCannotBecomeMarkup) {
  EXPECT_EQ(escape_markup("<script>alert('1' & \"2\")</script>"),
            "&lt;script&gt;alert(&#39;1&#39; &amp; &quot;2&quot;)&lt;/script&gt;");
  EXPECT_EQ(Markup::text("a<b").string(), "a&lt;b");
}

TEST(Markup, ControlCharactersAndBytesThatAreNoTextAreShown) {
  EXPECT_EQ(escape_markup("a\x1b[1m"), "a\\x1b[1m");
  EXPECT_EQ(escape_markup("\xff"), "\\xff");
  EXPECT_EQ(escape_markup("\u03c6"), "\u03c6");
}

TEST(Markup, AttributesAreEscaped) {
  EXPECT_EQ(element("p", {{"title", "\"><b>"}}, Markup::text("x")).string(),
            "<p title=\"&quot;&gt;&lt;b&gt;\">x</p>");
  EXPECT_EQ(empty_element("br", {}).string(), "<br/>");
}

TEST(Markup, PiecesFollowOneAnother) {
  Markup both = element("i", Markup::text("a")) + Markup::own("<hr/>");
  both += Markup::text("&");
  EXPECT_EQ(both.string(), "<i>a</i><hr/>&amp;");
  EXPECT_TRUE(Markup().empty());
}

}  // namespace
}  // namespace lacuna
