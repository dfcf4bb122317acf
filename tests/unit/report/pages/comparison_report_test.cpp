// SPDX-License-Identifier: MIT
#include "lacuna/report/pages/comparison_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace lacuna {
namespace {

using ::testing::HasSubstr;

ComparisonReport report() {
  return {"m.ode",
          "run.csv",
          {{"extent of x", "V", 20.0, 20.5, 0.4, 0.5, true},
           {.name = "Lyapunov exponent", .note = "the record is short"}}};
}

TEST(ComparisonReport, TellsWhatAgrees) {
  const std::string text = format_text(report());
  EXPECT_THAT(text, HasSubstr("They agree"));
  EXPECT_THAT(text, HasSubstr("extent of x [V]"));
  EXPECT_THAT(text, HasSubstr("20.5 +- 0.5"));
  EXPECT_THAT(text, HasSubstr("not judged: the record is short"));
}

TEST(ComparisonReport, OneFailureIsEnough) {
  ComparisonReport other = report();
  other.measures.push_back({"density", "", 0.1, 0.5, 0.01, 0.01, false});
  EXPECT_FALSE(other.agree());
  EXPECT_THAT(format_text(other), HasSubstr("FAIL"));
  const auto json = nlohmann::json::parse(format_json(other));
  EXPECT_EQ(json["agree"], false);
  EXPECT_TRUE(json["measures"][1]["agree"].is_null());
  EXPECT_NEAR(json["measures"][0]["first_ci95"][1].get<double>(), 20.4, 1e-12);
}

TEST(ComparisonReport, NothingJudgedIsNoAgreement) {
  ComparisonReport other = report();
  other.measures.erase(other.measures.begin());
  EXPECT_FALSE(other.agree());
}

}  // namespace
}  // namespace lacuna
