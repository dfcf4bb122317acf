// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "lacuna/model/files/model_file.hpp"
#include "lacuna/report/reports.hpp"
#include "report/pages/pages.hpp"

namespace lacuna {
namespace {

using ::testing::HasSubstr;

Fit example() {
  Fit fit{.model = parse_ode_system("param k = 2 [1/s]\ndx/dt = -k*x\n", "m.ode")};
  fit.numbers = {{.name = "k",
                  .unit = "1/s",
                  .start = 1.0,
                  .value = 2.0,
                  .standard_error = 0.1,
                  .ci95 = {{1.8, 2.2}}},
                 {.name = "a", .value = 3.0},
                 {.name = "b", .value = 4.0, .bound = "max"}};
  fit.correlations = {{"k", "a", -0.95}};
  fit.initial = {{{"x", 1.5, false, 0.25}, {"z", 0.0, true}, {"w", 2.0}}};
  fit.records = {"r.csv"};
  fit.quality = {{.channel = "y",
                  .unit = "V",
                  .samples = 200,
                  .predicted = 20,
                  .rmse = 0.5,
                  .fit_percent = 90.0,
                  .noise = 0.4,
                  .prediction = std::nan(""),
                  .white = false,
                  .rmse_per_record = {0.5}}};
  fit.gap = FitGap{1.0, 0.5, 0.4, {"h.csv"}, fit.quality};
  fit.adequacy = adequacy_of({{"y", Adequate::No, 200, true}});
  fit.combinations = {{{"a", "b"}, "a and b only as a*b"}};
  fit.notes = {"look here"};
  return fit;
}

TEST(FitReport, JsonHasTheFieldsOfTheFormat) {
  const auto json = nlohmann::json::parse(format_json(example()));
  EXPECT_EQ(json["format"], "lacuna.fit/1");
  EXPECT_EQ(json["model"]["parameters"][0]["value"], 2.0);
  EXPECT_EQ(json["parameters"][0]["ci95"][1], 2.2);
  EXPECT_TRUE(json["parameters"][1]["ci95"].is_null());
  EXPECT_EQ(json["parameters"][2]["bound"], "max");
  EXPECT_EQ(json["correlations"][0]["correlation"], -0.95);
  EXPECT_EQ(json["initial"][0]["record"], "r.csv");
  EXPECT_EQ(json["initial"][0]["states"]["x"]["stderr"], 0.25);
  EXPECT_EQ(json["initial"][0]["states"]["z"]["fixed"], true);
  EXPECT_TRUE(json["initial"][0]["states"]["w"]["stderr"].is_null());
  EXPECT_EQ(json["fit"][0]["fit_percent"], 90.0);
  EXPECT_TRUE(json["fit"][0]["k_step"]["rmse"].is_null()) << "not finite";
  EXPECT_EQ(json["fit"][0]["white"], false);
  EXPECT_EQ(json["gap"]["ratio"], 0.5);
  EXPECT_EQ(json["gap"]["records"][0], "h.csv");
  EXPECT_EQ(json["identifiable"], false);
  EXPECT_EQ(json["combinations"][0]["members"][1], "b");
  EXPECT_EQ(json["hints"][0]["kind"], "not-identifiable");
}

TEST(FitReport, TextSaysWhatIsNotDetermined) {
  const std::string text = format_text(example());
  EXPECT_THAT(text, HasSubstr("dx/dt = -x*k"));
  EXPECT_THAT(text, HasSubstr("k     2            +- 0.2  [1.8, 2.2]  1/s"));
  EXPECT_THAT(text, HasSubstr("a     3            not determined by itself"));
  EXPECT_THAT(text, HasSubstr("b     4            at the max of its range"));
  EXPECT_THAT(text, HasSubstr("Not identifiable: a and b only as a*b"));
  EXPECT_THAT(text, HasSubstr("r.csv: x 1.5 +- 0.49 z 0 (fixed) w 2 (not determined)"));
  EXPECT_THAT(text, HasSubstr("y: rmse 0.5 V, fit 90 %"));
  EXPECT_THAT(text, HasSubstr("gap 1 -> 0.5"));
  EXPECT_THAT(text, HasSubstr("Note: look here"));
}

/// x at two times with its bands; nothing is known of y.
FitBands bands() {
  const double none = std::nan("");
  Matrix value(2, 2), low(2, 2), high(2, 2), least(2, 2), most(2, 2);
  value << 1.0, 5.0, 2.0, 6.0;
  low << 0.9, none, 1.8, none;
  high << 1.1, none, 2.2, none;
  least << 0.5, none, 1.5, none;
  most << 1.5, none, 2.5, none;
  return {"new.csv", Vector{{0.0, 3.0}}, {{"x", "V"}, {"y", ""}}, value, 0.1 * value,
          low,       high,               least,                  most};
}

TEST(FitReport, BandsAreInEveryKindOfAnswer) {
  Fit fit = example();
  fit.predicted = {bands()};
  fit.bands = {bands(), bands()};
  const auto json = nlohmann::json::parse(format_json(fit));
  EXPECT_EQ(json["bands"].size(), 2u);
  const auto& x = json["predicted"][0]["quantities"][0];
  EXPECT_EQ(json["predicted"][0]["time"][1], 3.0);
  EXPECT_EQ(x["value"][1], 2.0);
  EXPECT_EQ(x["stderr"][1], 0.2);
  EXPECT_EQ(x["low"][1], 1.8);
  EXPECT_EQ(x["high"][1], 2.2);
  EXPECT_EQ(x["least"][1], 1.5);
  EXPECT_EQ(x["most"][1], 2.5);
  EXPECT_TRUE(json["predicted"][0]["quantities"][1]["low"][0].is_null());
  EXPECT_THAT(format_text(fit), HasSubstr("Predicted at t = 3 of new.csv (90 %)\n"
                                          "  x 2  [1.8, 2.2], measured [1.5, 2.5]\n"));
  const Page page = fit_page(fit);
  const auto titled = [&](const std::string& title) {
    return std::count_if(page.sections.begin(), page.sections.end(),
                         [&](const PageSection& section) { return section.title == title; });
  };
  EXPECT_EQ(titled("Bands"), 1);
  EXPECT_EQ(titled("Prediction"), 1);
}

TEST(FitReport, TruncatedNoiseIsSaid) {
  Fit fit = example();
  fit.quality[0].law = NoiseLaw{.constant = 0.5, .below = 2.0, .truncated = true};
  const auto json = nlohmann::json::parse(format_json(fit));
  EXPECT_EQ(json["fit"][0]["noise_law"]["truncated"], true);
  EXPECT_THAT(format_text(fit), HasSubstr("constant noise 0.5 truncated below 2"));
}

TEST(FitReport, TextSaysWhatWasNotCompared) {
  Fit fit = example();
  EXPECT_THAT(format_text(fit), HasSubstr("10 samples ahead no finite prediction"));
  fit.quality[0].predicted = 0;
  fit.quality[0].fit_percent = std::nan("");
  EXPECT_THAT(format_text(fit), HasSubstr("no fit in % (it never changes), 10 samples ahead "
                                          "nothing to compare"));
  fit.quality[0].samples = 0;
  EXPECT_THAT(format_text(fit), HasSubstr("y: no sample was compared"));
}

TEST(FitReport, AnIntervalThatEndsWithItsRangeIsShownByItsEnds) {
  Fit fit = example();
  fit.numbers[0].ci95 = {{1.8, 2.05}};
  EXPECT_THAT(format_text(fit), HasSubstr("k     2            [1.8, 2.05]  1/s"));
}

TEST(FitReport, TheHeadlineIsMadeOfTheAdequacy) {
  Fit fit = example();
  EXPECT_THAT(fit_page(fit).headline, HasSubstr("the residuals have structure"));
  fit.adequacy = adequacy_of({{"y", Adequate::Yes, 200, true}});
  EXPECT_THAT(fit_page(fit).headline, HasSubstr("the residuals are noise"));
  EXPECT_THAT(fit_page(fit).headline, HasSubstr("1 of 3 parameters are determined"));
  EXPECT_EQ(fit_page(fit).tone, Tone::Doubtful) << "a is not determined, b at a bound";
  Fit all = fit;
  all.numbers.resize(1);
  EXPECT_EQ(fit_page(all).tone, Tone::Good);
  EXPECT_EQ(fit_page(all).headline,
            "The parameters are estimated, and the residuals are noise.");
  fit.adequacy = {};
  EXPECT_THAT(fit_page(fit).headline, HasSubstr("too few to show"));
  EXPECT_EQ(fit_page(fit).tone, Tone::Doubtful);
  EXPECT_EQ(nlohmann::json::parse(format_json(fit))["adequacy"]["fits"], "untold");
}

TEST(FitReport, LimitsAndTestsAreShown) {
  Fit fit = example();
  fit.numbers[1].at_least = 0.5;
  fit.quality[0].sign = "trend";
  fit.quality[0].chance = 0.002;
  fit.profiles = {{"k", {1.0, 2.0}, {4.0, 0.0}, 3.84}};
  const std::string text = format_text(fit);
  EXPECT_THAT(text, HasSubstr("not determined: at least 0.5, no upper limit"));
  EXPECT_THAT(text, HasSubstr("residuals have structure (trend, p = 0.002)"));
  EXPECT_THAT(text, HasSubstr("Verdict: 1 of 3 parameters"));
  const auto json = nlohmann::json::parse(format_json(fit));
  EXPECT_EQ(json["parameters"][1]["at_least"], 0.5);
  EXPECT_EQ(json["fit"][0]["residuals"]["p_value"], 0.002);
  EXPECT_EQ(json["verdict"]["sound"], false);
  EXPECT_EQ(json["verdict"]["not_determined"][0], "a");
  EXPECT_EQ(json["verdict"]["at_bounds"][0], "b");
  EXPECT_EQ(json["profiles"][0]["deviance"][0], 4.0);
}

TEST(FitReport, ThePageShowsNumbersAndRuns) {
  Fit fit = example();
  const Vector time = Vector::LinSpaced(50, 0.0, 1.0);
  fit.runs = {{"r.csv", time, time, 1.1 * time}};
  const Page page = fit_page(fit);
  EXPECT_EQ(page.tone, Tone::Doubtful) << "residuals are not white";
  EXPECT_THAT(page.headline, HasSubstr("structure"));
  const std::string html = format_html(page);
  EXPECT_THAT(html, HasSubstr("a and b only as a*b"));
  EXPECT_THAT(html, HasSubstr("[1.8, 2.2]"));
  EXPECT_THAT(html, HasSubstr("not determined by itself"));
  EXPECT_FALSE(pictures_of(page).empty());
  fit.converged = false;
  EXPECT_EQ(fit_page(fit).tone, Tone::Bad);
}

}  // namespace
}  // namespace lacuna
