// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "report/pages/page.hpp"
#include "support/well_formed.hpp"

namespace lacuna {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

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

}  // namespace
}  // namespace lacuna
