// SPDX-License-Identifier: MIT
#include "lacuna/report/pages/rivals_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace lacuna {
namespace {

using ::testing::HasSubstr;

RivalComparison two_rivals() {
  RivalComparison comparison;
  comparison.values = 40.0;
  comparison.rivals = {{.name = "a.ode", .unknowns = 4.0, .aicc = 10.0, .fits = Adequate::Yes},
                       {.name = "b.ode",
                        .unknowns = 5.0,
                        .aicc = 11.0,
                        .fits = Adequate::No,
                        .behind = 0.4,
                        .is_tied = true},
                       {.name = "c.ode",
                        .unknowns = 3.0,
                        .log_likelihood = std::nan(""),
                        .aicc = 60.0,
                        .converged = false,
                        .behind = 5.0,
                        .is_tied = false}};
  return comparison;
}

TEST(RivalsReport, TextNamesWhatIsNotDistinguished) {
  const std::string text = format_text(two_rivals());
  EXPECT_THAT(text, HasSubstr("The records do not distinguish these: a.ode, b.ode."));
  EXPECT_THAT(text, HasSubstr("residuals have structure, tied"));
  EXPECT_THAT(text, HasSubstr("did not converge"));
  EXPECT_THAT(text, ::testing::Not(HasSubstr("held-out")));
  RivalComparison alone = two_rivals();
  alone.rivals[1].is_tied = false;
  alone.rivals[0].held_out = 0.2;
  alone.rivals[0].fits = Adequate::No;
  EXPECT_THAT(format_text(alone), HasSubstr("a.ode meets the records better than all others. "
                                            "None is adequate"));
  EXPECT_THAT(format_text(alone), HasSubstr("held-out gap"));
}

TEST(RivalsReport, JsonHasTheFieldsOfTheFormat) {
  const auto json = nlohmann::json::parse(format_json(two_rivals()));
  EXPECT_EQ(json["format"], "lacuna.rivals/1");
  EXPECT_EQ(json["rivals"][1]["behind_sigma"], 0.4);
  EXPECT_EQ(json["rivals"][1]["tied"], true);
  EXPECT_TRUE(json["rivals"][2]["log_likelihood"].is_null());
  EXPECT_TRUE(json["rivals"][0]["held_out_gap"].is_null());
  EXPECT_EQ(json["rivals"][0]["adequacy"], "yes");
}

TEST(RivalsReport, NotesOfAllFitsFollow) {
  RivalComparison comparison = two_rivals();
  EXPECT_THAT(format_text(comparison), ::testing::Not(HasSubstr("Note")));
  comparison.notes = {"no sample of the held-out records is left"};
  EXPECT_THAT(format_text(comparison),
              HasSubstr("Note: no sample of the held-out records is left.\n"));
  EXPECT_EQ(nlohmann::json::parse(format_json(comparison))["notes"][0],
            "no sample of the held-out records is left");
}

TEST(RivalsReport, WhatIsBestAloneIsTiedWithNothing) {
  RivalComparison alone = two_rivals();
  alone.rivals[1].is_tied = false;
  EXPECT_THAT(format_text(alone), ::testing::Not(HasSubstr(", tied")));
}

}  // namespace
}  // namespace lacuna
