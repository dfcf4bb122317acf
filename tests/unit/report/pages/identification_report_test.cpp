// SPDX-License-Identifier: MIT
#include "lacuna/report/pages/identification_report.hpp"

#include <nlohmann/json.hpp>

#include "unit/report/pages/reports.hpp"

namespace lacuna {
namespace {

using testing::sample_report;

nlohmann::json sample_json() { return nlohmann::json::parse(format_json(sample_report())); }

TEST(IdentificationReport, ModelCarriesErrorsAndIntervals) {
  const nlohmann::json model = sample_json()["model"];
  EXPECT_EQ(model["format"], "lacuna.model/1");
  const nlohmann::json term = model["equations"][1]["terms"][0];
  EXPECT_EQ(term["coefficient"], -2.0);
  EXPECT_EQ(term["stderr"], 0.01);
  EXPECT_EQ(term["ci95"][1], -1.98);
}

TEST(IdentificationReport, TrailSaysWhoRemovedATermAndWhy) {
  const nlohmann::json trail = sample_json()["trail"];
  ASSERT_EQ(trail.size(), 3u);
  EXPECT_EQ(trail[1]["kept"], true);
  EXPECT_FALSE(trail[1].contains("removed_by"));
  EXPECT_EQ(trail[2]["removed_by"], "pruner minor-terms");
  EXPECT_EQ(trail[2]["value"], 0.11);
  EXPECT_EQ(trail[2]["threshold"], 0.12);
  EXPECT_EQ(trail[2]["step"], 3);
}

TEST(IdentificationReport, FitNoiseSyncAndWarningsAreThere) {
  const nlohmann::json json = sample_json();
  EXPECT_EQ(json["fit"][0]["identity"], true);
  EXPECT_EQ(json["fit"][1]["residual"], 0.1);
  EXPECT_EQ(json["fit"][1]["noise_floor"], 0.09);
  EXPECT_EQ(json["fit"][1]["fits_to_noise"], true);
  EXPECT_EQ(json["noise"]["x"], 0.003);
  EXPECT_EQ(json["sync"]["mean"], 0.002);
  EXPECT_EQ(json["warnings"][0], "be careful");
}

TEST(IdentificationReport, WhatIsNotKnownIsNull) {
  IdentificationReport report = sample_report();
  report.sync.reset();
  report.result.fit[1].noise_floor.reset();
  const auto json = nlohmann::json::parse(format_json(report));
  EXPECT_TRUE(json["sync"].is_null());
  EXPECT_TRUE(json["fit"][1]["noise_floor"].is_null());
}

TEST(IdentificationReport, VerdictAndRelationsAreThere) {
  EXPECT_TRUE(sample_json()["verdict"].is_null());
  EXPECT_TRUE(sample_json()["validation"].is_null());
  EXPECT_TRUE(sample_json()["relations"].empty());
  IdentificationReport report = sample_report();
  report.result.validation = testing::sample_validation();
  report.result.relations = {testing::sample_relation()};
  const auto json = nlohmann::json::parse(format_json(report));
  EXPECT_EQ(json["verdict"], "approximation");
  EXPECT_EQ(json["validation"]["held_out"], "parts");
  EXPECT_EQ(json["validation"]["windows"]["states"][0]["state"], "x");
  EXPECT_DOUBLE_EQ(json["validation"]["windows"]["states"][0]["share"], 0.04 / 0.75);
  EXPECT_EQ(json["validation"]["one_step"]["windows"], 50);
  EXPECT_EQ(json["validation"]["advice"][0], "try sin(x)");
  EXPECT_EQ(json["relations"][0]["terms"][1]["term"], "y^2");
  EXPECT_EQ(json["relations"][0]["value"], 4.0);
}

}  // namespace
}  // namespace lacuna
